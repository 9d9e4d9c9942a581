//! Scalar, portable, AVX2 and AVX-512 traces of the same rays.

use super::stones::*;
use cutlab::advanced::sampling::random::{Purpose, Stream};
use cutlab::advanced::trace::beams::{
    BeamExit, BeamVisitor, Beams, IncidentBeam, StopCriteria, UnpolarisedLight,
};
use cutlab::advanced::trace::{ConvexStone, Isa, LANES, reference};
use glam::{DVec3, Vec3};

const PACKETS: usize = 400;

/// Power that each packet's rays send upward, on one instruction set.
fn upward(isa: Isa) -> Vec<f64> {
    let stone = ConvexStone::with_isa(brilliant(), isa);
    let mut s = Stream::new(SEED, Purpose::TEST, 500);
    let packet = |_| {
        let (mut packet, _) = entering(&stone, &mut s, DIAMOND);
        let mut up = 0.0;
        stone.trace(&mut packet, 1e-5, |m, _| {
            up += (0..LANES).filter(|l| m.dz[*l] > 0.0).map(|l| f64::from(m.power[l])).sum::<f64>();
        });
        up
    };
    (0..PACKETS).map(packet).collect()
}

/// The same of the `f64` twin.
fn upward_of_twin() -> Vec<f64> {
    let stone = ConvexStone::new(brilliant());
    let planes = stone.kernel_planes();
    let mut s = Stream::new(SEED, Purpose::TEST, 500);
    let packet = |_| {
        let (packet, _) = entering(&stone, &mut s, DIAMOND);
        let mut up = 0.0;
        for lane in 0..LANES {
            let upward =
                |m: &reference::ScalarInteraction| up += if m.direction.z > 0.0 { m.power } else { 0.0 };
            reference::trace(&planes, twin_of(&packet, lane), 1e-5, upward);
        }
        up
    };
    (0..PACKETS).map(packet).collect()
}

/// A rounding decides now and then at an edge, and that light goes elsewhere: without preference,
/// so the mean of the differences is zero within three of its own errors.
#[test]
fn all_agree_on_totals_within_three_errors() {
    let twin = upward_of_twin();
    let mean = |of: &[f64]| of.iter().sum::<f64>() / of.len() as f64;
    for isa in Isa::all() {
        let off: Vec<f64> = upward(isa).iter().zip(&twin).map(|(a, b)| a - b).collect();
        let squares: Vec<f64> = off.iter().map(|o| (o - mean(&off)).powi(2)).collect();
        let error = (mean(&squares) / (off.len() - 1) as f64).sqrt();
        println!("{}: {:.2e} ± {error:.2e} of {:.3} a packet", isa.name(), mean(&off), mean(&twin));
        // roundings of what each ray sends out, besides those of its way
        assert!(mean(&off).abs() < 3.0 * error + 1e-6 * LANES as f64, "{}", isa.name());
        assert!(error < 1e-3 * mean(&twin), "{}: too noisy to tell", isa.name());
    }
}

/// From the same state, all name the same facet but where two are equally near: one ray in ten
/// thousand, some of those that start in an edge or head for one.
#[test]
fn all_agree_facet_by_facet() {
    let stones: Vec<_> = Isa::all().into_iter().map(|isa| ConvexStone::with_isa(brilliant(), isa)).collect();
    let mut s = Stream::new(SEED, Purpose::TEST, 501);
    let (mut asked, mut differ) = (0, 0);
    for _ in 0..PACKETS {
        let (mut packet, _) = entering(&stones[0], &mut s, DIAMOND);
        stones[0].trace(&mut packet, 1e-2, |_, packet| {
            let found: Vec<_> = stones.iter().map(|stone| stone.next_facets(packet)).collect();
            for l in (0..LANES).filter(|l| packet.power[*l] > 0.0) {
                asked += 1;
                for other in &found[1..] {
                    let (a, b) = (found[0].distance[l], other.distance[l]);
                    if other.facet[l] == found[0].facet[l] {
                        // a distance is good to a rounding of the height over the cosine
                        assert!((a - b).abs() < 1e-3, "{a} {b}");
                    } else {
                        assert!((a - b).abs() < 1e-4, "{a} {b}");
                        differ += 1;
                    }
                }
            }
        });
    }
    println!("{differ} of {asked} facets differ");
    assert!(asked > 50_000 && differ * 10_000 < asked * stones.len(), "{differ} of {asked}");
}

struct Unwatched;

impl<L> BeamVisitor<L, 1> for Unwatched {
    fn exit(&mut self, _: &BeamExit<L, 1>) {}
}

/// Every kernel on every set, with no more work than Miri can do (`tools/sanitize`): light is kept.
#[test]
fn every_kernel_keeps_the_light_of_a_cube() {
    for isa in Isa::all() {
        println!("{}", isa.name());
        let stone = ConvexStone::with_isa(cube(), isa);
        for (polarised, absorbing) in [(true, false), (false, false), (true, true), (false, true)] {
            let mut s = Stream::new(SEED, Purpose::TEST, 502);
            let (mut packet, _) = entering(&stone, &mut s, 1.5);
            (packet.polarised, packet.absorbing, packet.absorption) = (polarised, absorbing, [0.1; LANES]);
            let entered: f32 = packet.power.iter().sum();
            assert_eq!(stone.next_facets(&packet).facet.iter().filter(|f| **f < 6).count(), LANES);
            let mut out = 0.0;
            let lost = stone.trace(&mut packet, 0.1, |m, _| out += m.power.iter().sum::<f32>());
            let kept = out + lost;
            assert!(kept <= entered + 1e-4, "{}: {entered} in, {kept} out", isa.name());
            assert_eq!((kept - entered).abs() < 1e-4, !absorbing, "{}: {entered} {kept}", isa.name());
        }
        assert!(stone.intersect(Vec3::new(0.1, 0.2, 3.0), Vec3::NEG_Z).is_some());
        let lit = IncidentBeam { direction: DVec3::new(0.1, 0.2, -0.9).normalize(), indices: [1.5] };
        let totals = Beams::new(&stone).trace(
            &lit,
            UnpolarisedLight(1.0),
            StopCriteria::at_power(1e-2),
            &mut Unwatched,
        );
        assert!((totals.sum() - 1.0).abs() < 1e-9, "{}: {totals:?}", isa.name());
    }
}
