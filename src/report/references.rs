//! The reference stones that a report sets scores beside: their table, made by the program.

use crate::batch::table::{NumericColumns, TableError, TableFormat};
use crate::geometry::Polyhedron;
use crate::limits::Limits;
use crate::materials::Material;
use crate::metrics::{METRICS, Metric};
use crate::sampling::stats::Estimate;
use crate::scoring::score::{DEFAULT_SAMPLES, ScoreInput, ScoreRequest, Target, score};
use crate::stone::Stone;
use std::collections::BTreeMap;

/// Made with `cutlab score STONES -o references.csv`, STONES as [`STONES`] names them, in diamond, polarisation
/// followed, seed 1.
const TABLE: &str = include_str!("data/references.csv");

/// Name on the page, proportions in words, and the stone for the command line, in the order of the
/// table's rows. Source: the project's five stones for cross-checks.
pub const STONES: [(&str, &str, &str); 5] = [
    ("reference", "56/34/40.5", "round-brilliant"),
    ("Tolkowsky", "53/34.5/40.75", "tolkowsky"),
    ("steep-deep", "58/36/41.8", "round-brilliant:table=58,crown-angle=36,pavilion-angle=41.8,lower-half=80"),
    ("fisheye", "65/30/38.5", "round-brilliant:table=65,crown-angle=30,pavilion-angle=38.5"),
    ("nailhead", "58/36/43", "round-brilliant:table=58,crown-angle=36,pavilion-angle=43"),
];

/// Points of the hemisphere for each stone in another material or light than the table's: a quarter of a report's
/// own.
const SAMPLES: u64 = DEFAULT_SAMPLES / 4;

/// The scores of the reference stones in one material.
#[derive(Debug)]
pub struct References {
    /// The material's name.
    pub material: String,
    /// One of each of [`STONES`] for each metric.
    scores: BTreeMap<&'static str, [Option<Estimate>; STONES.len()]>,
}

impl References {
    /// Reads the table in the binary: the stones in diamond.
    pub fn read() -> Result<References, TableError> {
        let numbers = NumericColumns::read(TABLE.as_bytes(), TableFormat::Csv, Limits::default())?;
        let of = |metric: &Metric| {
            let errors = numbers.column(&format!("{}_se", metric.name));
            let values = numbers.column(metric.name);
            let cell = |of: &[Option<f64>], i: usize| of.get(i).copied().flatten();
            std::array::from_fn(|i| Some(Estimate { value: cell(values, i)?, error: cell(errors, i)? }))
        };
        let scores = METRICS.iter().map(|m| (m.name, of(m))).collect();
        Ok(References { material: Material::diamond().name.to_string(), scores })
    }

    /// The stones in `material`: those of the table for diamond with polarisation followed, else scored as `plan`
    /// says, with fewer samples.
    ///
    /// - `width_mm`: girdle width, on which the scores depend if the material absorbs
    pub fn within(material: &Material, width_mm: f64, plan: &ScoreRequest) -> Result<References, TableError> {
        if material == Material::diamond() && plan.polarised {
            return References::read();
        }
        let plan =
            ScoreRequest { metrics: METRICS.to_vec(), target: Target::Samples(SAMPLES), ..plan.clone() };
        let scored = STONES.map(|(name, _, spec)| {
            let shape = solid(spec, width_mm).map(Into::into);
            let subject = ScoreInput { stone: name.into(), material: material.clone(), shape, tilt: None };
            score(&subject, &plan).scores
        });
        let of = |m: usize| std::array::from_fn(|stone| scored[stone].get(m).copied().flatten());
        let scores = METRICS.iter().enumerate().map(|(m, metric)| (metric.name, of(m))).collect();
        Ok(References { material: material.name.to_string(), scores })
    }

    /// One score of every stone of [`STONES`]; none where it has none.
    ///
    /// Some are scored afresh in `tests/program/report.rs`.
    pub fn scores(&self, metric: &Metric) -> [Option<Estimate>; STONES.len()] {
        self.scores.get(metric.name).copied().unwrap_or_default()
    }
}

/// The solid of a stone of [`STONES`], so many millimetres wide, or why there is none.
fn solid(spec: &str, width_mm: f64) -> Result<Polyhedron, String> {
    let stone = Stone::parse(spec).and_then(|stone| stone.with_width(width_mm)).map_err(|e| e.to_string())?;
    stone.solid().cloned().ok_or_else(|| format!("{spec} is no solid"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_has_every_stone_and_score() {
        let names: Vec<&str> = TABLE.lines().skip(1).map(|l| l.trim_start_matches('"')).collect();
        assert_eq!(names.len(), STONES.len());
        assert!(names.iter().zip(STONES).all(|(line, (.., stone))| line.starts_with(stone)), "{names:?}");
        let references = References::read().expect("can be read");
        for metric in METRICS.iter() {
            assert!(
                references.scores(metric).iter().all(Option::is_some),
                "{}: score them afresh",
                metric.name
            );
        }
    }
}
