//! Changed planes brought back into a design, and changes that keep distances.

use super::error::EditError;
use super::flat_size::Size;
use crate::design::meet_network::{Change, MeetNetwork};
use crate::design::tiers::{Design, Facet, Tier, Zone};
use crate::geometry::{Plane, Polyhedron};
use glam::DVec3;

/// A plane that moved by less than this part of the width, or turned by less than so many radians, did not
/// change: rounding.
const UNCHANGED: f64 = 1e-13;

/// The design with these planes in place of its own, in the order of its facets.
pub(super) fn to_design(was: &Design, network: &MeetNetwork, planes: &[Plane], change: &Change) -> Design {
    let mut design = was.clone();
    let teeth = design.gear.teeth;
    let size = network.width;
    let mut number = 0;
    let mut tiers = Vec::new();
    for tier in std::mem::take(&mut design.tiers) {
        let mut pieces: Vec<(f64, Tier)> = Vec::new();
        for facet in &tier.facets {
            let (old, new) = (facet.plane, planes[number]);
            let is_same = old.normal.distance(new.normal) < UNCHANGED
                && (old.distance - new.distance).abs() < UNCHANGED * size;
            let plane = if is_same { old } else { new };
            let turned = change.turns.get(network.part_of(number)).copied().unwrap_or(0.0);
            let index = facet.index.map(|i| match turned / std::f64::consts::TAU * teeth {
                0.0 => i,
                shift => on_wheel(rounded(i + shift), teeth.abs()),
            });
            let turn = angle(plane.normal) - angle(old.normal);
            let changed = Facet { name: facet.name.clone(), index, plane };
            match pieces.iter_mut().find(|(t, _)| (t - turn).abs() < 1e-9) {
                Some((_, piece)) => piece.facets.push(changed),
                None => pieces.push((
                    turn,
                    Tier {
                        name: tier.name.clone(),
                        angle_deg: tier.angle_deg.map(|a| turned_by(a, turn)),
                        instructions: String::new(),
                        facets: vec![changed],
                    },
                )),
            }
            number += 1;
        }
        // what the cutter is told stands after the last of the pieces, as after the tier
        if let Some((_, last)) = pieces.last_mut() {
            last.instructions = tier.instructions;
        }
        tiers.extend(pieces.into_iter().map(|(_, piece)| piece));
    }
    design.tiers = tiers;
    design.family = None;
    design
}

/// Angle from the girdle plane in degrees, without sign.
fn angle(normal: DVec3) -> f64 {
    normal.truncate().length().atan2(normal.z.abs()).to_degrees()
}

/// A stated angle, negative on the pavilion, that grew by so many degrees.
fn turned_by(stated: f64, turn: f64) -> f64 {
    if turn.abs() < 1e-11 { stated } else { rounded(stated + turn * stated.signum()) }
}

/// A number without the rounding of its last digits.
fn rounded(x: f64) -> f64 {
    (x * 1e9).round() / 1e9
}

/// The index as files have it: above 0 and up to the number of teeth.
fn on_wheel(index: f64, teeth: f64) -> f64 {
    match index.rem_euclid(teeth) {
        0.0 => teeth,
        index => index,
    }
}

/// The planes with angles and indices changed, and the distances from the middle as they were.
///
/// - `scaled`: the network after tangent ratios, `was`: before
pub(super) fn at_depths(
    scaled: &MeetNetwork,
    was: &MeetNetwork,
    change: &Change,
    sizes: &[(Size, f64)],
) -> Result<Vec<Plane>, EditError> {
    let mut planes = was.turned_in_place(scaled, change);
    let zones: Vec<Zone> = (0..planes.len()).map(|f| was.parts[was.part_of(f)].zone).collect();
    for (size, asked) in sizes {
        let moves = |zone: Zone| match size {
            Size::Table => zone == Zone::Table,
            Size::Girdle => matches!(zone, Zone::Table | Zone::Crown),
            Size::Culet => zone == Zone::Culet,
        };
        let at = |by: f64| -> Vec<Plane> {
            let moved = |(p, z): (&Plane, &Zone)| if moves(*z) { p.moved(DVec3::Z * by) } else { *p };
            planes.iter().zip(&zones).map(moved).collect()
        };
        planes = reached(*size, *asked, was.width, &at)?;
    }
    Ok(planes)
}

/// The planes of `at` moved so far that the size is what is asked for, by false position.
fn reached(
    size: Size,
    asked: f64,
    width: f64,
    at: &dyn Fn(f64) -> Vec<Plane>,
) -> Result<Vec<Plane>, EditError> {
    let lacks = |by: f64| -> Option<f64> {
        let solid = Polyhedron::from_planes(&at(by)).ok()?;
        Some(size.percent(&solid).unwrap_or(0.0) - asked)
    };
    let start = lacks(0.0).ok_or(EditError::Lacks(size.name()))?;
    // which way it grows, and a bracket
    let (mut low, mut high, mut at_low, mut at_high) = (0.0, 0.0, start, start);
    let mut step = 0.01 * width;
    'bracket: for _ in 0..10 {
        for by in [step, -step] {
            if let Some(value) = lacks(by).filter(|v| v * start <= 0.0) {
                (high, at_high) = (by, value);
                break 'bracket;
            }
        }
        step *= 1.6;
    }
    for _ in 0..60 {
        if start == 0.0 || at_low.abs().min(at_high.abs()) < 1e-9 {
            break;
        }
        if at_low * at_high > 0.0 {
            return Err(EditError::NotReached { target: size.name(), asked, nearest: asked + start });
        }
        let middle = 0.5 * (low + high);
        let value = lacks(middle).unwrap_or(-start);
        if value * at_low > 0.0 { (low, at_low) = (middle, value) } else { (high, at_high) = (middle, value) }
    }
    Ok(at(if at_low.abs() <= at_high.abs() { low } else { high }))
}
