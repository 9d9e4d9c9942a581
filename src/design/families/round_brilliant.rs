//! The round brilliant: 57 facets and a girdle of flats; 153 facets with a girdle of 96.

use super::{CutError, Family, Parameter, ParameterValues, check_every_facet_stands, whole_number};
use crate::design::tiers::{Design, Gear, LengthUnit, Tier};

/// The round brilliant. The defaults are the reference stone of the light-return literature.
pub static FAMILY: Family = Family {
    name: "round-brilliant",
    about: "round brilliant: 57 facets and a girdle of flats (96: 153 facets in all)",
    parameters: &[
        Parameter {
            key: "table",
            default: 56.0,
            range: (20.0, 95.0),
            unit: "%",
            about: "table, corner to corner",
        },
        Parameter {
            key: "crown-angle",
            default: 34.0,
            range: (0.0, 70.0),
            unit: "°",
            about: "angle of the crown mains",
        },
        Parameter {
            key: "pavilion-angle",
            default: 40.5,
            range: (5.0, 80.0),
            unit: "°",
            about: "angle of the pavilion mains",
        },
        Parameter {
            key: "star",
            default: 50.0,
            range: (1.0, 99.0),
            unit: "%",
            about: "star length, from table edge to girdle in plan",
        },
        Parameter {
            key: "lower-half",
            default: 75.0,
            range: (1.0, 100.0),
            unit: "%",
            about: "lower half length, from girdle to culet in plan",
        },
        Parameter {
            key: "girdle",
            default: 3.0,
            range: (0.0, 50.0),
            unit: "%",
            about: "girdle thickness at its thick places",
        },
        Parameter {
            key: "culet",
            default: 0.0,
            range: (0.0, 30.0),
            unit: "%",
            about: "culet, flat to flat; 0 is a sharp point",
        },
        Parameter {
            key: "girdle-facets",
            default: 96.0,
            range: (16.0, 960.0),
            unit: "",
            about: "number of girdle flats, a multiple of 16",
        },
        Parameter { key: "size", default: 6.5, range: (1e-3, 1e3), unit: " mm", about: "girdle diameter" },
    ],
    heights: super::heights::OF_BRILLIANTS,
    total: Some(("girdle-facets", 16)),
    build,
};

/// Angles that follow from the lengths, in degrees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DerivedAngles {
    /// Star.
    pub star: f64,
    /// Upper half.
    pub upper_half: f64,
    /// Lower half.
    pub lower_half: f64,
}

const HALF_MAIN_DEG: f64 = 22.5;
const HALF_DEG: f64 = 11.25;

/// Angles of stars and halves of a round brilliant of radius 1.
///
/// - `table`, `star`, `lower_half`: fractions; `crown_deg`, `pavilion_deg`: main angles
///
/// With A = t cos 22.5°, r_s = A + s(1 − A), r_l = 1 − ℓ: the star passes through two table corners
/// and the point at r_s where two mains meet; the halves through the girdle ends of a main and the
/// points at r_s, r_l. Checked against the project's table of worked rows in
/// `tests/library/round_brilliant.rs`.
pub fn derived_angles(
    table: f64,
    crown_deg: f64,
    pavilion_deg: f64,
    star: f64,
    lower_half: f64,
) -> DerivedAngles {
    let (cos_half_main, cos_half) = (HALF_MAIN_DEG.to_radians().cos(), HALF_DEG.to_radians().cos());
    let (crown, pavilion) = (crown_deg.to_radians().tan(), pavilion_deg.to_radians().tan());
    let apothem = table * cos_half_main;
    let r_s = apothem + star * (1.0 - apothem);
    let r_l = 1.0 - lower_half;
    let half = |main: f64, r: f64| main * (1.0 - r * cos_half_main) / ((1.0 - r) * cos_half);
    DerivedAngles {
        star: (crown * (r_s * cos_half_main - table) / (r_s - apothem)).atan().to_degrees(),
        upper_half: half(crown, r_s).atan().to_degrees(),
        lower_half: half(pavilion, r_l).atan().to_degrees(),
    }
}

