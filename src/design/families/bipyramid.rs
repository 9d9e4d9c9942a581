//! Bipyramids over a regular polygon; the regular octahedron among them.

use super::{CutError, Family, Parameter, ParameterValues, whole_number};
use crate::design::tiers::{Design, Gear, LengthUnit, Tier};

/// A bipyramid: `sides` facets above, as many below, meeting in an edge at the girdle.
pub static FAMILY: Family = Family {
    name: "bipyramid",
    about: "bipyramid over a regular polygon, standing on its point",
    parameters: &[
        Parameter { key: "sides", default: 4.0, range: (3.0, 360.0), unit: "", about: "number of sides" },
        Parameter {
            key: "height",
            default: 6.5,
            range: (1e-3, 1e3),
            unit: " mm",
            about: "height from point to point",
        },
        Parameter {
            key: "corner-diameter",
            default: 6.5,
            range: (1e-3, 1e3),
            unit: " mm",
            about: "diameter of the circle through the girdle's corners",
        },
    ],
    heights: &[],
    total: None,
    build,
};

fn build(v: &ParameterValues) -> Result<Design, CutError> {
    let sides = whole_number("sides", v.get("sides"))?;
    let half_height = v.get("height") / 2.0;
    // corners stand at ±x and ±y for four sides: facets lie half a step off index 0
    let flat_radius = v.get("corner-diameter") / 2.0 * (std::f64::consts::PI / sides as f64).cos();
    let slope = flat_radius.hypot(half_height);
    let (angle, distance) =
        ((half_height / flat_radius).atan().to_degrees(), flat_radius * half_height / slope);
    let gear = Gear { teeth: 2.0 * sides as f64, offset: 0.0 };
    let indices: Vec<f64> = (0..sides).map(|i| (2 * i + 1) as f64).collect();
    let mut design = Design::new(format!("bipyramid of {sides} sides"));
    design.unit = LengthUnit::Millimetre;
    design.gear = gear;
    design.symmetry = Some((sides as u32, true));
    design.tiers = vec![
        Tier::new("pavilion", gear, -angle, distance, &indices),
        Tier::new("crown", gear, angle, distance, &indices),
    ];
    Ok(design)
}
