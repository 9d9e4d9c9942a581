//! The table of a comparison: a row for each metric and stone, and for each of their proportions.

use super::comparison::StoneComparison;
use super::sidecar::TableMeta;
use super::table::{TableCell, TableError, TableFormat};
use super::table_job::TableJobError;
use crate::design::proportions::{self, Proportions};
use crate::materials::weight::Weight;
use crate::sampling::stats::Estimate;
use crate::stone::Stone;
use crate::storage::atomic_write;
use std::path::Path;

/// Columns of [`StoneComparison::table`]; `difference` is from the first stone.
pub const COLUMNS: [&str; 11] = [
    "metric",
    "unit",
    "better",
    "stone",
    "material",
    "value",
    "value_se",
    "difference",
    "difference_se",
    "significant",
    "left_out",
];

/// A measure of every stone that has no error: a proportion, or the weight.
pub struct MeasureRow {
    /// Its name.
    pub name: &'static str,
    /// Its unit; empty for a ratio.
    pub unit: &'static str,
    /// One a stone.
    pub values: Vec<Option<f64>>,
    /// Why a stone may have none.
    pub why: &'static str,
}

impl StoneComparison {
    /// Proportions and weights of the stones.
    pub fn measures(&self) -> Vec<MeasureRow> {
        type Of = fn(&Proportions, &Stone) -> Option<f64>;
        let all: [(&str, &str, Of, &str); 10] = [
            ("width", "mm", |p, _| Some(p.width), ""),
            ("length_to_width", "", |p, _| Some(p.length / p.width), ""),
            ("table", "%", |p, _| p.table_percent, "the stone has no table"),
            ("crown_angle", "°", |p, _| p.crown_angle_deg, "the crown has no inclined facets"),
            ("crown_height", "%", |p, _| Some(p.crown_height_percent), ""),
            ("pavilion_angle", "°", |p, _| p.pavilion_angle_deg, "the pavilion has no inclined facets"),
            ("pavilion_depth", "%", |p, _| Some(p.pavilion_depth_percent), ""),
            ("girdle", "%", |p, _| Some(p.girdle_percent), ""),
            ("depth", "%", |p, _| Some(p.depth_percent), ""),
            (
                "weight",
                "ct",
                |p, stone| Weight::new(stone.material()).carats(p.volume),
                "the density of what it is made of is not known; --material names a material that has one",
            ),
        ];
        let measure = |stone: &Stone| proportions::of_design(stone.design()?).ok();
        let measured: Vec<Option<Proportions>> = self.stones.iter().map(measure).collect();
        let each = |of: Of| measured.iter().zip(&self.stones).map(move |(p, s)| of(p.as_ref()?, s)).collect();
        let row = |(name, unit, of, why)| MeasureRow { name, unit, values: each(of), why };
        all.into_iter().map(row).collect()
    }

    /// The table as a file's bytes, with a row for each metric and stone; where a stone has no score or no such
    /// measure its row says why.
    pub fn table(&self, form: TableFormat) -> Result<Vec<u8>, TableError> {
        let columns = COLUMNS.map(String::from);
        let rows = self.rows();
        let mut out = form.head(&columns)?;
        for (i, row) in rows.iter().enumerate() {
            out.extend_from_slice(form.before(i as u64));
            out.extend(form.row(&columns, row)?);
        }
        out.extend_from_slice(form.tail(rows.len() as u64));
        Ok(out)
    }

    fn rows(&self) -> Vec<Vec<TableCell>> {
        let mut rows: Vec<Vec<TableCell>> = Vec::new();
        let cell = |x: Option<f64>| x.map_or(TableCell::Empty(()), TableCell::number);
        let mut add = |stone: usize, (words, why): ([&str; 3], Option<&str>), values: [_; 2], mark: bool| {
            let ([name, unit, better], [score, difference]): (_, [Option<Estimate>; 2]) = (words, values);
            let significant = difference.map(|_| if mark { "yes" } else { "no" });
            let stone = &self.stones[stone];
            rows.push(vec![
                name.into(),
                unit.into(),
                Some(better).filter(|word| !word.is_empty()).into(),
                stone.name().into(),
                stone.material().name.as_ref().into(),
                cell(score.map(|e| e.value)),
                cell(score.map(|e| e.error)),
                cell(difference.map(|e| e.value)),
                cell(difference.map(|e| e.error)),
                significant.into(),
                why.filter(|_| score.is_none()).into(),
            ]);
        };
        for (m, metric) in self.scores().metrics.iter().enumerate() {
            for (s, row) in self.comparison.rows.iter().enumerate() {
                let why = row.why_left_out(metric).or(row.error.as_deref());
                let words = [metric.name, metric.unit, metric.better.word()];
                add(s, (words, why), [row.scores[m], self.difference(s, m)], self.is_significant(s, m));
            }
        }
        for measure in self.measures() {
            let first = measure.values[0];
            for (s, value) in measure.values.iter().enumerate() {
                let difference = value.zip(first).filter(|_| s > 0).map(|(v, f)| Estimate::exact(v - f));
                let differs = difference.is_some_and(|d| d.value.abs() > 1e-9);
                let said = ([measure.name, measure.unit, ""], Some(measure.why));
                add(s, said, [value.map(Estimate::exact), difference], differs);
            }
        }
        rows
    }

    /// Writes the table, after its sidecar; to a stream without one.
    pub fn write(&self, path: &Path, form: TableFormat) -> Result<(), TableJobError> {
        let bytes = self.table(form)?;
        if !atomic_write::is_stream(path) {
            let crc32 = format!("{:08x}", crc32fast::hash(&bytes));
            let columns = COLUMNS.map(String::from).into();
            let meta = TableMeta { crc32, ..TableMeta::new(&self.request, self.identity.clone(), columns) };
            meta.write_for(path)?;
        }
        Ok(atomic_write::write(path, &bytes)?)
    }
}
