//! The index wheel around a plan: ticks, numbers, and a longer tick at every index that is cut.

use super::projection::DiagramView;
use super::sheet::{CAPITAL, DECIMALS, HAIR, Sheet, width};
use crate::design::Gear;
use crate::report::svg_canvas::{Anchor, PathData};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// Font size of the numbers, in mm.
const NUMBER: f64 = 2.2;

/// Width of the ticks of indices that are cut, in mm.
const CUT: f64 = 0.35;

/// Room outside the ring of ticks, in mm.
pub const OUTSIDE: f64 = 5.2;

/// Room that ticks take inside the ring, in mm.
pub const INSIDE: f64 = 1.8;

/// The name of an index: as a cutter reads it off the wheel, 0 as the last tooth.
///
/// Two digits at least; teeth in between to two decimals.
pub fn index_name(index: f64, gear: Gear) -> String {
    let teeth = gear.teeth.abs();
    let digits = if teeth >= 100.0 { 3 } else { 2 };
    let hundredths = (index.rem_euclid(teeth) * 100.0).round();
    let hundredths = if hundredths < 1.0 { (teeth * 100.0).round() } else { hundredths };
    let (whole, rest) = ((hundredths / 100.0).floor(), hundredths.rem_euclid(100.0));
    let name = format!("{whole:0digits$.0}");
    if rest == 0.0 {
        return name;
    }
    format!("{name}.{rest:02.0}")
}

/// Direction of an index on the page.
fn towards(index: f64, gear: Gear, view: DiagramView) -> DVec2 {
    let (sin, cos) = (TAU * (index - gear.offset) / gear.teeth).sin_cos();
    view.project(DVec3::new(sin, -cos, 0.0))
}

/// Every how many teeth a number stands: the least divisor of the wheel that leaves room for them.
fn step(teeth: usize, radius: f64) -> usize {
    /// Least distance of two numbers along the ring, in mm.
    const APART: f64 = 6.0;
    let apart = TAU * radius / teeth as f64;
    (1..teeth).find(|s| teeth.is_multiple_of(*s) && *s as f64 * apart >= APART).unwrap_or(teeth)
}

/// Draws the wheel.
///
/// - `radius`: of the ring, in mm
/// - `cut`: the indices of the tiers in this view
pub fn draw(pen: &mut Sheet, gear: Gear, view: DiagramView, centre: DVec2, radius: f64, cut: &[f64]) {
    let teeth = gear.teeth.abs().round() as usize;
    if !(1..=10_000).contains(&teeth) {
        return;
    }
    let step = step(teeth, radius);
    // a tick for every tooth, unless they would run into one another
    let every = if TAU * radius / teeth as f64 >= 0.8 { 1 } else { step };
    let tick = |path: PathData, index: f64, from: f64, to: f64| {
        let d = towards(index, gear, view);
        path.line([from, to].map(|out| centre + d * (radius + out)))
    };
    let ticks =
        (0..teeth).step_by(every).fold(PathData::new(DECIMALS).circle(centre, radius), |path, tooth| {
            tick(path, tooth as f64, 0.0, if tooth.is_multiple_of(step) { 1.5 } else { 0.8 })
        });
    let used = cut.iter().fold(PathData::new(DECIMALS), |path, index| tick(path, *index, -INSIDE, 0.0));
    pen.lines(ticks, HAIR);
    pen.named_lines(&format!("{}-indices", view.name()), used, CUT);
    for tooth in (0..teeth).step_by(step) {
        let name = index_name(tooth as f64, gear);
        let half = DVec2::new(0.5 * width(&name, NUMBER, false), 0.5 * CAPITAL * NUMBER);
        let at = centre + towards(tooth as f64, gear, view) * (radius + 1.7 + half.length().min(1.9));
        pen.text(at + DVec2::new(0.0, half.y), NUMBER, Anchor::Middle, false, &name);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices_read_as_on_the_wheel() {
        let gear = Gear::default();
        let read = |i| index_name(i, gear);
        assert_eq!(
            [0.0, 3.0, 2.5, 95.999, 96.0, -3.0, 8.25].map(read),
            ["96", "03", "02.50", "96", "96", "93", "08.25"]
        );
        assert_eq!(index_name(7.0, Gear { teeth: -120.0, offset: 0.0 }), "007");
    }

    #[test]
    fn the_front_is_at_the_foot_and_the_pavilion_runs_the_other_way_round() {
        let gear = Gear::default();
        let at = |i, view| towards(i, gear, view);
        for view in [DiagramView::Crown, DiagramView::Pavilion] {
            assert!((at(0.0, view) - DVec2::Y).length() < 1e-12);
        }
        assert!((at(24.0, DiagramView::Crown) - DVec2::X).length() < 1e-12);
        assert!((at(24.0, DiagramView::Pavilion) + DVec2::X).length() < 1e-12);
    }

    #[test]
    fn numbers_stand_at_divisors_with_room_between() {
        assert_eq!([96, 64, 80, 72, 77, 32].map(|teeth| step(teeth, 38.0)), [3, 2, 4, 2, 7, 1]);
    }
}
