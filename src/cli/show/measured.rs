//! Measures of a stone, as `cutlab show` prints them.

use crate::design::proportions::Proportions;
use crate::design::symmetry::Symmetry;
use crate::design::{Design, LengthUnit};
use crate::formats;
use crate::materials::weight::Weight;
use serde::Serialize;

/// Lengths are in the file's unit, percentages of the girdle width.
#[derive(Debug, Serialize)]
pub struct MeasuredProportions {
    pub width: f64,
    pub length: f64,
    pub surface: f64,
    pub table_percent: Option<f64>,
    pub crown_angle_deg: Option<f64>,
    pub crown_height_percent: f64,
    pub pavilion_angle_deg: Option<f64>,
    pub pavilion_depth_percent: f64,
    pub girdle_percent: f64,
    pub depth_percent: f64,
    pub culet_percent: f64,
    pub width_mm: Option<f64>,
    pub volume_mm3: Option<f64>,
    pub carats: Option<f64>,
    /// The material whose density the weight is by.
    pub weighed_as: Option<String>,
    /// Why there is no weight, or why that material was taken.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub weight_note: Option<String>,
}

impl MeasuredProportions {
    /// Measures the stone.
    ///
    /// - `size`: girdle width in millimetres, if asked for
    pub fn new(p: &Proportions, design: &Design, size: Option<f64>, weight: &Weight) -> MeasuredProportions {
        // weight is asked for by --size or known by the unit
        let to_mm = match (size, design.unit) {
            (Some(mm), _) => Some(mm / p.width),
            (None, LengthUnit::Millimetre) => Some(1.0),
            (None, LengthUnit::Free) => None,
        };
        let volume_mm3 = to_mm.map(|k| p.volume * k.powi(3));
        let carats = volume_mm3.and_then(|v| weight.carats(v));
        MeasuredProportions {
            width: p.width,
            length: p.length,
            surface: p.surface,
            table_percent: p.table_percent,
            crown_angle_deg: p.crown_angle_deg,
            crown_height_percent: p.crown_height_percent,
            pavilion_angle_deg: p.pavilion_angle_deg,
            pavilion_depth_percent: p.pavilion_depth_percent,
            girdle_percent: p.girdle_percent,
            depth_percent: p.depth_percent,
            culet_percent: p.culet_percent,
            width_mm: to_mm.map(|k| p.width * k),
            volume_mm3,
            carats,
            weighed_as: carats.and(weight.name()),
            weight_note: volume_mm3.and(weight.note()),
        }
    }
}

impl MeasuredProportions {
    /// With the lengths in a unit of `mm` millimetres, as the file has it.
    pub fn in_unit_of(self, mm: f64) -> MeasuredProportions {
        let (width, length, surface) = (self.width / mm, self.length / mm, self.surface / mm.powi(2));
        MeasuredProportions { width, length, surface, ..self }
    }
}

/// What the unit of a file's lengths is called: `mm`, `m`, or `file` if the file has none.
pub fn unit_name(unit: LengthUnit, format: &str) -> &'static str {
    match unit {
        LengthUnit::Free => "file",
        LengthUnit::Millimetre if formats::unit_mm(format).is_some() => "m",
        LengthUnit::Millimetre => "mm",
    }
}

/// A length or a volume with so many decimals, or with as many digits where these would show none of it: a
/// file may be in metres.
pub fn figure(value: f64, decimals: usize) -> String {
    if value.abs() < 100.0 * 10f64.powi(-(decimals as i32)) {
        format!("{value:.decimals$e}")
    } else {
        format!("{value:.decimals$}")
    }
}

/// `8-fold with mirror, facets within 0.02° of it`
pub fn symmetry(s: &Symmetry) -> String {
    let turns = if s.order > 1 { format!("{}-fold", s.order) } else { "no repetition".into() };
    let mirror = if s.mirror { "with mirror" } else { "without mirror" };
    if s.order == 1 && !s.mirror {
        return "none".into();
    }
    format!("{turns}, {mirror}; facets stray by at most {:.3}°", s.deviation_deg)
}
