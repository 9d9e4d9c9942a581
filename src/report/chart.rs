//! Where a round brilliant stands on the contour map of light return.

use super::plot::{Axis, ScorePlot, Style};
use crate::batch::table::{NumericColumns, TableError, TableFormat};
use crate::design::families;
use crate::design::proportions::Proportions;
use crate::limits::Limits;
use crate::materials::Material;
use crate::metrics::Metric;

/// A sweep of the reference brilliant in diamond; `reports/sweeps/README.md` has its command.
const TABLE: &str = include_str!("data/crown-pavilion-wlr.csv");

const KEYS: [&str; 2] = ["crown-angle", "pavilion-angle"];

/// Ends of the map along [`KEYS`], in degrees.
const ENDS: [(f64, f64); 2] = [(30.0, 38.0), (40.0, 42.0)];

/// The map with a stone on it as SVG, and a line about it; none for what is no round brilliant.
///
/// - `proportions`, `material`: of the stone
pub fn draw(proportions: &Proportions, material: &Material) -> Result<Option<(String, String)>, TableError> {
    let p = proportions;
    let (Some(_), Some(crown), Some(pavilion)) = (p.brilliant, p.crown_angle_deg, p.pavilion_angle_deg)
    else {
        return Ok(None);
    };
    let (Some(family), Some(metric)) = (families::family("round-brilliant").ok(), Metric::by_name("wlr"))
    else {
        return Ok(None);
    };
    let at = [crown, pavilion];
    let drawing = ScorePlot {
        metric,
        axes: &KEYS.map(|key| Axis::new(key, Some(family))),
        stone: "round-brilliant",
        family: Some(family),
        is_diamond: true,
        style: &Style::default(),
        own: Some(("this stone", &at)),
    };
    let svg = drawing.svg(
        &NumericColumns::read(TABLE.as_bytes(), TableFormat::Csv, Limits::default())?,
        false,
        &[],
    );
    let mut caption = String::from(
        "Map of the reference brilliant in diamond: table 56, star 50, lower half 75, girdle 3; the stone’s own \
         table, halves and girdle may differ.",
    );
    let inside = |(x, (from, to)): (&f64, &(f64, f64))| (from - 1e-6..=to + 1e-6).contains(x);
    if !at.iter().zip(&ENDS).all(inside) {
        caption += &format!(" At {crown:.2}° and {pavilion:.2}° this stone lies outside of it.");
    }
    if material.name != "diamond" {
        caption += &format!(" This stone is of {}, so its own light return is another.", material.name);
    }
    Ok(Some((svg, caption)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_are_those_of_the_table() {
        let numbers =
            NumericColumns::read(TABLE.as_bytes(), TableFormat::Csv, Limits::default()).expect("can be read");
        for (key, ends) in KEYS.iter().zip(ENDS) {
            let known = || numbers.column(key).iter().flatten().copied();
            let reach = (known().fold(f64::INFINITY, f64::min), known().fold(f64::NEG_INFINITY, f64::max));
            assert_eq!(reach, ends, "{key}");
        }
    }
}
