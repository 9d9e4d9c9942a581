//! Rows of a sweep: one for each point of a grid of parameters, or of points scattered over it.

use super::input_files::InputFiles;
use super::request::{SweepTable, TableRequest};
use super::row_maker::RowMaker;
use super::sidecar::TableLayout;
use super::sweep::{INDEX, SIZE, Sweep};
use super::table::{TableCell, TableError, TableFormat};
use super::table_job::{FinishedRow, Order};
use super::table_rows::TableRows;
use crate::materials::weight::Weight;
use crate::progress::Progress;
use crate::stone::{Stone, StoneError, StoneOptions, grammar};
use std::collections::BTreeMap;
use std::ffi::{OsStr, OsString};

/// The rows of a [`SweepTable`].
pub struct SweepRows<'a> {
    table: &'a SweepTable,
    stone: &'a OsStr,
    sweep: Sweep,
    total: u64,
    is_diamond: bool,
    maker: RowMaker<'a>,
}

impl<'a> SweepRows<'a> {
    /// Of a request; none of a grid with too many points to count.
    ///
    /// - `stone`: that of the request, whose name need not be UTF-8
    pub fn new(
        request: &TableRequest,
        table: &'a SweepTable,
        stone: &'a OsStr,
        progress: &'a dyn Progress,
    ) -> Result<Option<SweepRows<'a>>, StoneError> {
        let sweep = Sweep { varied: table.vary.clone(), scatter: table.scatter, seed: table.scores.seed };
        let Some(total) = sweep.count() else { return Ok(None) };
        let mut leading: Vec<&str> = table.vary.iter().map(|v| v.key.as_str()).collect();
        leading.push("facets");
        // is the stone of diamond at every point?
        let opened = Stone::open(stone, &table.options.without_size())?;
        let is_diamond =
            Weight::new(opened.material()).is_diamond() && table.vary.iter().all(|v| v.key != INDEX);
        let inputs = InputFiles::new(request, &table.options, [stone]);
        let maker = RowMaker::new(&leading, &table.scores, inputs, progress);
        Ok(Some(SweepRows { table, stone, sweep, total, is_diamond, maker }))
    }

    /// The stone at a point, and what it is to be of.
    fn at_point(&self, point: &[f64]) -> (OsString, StoneOptions) {
        let is_varied = |key: &str| self.table.vary.iter().any(|v| v.key == key);
        let has_size = self.stone.to_str().is_some_and(|stone| grammar::size_is_parameter(stone, is_varied));
        let mut options = self.table.options.clone();
        let mut given = BTreeMap::new();
        for (varied, &value) in self.table.vary.iter().zip(point) {
            match varied.key.as_str() {
                INDEX => {
                    (options.material, options.opened_material, options.ri) = (None, None, Some(value));
                }
                SIZE if !has_size => options.size_mm = Some(value),
                key => {
                    given.insert(key.to_owned(), value);
                }
            }
        }
        let spec = match self.stone.to_str() {
            Some(stone) => grammar::with_parameters(stone, &given).into(),
            None => self.stone.to_owned(), // a file, which has no parameters
        };
        (spec, options)
    }
}

impl TableRows for SweepRows<'_> {
    fn identity(&self) -> &str {
        &self.maker.inputs.identity
    }

    fn columns(&self) -> &[String] {
        &self.maker.columns
    }

    fn total(&self) -> u64 {
        self.total
    }

    fn order(&self) -> Option<Order> {
        None
    }

    fn layout(&self) -> Option<TableLayout> {
        Some(TableLayout {
            stone: self.table.stone.clone(),
            is_diamond: self.is_diamond,
            axes: self.table.vary.iter().map(|v| v.key.clone()).collect(),
            curves: Vec::new(),
            scattered: self.table.scatter.is_some(),
        })
    }

    fn row(&self, i: u64, form: TableFormat) -> Result<FinishedRow, TableError> {
        let point = self.sweep.point(i);
        let (spec, options) = self.at_point(&point);
        let (row, outcome) = self.maker.score(&spec, self.stone, &options, None);
        let mut leading: Vec<TableCell> = point.iter().map(|x| TableCell::number(*x)).collect();
        leading.push(row.facets.into());
        self.maker.finished((row, outcome), leading, None, form)
    }
}
