//! The reference stones that a report sets scores beside: their table, made by the program.

use crate::math::stats::Estimate;
use crate::metrics::Metric;
use crate::study::table::{Form, Numbers, TableError};

/// Made with `cutlab score STONES -o reports/references.csv`, STONES as [`STONES`] names them, in
/// diamond, seed 1.
const TABLE: &str = include_str!("../../reports/references.csv");

/// Name on the page, proportions in words, and the stone for the command line, in the order of the
/// table's rows. Source: the project's five stones for cross-checks.
pub const STONES: [(&str, &str, &str); 5] = [
    ("reference", "56/34/40.5", "round-brilliant"),
    ("Tolkowsky", "53/34.5/40.75", "tolkowsky"),
    ("steep-deep", "58/36/41.8", "round-brilliant:table=58,crown-angle=36,pavilion-angle=41.8,lower-half=80"),
    ("fisheye", "65/30/38.5", "round-brilliant:table=65,crown-angle=30,pavilion-angle=38.5"),
    ("nailhead", "58/36/43", "round-brilliant:table=58,crown-angle=36,pavilion-angle=43"),
];

/// The scores of the reference stones.
#[derive(Debug)]
pub struct References(Numbers);

impl References {
    /// Reads the table in the binary.
    pub fn read() -> Result<References, TableError> {
        Ok(References(Numbers::read(TABLE.as_bytes(), Form::Csv)?))
    }

    /// One score of every stone of [`STONES`]; none where the table has none.
    ///
    /// Some are scored afresh in `tests/report.rs`.
    pub fn of(&self, metric: &Metric) -> [Option<Estimate>; STONES.len()] {
        let errors = self.0.column(&format!("{}_se", metric.name));
        let values = self.0.column(metric.name);
        let cell = |of: &[Option<f64>], i: usize| of.get(i).copied().flatten();
        std::array::from_fn(|i| Some(Estimate { value: cell(values, i)?, error: cell(errors, i)? }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metrics::METRICS;

    #[test]
    fn the_table_has_every_stone_and_score() {
        let names: Vec<&str> = TABLE.lines().skip(1).map(|l| l.trim_start_matches('"')).collect();
        assert_eq!(names.len(), STONES.len());
        assert!(names.iter().zip(STONES).all(|(line, (.., stone))| line.starts_with(stone)), "{names:?}");
        let references = References::read().expect("can be read");
        for metric in METRICS {
            assert!(references.of(metric).iter().all(Option::is_some), "{}: score them afresh", metric.name);
        }
    }
}
