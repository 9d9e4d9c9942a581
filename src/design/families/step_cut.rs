//! Step cuts: emerald, Asscher, baguette, square step.

use super::fancy_brilliant::tiers_of;
use super::{CutError, Family, Parameter, ParameterValues, check_every_facet_stands, whole_number};
use crate::design::tiers::{Design, LengthUnit};
use crate::geometry::Plane;
use glam::{DVec2, DVec3};

/// A step cut over a rectangle, corners cut off or not.
pub static FAMILY: Family = Family {
    name: "step-cut",
    about: "step cut over a rectangle with or without cut corners; ends in a keel, a square one in a point",
    parameters: &[
        Parameter {
            key: "length-to-width",
            default: 1.4,
            range: (1.0, 6.0),
            unit: "",
            about: "length of the outline over its width",
        },
        Parameter {
            key: "corner",
            default: 15.0,
            // 29.3 makes a square an octagon; more would make it narrower across its corners
            range: (0.0, 29.0),
            unit: "%",
            about: "how much a cut corner takes off each side, of the width; 0 leaves sharp corners",
        },
        Parameter {
            key: "table",
            default: 60.0,
            range: (20.0, 95.0),
            unit: "%",
            about: "table along the width",
        },
        Parameter {
            key: "crown-angle",
            default: 35.0,
            range: (5.0, 70.0),
            unit: "°",
            about: "angle of the crown's middle step",
        },
        Parameter {
            key: "crown-steps",
            default: 3.0,
            range: (1.0, 8.0),
            unit: "",
            about: "steps of the crown",
        },
        Parameter {
            key: "crown-spread",
            default: 6.0,
            range: (0.0, 20.0),
            unit: "°",
            about: "how much each crown step is flatter than the one below it",
        },
        Parameter {
            key: "pavilion-angle",
            default: 42.0,
            range: (5.0, 80.0),
            unit: "°",
            about: "angle of the lowest pavilion step",
        },
        Parameter {
            key: "pavilion-steps",
            default: 3.0,
            range: (1.0, 8.0),
            unit: "",
            about: "steps of the pavilion",
        },
        Parameter {
            key: "pavilion-spread",
            default: 7.0,
            range: (0.0, 20.0),
            unit: "°",
            about: "how much each pavilion step is steeper than the one below it",
        },
        Parameter { key: "girdle", default: 3.0, range: (0.1, 50.0), unit: "%", about: "girdle thickness" },
        Parameter { key: "size", default: 6.5, range: (1e-3, 1e3), unit: " mm", about: "girdle width" },
    ],
    heights: &[],
    total: None,
    build,
};

/// One side of the outline: where it stands, and where at the middle of the stone, so that sides
/// and ends keep one slope and the corners shrink to nothing on the keel's ends.
struct GirdleSide {
    normal: DVec2,
    outer: f64,
    inner: f64,
}

fn sides(length: f64, corner: f64) -> Vec<GirdleSide> {
    let mut sides = Vec::new();
    for (x, y) in [(0.0, -1.0), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0)] {
        let reach = if x == 0.0 { length } else { 1.0 };
        sides.push(GirdleSide { normal: DVec2::new(x, y), outer: reach, inner: reach - 1.0 });
    }
    if corner > 0.0 {
        // `corner` of the width, 2, along each side; the normal leans so that a long stone's too
        // is cut at 45°
        for (x, y) in [(1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)] {
            let normal = DVec2::new(x, y) * std::f64::consts::FRAC_1_SQRT_2;
            let outer = (1.0 + length - 2.0 * corner) * std::f64::consts::FRAC_1_SQRT_2;
            sides.push(GirdleSide { normal, outer, inner: (length - 1.0) * std::f64::consts::FRAC_1_SQRT_2 });
        }
    }
    sides
}

fn build(v: &ParameterValues) -> Result<Design, CutError> {
    let radius = v.get("size") / 2.0;
    let [corner, table, girdle] = ["corner", "table", "girdle"].map(|k| v.get(k) / 100.0);
    let sides = sides(v.get("length-to-width"), corner);
    let steps = |key| whole_number(key, v.get(key));
    let (crown_steps, pavilion_steps) = (steps("crown-steps")?, steps("pavilion-steps")?);
    let middle = (crown_steps as f64 - 1.0) / 2.0;
    let crown: Vec<f64> = (0..crown_steps)
        .map(|j| v.get("crown-angle") + v.get("crown-spread") * (middle - j as f64))
        .collect();
    let pavilion: Vec<f64> = (0..pavilion_steps)
        .map(|j| v.get("pavilion-angle") + v.get("pavilion-spread") * (pavilion_steps - 1 - j) as f64)
        .collect();
    if let Some(angle) = crown.iter().chain(&pavilion).find(|a| !(1.0..89.0).contains(*a)) {
        return Err(CutError::Impossible {
            problem: "a step would be flat or upright",
            bound: format!("the spread gives a step of {angle:.1}°, outside 1 to 89°"),
        });
    }
    let mut design = Design::new("step cut");
    let gear = design.gear;
    let mut add = |name: String, planes: Vec<Plane>| design.tiers.extend(tiers_of(&name, gear, planes));
    // to the keel, half the width in; to the table
    for (zone, up, angles, inset) in [("pavilion", -1.0, &pavilion, 1.0), ("crown", 1.0, &crown, 1.0 - table)]
    {
        let width = inset / angles.len() as f64;
        let mut height = girdle;
        for (j, angle) in angles.iter().enumerate() {
            let slope = angle.to_radians().tan();
            let t = j as f64 * width;
            let planes = sides.iter().map(|side| step(side, t, up * height, up * slope).scaled(radius));
            add(format!("{zone} step {}", j + 1), planes.collect());
            height += width * slope;
        }
        if zone == "crown" {
            add("table".into(), vec![Plane { normal: DVec3::Z, distance: height * radius }]);
        } else {
            let walls =
                sides.iter().map(|s| Plane { normal: s.normal.extend(0.0), distance: s.outer * radius });
            add("girdle".into(), walls.collect());
        }
    }
    let square = v.get("length-to-width") == 1.0;
    design.symmetry = Some((if square { 4 } else { 2 }, true));
    design.unit = LengthUnit::Millimetre;
    check_every_facet_stands(&design)?;
    Ok(design)
}

/// A step's plane: at inset `t` of the way from girdle to keel it stands at `height`, and climbs by
/// `slope` for each half width inward (negative: falls).
fn step(side: &GirdleSide, t: f64, height: f64, slope: f64) -> Plane {
    let run = side.outer - side.inner;
    let normal = (side.normal * slope.abs()).extend(run.copysign(slope)).normalize();
    let place = (side.normal * (side.outer - t * run)).extend(height);
    Plane { normal, distance: normal.dot(place) }
}
