//! Polarised light: the Mueller matrices against field components, the lanes against the twin,
//! energy, and what polarisation does to a view.

use cutlab::advanced::estimators::{BatchedEstimate, TraceOptics, View, view};
use cutlab::advanced::materials::Material;
use cutlab::advanced::optics::fresnel::FresnelCoefficients;
use cutlab::advanced::optics::stokes::Stokes;
use cutlab::advanced::sampling::random::{Purpose, Stream};
use cutlab::advanced::sampling::warps;
use cutlab::advanced::trace::{ConvexStone, Isa, LANES, Packet, reference};
use glam::Vec3;
use std::collections::BTreeMap;

const SEED: u64 = 7_319;
const INDEX: f64 = 2.417;

fn brilliant(isa: Isa) -> ConvexStone {
    let design =
        cutlab::advanced::design::families::build("round-brilliant", &BTreeMap::new()).expect("builds");
    ConvexStone::with_isa(design.solid().expect("closed"), isa)
}

/// A complex number, for the field.
#[derive(Clone, Copy)]
struct C(f64, f64);

impl C {
    fn times(self, o: C) -> C {
        C(self.0 * o.0 - self.1 * o.1, self.0 * o.1 + self.1 * o.0)
    }
    fn over(self, o: C) -> C {
        let size = o.0 * o.0 + o.1 * o.1;
        let t = self.times(C(o.0, -o.1));
        C(t.0 / size, t.1 / size)
    }
    fn size2(self) -> f64 {
        self.0 * self.0 + self.1 * self.1
    }
}

/// Fresnel's amplitude coefficients from inside a stone of index `n`, as textbooks print them, the
/// cosine outside imaginary beyond the critical angle.
fn amplitudes(cos_i: f64, n: f64) -> (C, C) {
    let sin2_t = n * n * (1.0 - cos_i * cos_i);
    let cos_t = if sin2_t < 1.0 { C((1.0 - sin2_t).sqrt(), 0.0) } else { C(0.0, (sin2_t - 1.0).sqrt()) };
    let s = C(n * cos_i - cos_t.0, -cos_t.1).over(C(n * cos_i + cos_t.0, cos_t.1));
    let p = C(cos_i - n * cos_t.0, -n * cos_t.1).over(C(cos_i + n * cos_t.0, n * cos_t.1));
    (s, p)
}

/// [D] Unpolarised light is two fields at right angles, half each: the power that every interaction
/// lets out is the mean of both, carried as complex components over fifty facets.
#[test]
fn stokes_vectors_agree_with_fields() {
    let mut stream = Stream::new(SEED, Purpose::TEST, 0);
    let mut unit =
        || warps::to_world(Vec3::Z, warps::uniform_cone(stream.pair(), -1.0)).as_dvec3().normalize();
    for _ in 0..200 {
        let mut direction = unit();
        let mut axis = direction.any_orthonormal_vector();
        let mut light = Stokes::unpolarised(1.0, axis);
        let mut fields = [[C(1.0, 0.0), C(0.0, 0.0)], [C(0.0, 0.0), C(1.0, 0.0)]];
        for interaction in 0..50 {
            let mut normal = unit();
            if normal.dot(direction) < 0.0 {
                normal = -normal;
            }
            let cos_i = normal.dot(direction);
            light = light
                .about_incidence(direction, normal)
                .reflected(&FresnelCoefficients::new(cos_i, 1.0 / INDEX));

            let across = direction.cross(normal).normalize();
            let (cos, sin) = (axis.dot(across), direction.cross(axis).dot(across));
            let (r_s, r_p) = amplitudes(cos_i, INDEX);
            for [s, p] in &mut fields {
                let turned_s = C(cos * s.0 + sin * p.0, cos * s.1 + sin * p.1);
                let turned_p = C(cos * p.0 - sin * s.0, cos * p.1 - sin * s.1);
                (*s, *p) = (turned_s.times(r_s), turned_p.times(r_p));
            }
            axis = across;
            direction = (direction - 2.0 * cos_i * normal).normalize();
            let power: f64 = fields.iter().flatten().map(|c| 0.5 * c.size2()).sum();
            assert!((light.i - power).abs() < 1e-12, "interaction {interaction}: {} {power}", light.i);
            let size2 = light.q.powi(2) + light.u.powi(2) + light.v.powi(2);
            assert!(size2 <= light.i.powi(2) * (1.0 + 1e-9), "no more polarised than whole");
        }
    }
}

