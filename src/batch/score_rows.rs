//! Rows of a table of scores: one a stone, or one a stone and tilt.

use super::input_files::InputFiles;
use super::proportion_columns as proportions;
use super::request::{ScoreTable, TableRequest};
use super::row_maker::RowMaker;
use super::sidecar::TableLayout;
use super::table::{self, TableCell, TableError, TableFormat};
use super::table_job::{FinishedRow, Order};
use super::table_rows::{TILT, TILT_AXIS, TableRows};
use crate::metrics::Metric;
use crate::progress::Progress;
use crate::scoring::score::Tilt;
use crate::storage::text::display_name;
use std::ffi::OsString;

/// The rows of a [`ScoreTable`].
pub struct ScoreRows<'a> {
    table: &'a ScoreTable,
    stones: &'a [OsString],
    tilts: Vec<Tilt>,
    maker: RowMaker<'a>,
}

impl<'a> ScoreRows<'a> {
    /// Of a request.
    ///
    /// - `stones`: those of the request, folders and patterns replaced by what they hold
    pub fn new(
        request: &TableRequest,
        table: &'a ScoreTable,
        stones: &'a [OsString],
        progress: &'a dyn Progress,
    ) -> ScoreRows<'a> {
        let mut leading = table::STONE_COLUMNS.to_vec();
        if table.proportions {
            leading.extend(proportions::COLUMNS);
        }
        let mut tilts = Vec::new();
        if let Some(range) = &table.tilt {
            leading.push(TILT);
            leading.extend((range.azimuths.len() > 1).then_some(TILT_AXIS));
            let about = |&azimuth: &f64| range.degrees.values().map(move |degrees| Tilt { degrees, azimuth });
            tilts = range.azimuths.iter().flat_map(about).collect();
        }
        let inputs = InputFiles::new(request, &table.options, stones.iter().map(OsString::as_os_str));
        let maker = RowMaker::new(&leading, &table.scores, inputs, progress);
        ScoreRows { table, stones, tilts, maker }
    }

    fn axes(&self) -> usize {
        self.table.tilt.as_ref().map_or(0, |range| range.azimuths.len())
    }
}

impl TableRows for ScoreRows<'_> {
    fn identity(&self) -> &str {
        &self.maker.inputs.identity
    }

    fn columns(&self) -> &[String] {
        &self.maker.columns
    }

    fn total(&self) -> u64 {
        self.stones.len() as u64 * self.tilts.len().max(1) as u64
    }

    fn order(&self) -> Option<Order> {
        self.table.sort.map(|sort| sort.order)
    }

    /// A curve for each stone and axis.
    fn layout(&self) -> Option<TableLayout> {
        self.table.tilt.as_ref()?;
        let alone = match self.stones {
            [stone] => display_name(stone),
            _ => String::new(),
        };
        let several = [(self.stones.len() > 1, table::STONE_COLUMNS[0]), (self.axes() > 1, TILT_AXIS)];
        let curves = several.iter().filter(|(is, _)| *is).map(|(_, column)| column.to_string()).collect();
        Some(TableLayout {
            stone: alone,
            axes: vec![TILT.into()],
            curves,
            scattered: false,
            is_diamond: false,
        })
    }

    fn row(&self, i: u64, form: TableFormat) -> Result<FinishedRow, TableError> {
        let each = self.tilts.len().max(1) as u64;
        let spec = &self.stones[(i / each) as usize];
        let tilt = self.tilts.get((i % each) as usize).copied();
        let options = &self.table.options;
        let (row, outcome) = self.maker.score(spec, spec, options, tilt);
        let mut leading = table::stone_cells(&row);
        if self.table.proportions {
            leading.extend(proportions::cells(spec, options, &self.maker));
        }
        leading.extend(tilt.map(|t| TableCell::number(t.degrees)));
        leading.extend(tilt.filter(|_| self.axes() > 1).map(|t| TableCell::number(t.azimuth)));
        let sorts = |m: &&'static Metric| self.table.sort.is_some_and(|s| s.metric.name == m.name);
        let key = self.table.scores.metrics.iter().position(sorts).and_then(|m| row.scores[m]);
        self.maker.finished((row, outcome), leading, key.map(|e| e.value), form)
    }
}
