//! Right prisms over a regular polygon.

use super::{CutError, Family, Parameter, ParameterValues, whole_number};
use crate::design::tiers::{Design, Gear, LengthUnit, Tier};

/// A right prism: two horizontal ends and `sides` vertical faces.
pub static FAMILY: Family = Family {
    name: "prism",
    about: "right prism over a regular polygon, standing upright",
    parameters: &[
        Parameter { key: "sides", default: 6.0, range: (3.0, 360.0), unit: "", about: "number of sides" },
        Parameter { key: "height", default: 6.5, range: (1e-3, 1e3), unit: " mm", about: "height" },
        Parameter {
            key: "size",
            default: 6.5,
            range: (1e-3, 1e3),
            unit: " mm",
            about: "diameter of the circle inside the polygon",
        },
    ],
    heights: &[],
    total: None,
    build,
};

fn build(v: &ParameterValues) -> Result<Design, CutError> {
    let sides = whole_number("sides", v.get("sides"))?;
    let (height, radius) = (v.get("height"), v.get("size") / 2.0);
    let gear = Gear { teeth: sides as f64, offset: 0.0 };
    let indices: Vec<f64> = (0..sides).map(|i| i as f64).collect();
    let mut design = Design::new(format!("prism of {sides} sides"));
    design.unit = LengthUnit::Millimetre;
    design.gear = gear;
    design.symmetry = Some((sides as u32, true));
    design.tiers = vec![
        Tier::new("side", gear, 90.0, radius, &indices),
        Tier::new("table", gear, 0.0, height / 2.0, &[0.0]),
        Tier::new("culet", gear, -0.0, height / 2.0, &[0.0]),
    ];
    Ok(design)
}
