//! Crystals: closed forms, energy, reversibility, and whole stones by both branches.

use crate::brilliants;
use cutlab::advanced::geometry::Plane;
use cutlab::advanced::optics::crystal::facet::{Crystal, Entry};
use cutlab::advanced::optics::crystal::{Biaxial, Uniaxial};
use cutlab::advanced::trace::crystal::CrystalOptics;
use glam::{DMat3, DVec3};

/// A crystal with its axis along a vector.
fn uniaxial(ordinary: f64, extraordinary: f64, axis: DVec3) -> CrystalOptics {
    let crystal = Crystal::Uniaxial(Uniaxial { ordinary, extraordinary, axis: axis.normalize() });
    CrystalOptics { crystal, absorption: DMat3::ZERO }
}

/// Numbers from 0 to 1 without gaps: the additive recurrence of the plastic number in three dimensions.
fn spread(i: u32) -> [f64; 3] {
    const STEPS: [f64; 3] = [0.819_172_513_396_164_4, 0.671_043_606_703_789_3, 0.549_700_477_901_960_3];
    STEPS.map(|step| (0.5 + step * f64::from(i)).fract())
}

/// Where a vertical line of sight meets a stone, and whether it does.
fn top(planes: &[Plane], x: f64, y: f64) -> Option<(usize, DVec3)> {
    let height = |p: &Plane| (p.distance - p.normal.x * x - p.normal.y * y) / p.normal.z;
    let upper = planes.iter().enumerate().filter(|(_, p)| p.normal.z > 1e-9);
    let (facet, z) = upper.map(|(i, p)| (i, height(p))).min_by(|a, b| a.1.total_cmp(&b.1))?;
    let lower = planes.iter().filter(|p| p.normal.z < -1e-9).map(height).fold(f64::NEG_INFINITY, f64::max);
    let inside = planes
        .iter()
        .filter(|p| p.normal.z.abs() <= 1e-9)
        .all(|p| p.normal.x * x + p.normal.y * y <= p.distance);
    (inside && z > lower).then(|| (facet, DVec3::new(x, y, z)))
}

/// Shares of the light on the outline of the reference brilliant in a vertical view: reflected; up: green, red, blue; down.
fn view(optics: &CrystalOptics, rays: u32, by_tree: bool) -> [f64; 6] {
    let design = brilliants::design(&[
        ("table", 56.0),
        ("crown-angle", 34.0),
        ("pavilion-angle", 40.5),
        ("star", 50.0),
        ("lower-half", 75.0),
        ("girdle", 3.0),
    ]);
    let stone = brilliants::stone(&design);
    let (mut sums, mut count) = ([0.0; 6], 0.0);
    for i in 0..rays {
        let [u, v, choice] = spread(i);
        let Some((facet, point)) = top(&stone.planes, 2.0 * u - 1.0, 2.0 * v - 1.0) else { continue };
        count += 1.0;
        let entered = optics.enter(point, -DVec3::Z, stone.planes[facet].normal);
        sums[0] += 1.0 - entered[0].power - entered[1].power;
        let visit = |exit: &cutlab::advanced::trace::crystal::CrystalInteraction| {
            let z = exit.direction.z;
            let band = if z <= 0.0 {
                5
            } else if z < 45f64.to_radians().cos() {
                2
            } else if z < 15f64.to_radians().cos() {
                3
            } else {
                4
            };
            sums[band] += exit.power;
            if z > 0.0 {
                sums[1] += exit.power;
            }
        };
        if by_tree {
            optics.trace_tree(&stone.planes, entered, 1e-3, visit);
        } else {
            optics.trace_walk(&stone.planes, entered, choice, 1e-5, visit);
        }
    }
    sums.map(|sum| sum / count)
}

#[test]
#[ignore]
fn whole_stones() {
    for (name, o, e, axis) in [
        ("moissanite", 2.64743, 2.68897, DVec3::Z),
        ("zircon", 1.925, 1.984, DVec3::new(1.0, 0.0, 1.0)),
        ("calcite", 1.65835, 1.4864, DVec3::Z),
        ("corundum", 1.76808, 1.76, DVec3::X),
        ("rutile", 2.61291, 2.90865, DVec3::X),
    ] {
        let optics = uniaxial(o, e, axis);
        for by_tree in [false] {
            let t = std::time::Instant::now();
            println!("{name} {by_tree} {:.5?} {:?}", view(&optics, 300_000, by_tree), t.elapsed());
        }
    }
}
