//! Lanes against the `f64` twin over whole traces.

use super::stones::*;
use cutlab::advanced::geometry::Plane;
use cutlab::advanced::sampling::random::{Purpose, Stream};
use cutlab::advanced::trace::{ConvexStone, LANES, reference};

/// A facet may win over the nearest one if it is nearer than this behind it (trace units: the
/// stone's radius is 1): distances are good to 1e-7 over the cosine of incidence.
const TIE: f64 = 2e-5;

/// Lanes against the twin over whole traces, from the same start through the same planes.
///
/// Both must meet the same facets in the same order until a rounding decides: there the lane's
/// facet lies within `TIE` × bounces so far of the twin's (a flat mirror lets errors grow with the
/// path, not faster). Power that left is the same to 1e-4, but for what the critical angle makes of
/// an error: cos² outside is off by 1e-6 an interaction so far, the cosine by that over itself or its
/// root, the share that passes by up to ten times that.
#[test]
fn lanes_trace_as_their_twin_does() {
    let stone = ConvexStone::new(brilliant());
    let planes = stone.kernel_planes();
    let mut s = Stream::new(SEED, Purpose::TEST, 400);
    let (mut walks, mut parted) = (0, 0);
    for _ in 0..60 {
        let (start, _) = entering(&stone, &mut s, DIAMOND);
        let mut met: Vec<Vec<(usize, f64)>> = vec![Vec::new(); LANES];
        let mut last = start.power;
        stone.trace(&mut start.clone(), 1e-3, |m, p| {
            for l in 0..LANES {
                if last[l] > 0.0 {
                    met[l].push((m.facet[l] as usize, f64::from(m.power[l])));
                }
                last[l] = if p.power[l] < 1e-3 { 0.0 } else { p.power[l] };
            }
        });
        for (lane, met) in met.iter().enumerate() {
            let ray = twin_of(&start, lane);
            walks += 1;
            parted += usize::from(!same_way(&planes, ray, met));
        }
    }
    assert!(parted * 100 <= walks, "{parted} of {walks} walks part");
}

/// Whether the lane's bounces are the twin's; asserts that where they part a rounding decided.
fn same_way(planes: &[Plane], ray: reference::ScalarRay, met: &[(usize, f64)]) -> bool {
    let (mut at, mut together) = (0, true);
    let (mut held, mut tolerance) = (ray.power, 1e-4);
    let mut from = (ray.point, ray.direction);
    reference::trace(planes, ray, 1e-4, |m| {
        let Some(&(facet, power)) = met.get(at) else { return };
        if together && facet != m.facet {
            let there = distance_to(&planes[facet], from.0, from.1);
            let behind = there.map(|d| d - m.point.distance(from.0));
            let tie = TIE * (at + 1) as f64;
            assert!(
                behind.is_some_and(|b| b < tie),
                "meeting {at}: {facet} is {behind:?} behind {}",
                m.facet
            );
            together = false;
        }
        if together {
            let off = 1e-6 * (at + 1) as f64;
            tolerance += 10.0 * held * off.sqrt().min(off / m.cos_outside.max(f64::MIN_POSITIVE));
            assert!((power - m.power).abs() < tolerance, "meeting {at}: {power} for {}", m.power);
            held -= m.power;
        }
        let normal = planes[m.facet].normal;
        from = (m.point, (from.1 - 2.0 * from.1.dot(normal) * normal).normalize());
        at += 1;
    });
    together
}