fn build(v: &ParameterValues) -> Result<Design, CutError> {
    let radius = v.get("size") / 2.0;
    let [table, star, lower, girdle, culet] =
        ["table", "star", "lower-half", "girdle", "culet"].map(|key| v.get(key) / 100.0);
    let (crown, pavilion) = (v.get("crown-angle"), v.get("pavilion-angle"));
    let flats = whole_number("girdle-facets", v.get("girdle-facets"))?;
    if flats % 16 != 0 {
        return Err(CutError::Impossible {
            problem: "girdle flats must pair with the halves",
            bound: format!("girdle-facets = {flats} is not a multiple of 16"),
        });
    }
    let angles = derived_angles(table, crown, pavilion, star, lower);
    check_lengths(table, star, girdle, angles)?;

    // heights: 0 in the middle of the girdle
    let top = girdle * radius;
    let bottom = -top;
    let table_height = top + radius * (1.0 - table) * crown.to_radians().tan();
    let cos = |deg: f64| deg.to_radians().cos();
    // a plane at angle a through the point at (plan distance r along its azimuth, height z)
    let through = |a: f64, r: f64, z: f64| r * a.to_radians().sin() + z.abs() * cos(a);
    let gear = Gear::default();
    let every = |from: f64, step: f64| -> Vec<f64> {
        (0..(96.0 / step) as usize).map(|i| from + step * i as f64).collect()
    };
    let half_radius = radius * cos(HALF_DEG);
    let mut tiers = vec![
        Tier::new("pavilion main", gear, -pavilion, through(pavilion, radius, bottom), &every(0.0, 12.0)),
        Tier::new(
            "lower half",
            gear,
            -angles.lower_half,
            through(angles.lower_half, half_radius, bottom),
            &every(3.0, 6.0),
        ),
        Tier::new("girdle", gear, 90.0, radius, &every(0.0, 96.0 / flats as f64)),
        // before the rest of the crown: with a crown angle of 0 all its planes merge into this one
        Tier::new("table", gear, 0.0, table_height, &[0.0]),
        Tier::new(
            "upper half",
            gear,
            angles.upper_half,
            through(angles.upper_half, half_radius, top),
            &every(3.0, 6.0),
        ),
        Tier::new("crown main", gear, crown, through(crown, radius, top), &every(0.0, 12.0)),
        Tier::new(
            "star",
            gear,
            angles.star,
            through(angles.star, radius * table * cos(HALF_MAIN_DEG), table_height),
            &every(6.0, 12.0),
        ),
    ];
    if culet > 0.0 {
        let depth = top + radius * (1.0 - culet) * pavilion.to_radians().tan();
        tiers.insert(2, Tier::new("culet", gear, -0.0, depth, &[0.0]));
    }
    let mut design = Design::new("round brilliant");
    design.symmetry = Some((8, true));
    design.unit = LengthUnit::Millimetre;
    design.tiers = tiers;
    if crown > 0.0 {
        check_every_facet_stands(&design)?;
    }
    Ok(design)
}

fn check_lengths(table: f64, star: f64, girdle: f64, angles: DerivedAngles) -> Result<(), CutError> {
    let cos_half_main = HALF_MAIN_DEG.to_radians().cos();
    let apothem = table * cos_half_main;
    let least_star = (table / cos_half_main - apothem) / (1.0 - apothem);
    if star <= least_star {
        return Err(CutError::Impossible {
            problem: "the stars would cross",
            bound: format!(
                "star must be above {:.1}% with a table of {:.1}%",
                least_star * 100.0,
                table * 100.0
            ),
        });
    }
    let tan = |deg: f64| deg.to_radians().tan();
    let dip = 0.5 * (1.0 - HALF_DEG.to_radians().cos()) * (tan(angles.upper_half) + tan(angles.lower_half));
    if girdle <= dip {
        return Err(CutError::Impossible {
            problem: "the girdle would vanish at its thin places",
            bound: format!("girdle must be above {:.2}% with these angles", dip * 100.0),
        });
    }
    Ok(())
}