/// A packet of vertical rays on the crown, following polarisation.
fn rain(stone: &ConvexStone, stream: &mut Stream) -> Packet {
    let mut packet = Packet::new(true);
    for lane in 0..LANES {
        let target = (warps::uniform_disc(stream.pair()) * 0.9).extend(2.0);
        let hit = stone.intersect(target, Vec3::NEG_Z).expect("over the stone");
        let entry = stone.refract_into(hit.facet, Vec3::NEG_Z, INDEX as f32);
        packet.load_refracted(lane, target - Vec3::Z * hit.distance, &entry, INDEX as f32);
    }
    packet
}

/// Lanes and twin let out the same power at the same facets: within 2e-5 of what a ray brings in,
/// some ten roundings of `f32` and Stokes vectors turned by them.
#[test]
fn lanes_agree_with_the_twin_on_every_instruction_set() {
    for isa in Isa::all() {
        let stone = brilliant(isa);
        let planes = stone.kernel_planes();
        let mut stream = Stream::new(SEED, Purpose::TEST, 1);
        let (mut compared, mut apart) = (0, 0);
        for _ in 0..40 {
            let mut packet = rain(&stone, &mut stream);
            let start = packet.clone();
            let mut lanes: Vec<Vec<(usize, f64)>> = vec![Vec::new(); LANES];
            stone.trace(&mut packet, 1e-3, |m, _| {
                (0..LANES).for_each(|l| lanes[l].push((m.facet[l] as usize, m.power[l].into())));
            });
            for (lane, seen) in lanes.iter().enumerate() {
                let axis = Vec3::new(start.ax[lane], start.ay[lane], start.az[lane]).as_dvec3();
                let power = f64::from(start.power[lane]);
                let stokes = Stokes { q: start.q[lane].into(), ..Stokes::unpolarised(power, axis) };
                let ray = reference::ScalarRay {
                    point: start.point(lane).as_dvec3(),
                    direction: start.direction(lane).as_dvec3().normalize(),
                    power,
                    index: INDEX,
                    absorption: 0.0,
                    stokes: Some(stokes),
                };
                let mut bounces = seen.iter();
                let mut together = true;
                reference::trace(&planes, ray, 1e-3, |m| {
                    let Some((facet, power)) = bounces.next().filter(|_| together) else { return };
                    together = *facet == m.facet;
                    if together {
                        compared += 1;
                        assert!((power - m.power).abs() < 2e-5, "{} {} {}", isa.name(), power, m.power);
                    }
                });
                apart += usize::from(!together);
            }
        }
        // a rounding decides now and then which of two facets a ray near their edge meets
        assert!(compared > 10_000 && apart < 20, "{}: {compared} {apart}", isa.name());
    }
}

/// Polarisation moves power between ways out but loses none.
#[test]
fn entered_is_left_and_lost() {
    let stone = brilliant(Isa::best());
    let mut stream = Stream::new(SEED, Purpose::TEST, 2);
    for _ in 0..50 {
        let mut packet = rain(&stone, &mut stream);
        let entered: f32 = packet.power.iter().sum();
        let mut left = 0.0;
        let lost = stone.trace(&mut packet, 1e-4, |m, _| left += m.power.iter().sum::<f32>());
        assert!((entered - left - lost).abs() < 2e-5 * entered, "{entered} {left} {lost}");
    }
}

/// A lane that has been put to rest, or never set, lets nothing out whatever its Stokes vector was.
#[test]
fn a_lane_at_rest_stays_dark() {
    for isa in Isa::all() {
        let mut packet = rain(&brilliant(isa), &mut Stream::new(SEED, Purpose::TEST, 3));
        packet.power[5] = 0.0;
        (packet.q[5], packet.u[5]) = (0.3, -0.2);
        let mut bounces = 0;
        brilliant(isa).trace(&mut packet, 1e-4, |m, after| {
            bounces += 1;
            assert_eq!((m.power[5], after.power[5]), (0.0, 0.0), "{}", isa.name());
        });
        assert!(bounces > 10);
    }
}

/// [R] With polarisation the light that a vertical view of the reference stone sends up changes by
/// .0007.
#[test]
fn polarisation_changes_a_view_by_as_much_as_is_known() {
    let stone = brilliant(Isa::best());
    let material = Material::from_index(2.417298);
    let up = |polarised| {
        let mut traced = BatchedEstimate::new(
            View::new(&stone, &TraceOptics { material: &material, polarised }).expect("a crown"),
            SEED,
        );
        traced.extend_to(1 << 17);
        traced.estimate(|t| view::up(t) / t[view::RAYS])
    };
    let (with, without) = (up(true), up(false));
    let change = (with.value - without.value).abs();
    println!("up {with:?} with polarisation, {without:?} without");
    assert!((change - 0.0007).abs() < 0.0001 + 3.0 * with.error.hypot(without.error), "{change}");
}
