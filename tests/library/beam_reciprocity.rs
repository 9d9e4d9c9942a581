//! Reciprocity of exact beams: light sent back along an exit returns by the same facets.

use cutlab::advanced::design::families;
use cutlab::advanced::geometry::Polyhedron;
use cutlab::advanced::trace::ConvexStone;
use cutlab::advanced::trace::beams::{
    BeamExit, BeamVisitor, Beams, IncidentBeam, StopCriteria, UnpolarisedLight,
};
use glam::DVec3;
use std::collections::BTreeMap;

/// Index of the reference figures.
const DIAMOND: f64 = 2.417298;

fn brilliant() -> Polyhedron {
    let given = [("table", 56.0), ("crown-angle", 34.0), ("pavilion-angle", 40.5)];
    let given: BTreeMap<String, f64> = given.map(|(key, value)| (key.to_string(), value)).into();
    let design = families::build("round-brilliant", &given).expect("builds");
    design.solid().expect("closed")
}

/// The strongest path that has met three facets or more, or the one that leaves in a given
/// direction.
#[derive(Default)]
struct Found {
    /// Where the light comes from, and where the path sought leaves.
    lit: DVec3,
    sought: Option<DVec3>,
    bounces: u32,
    leaves: DVec3,
    power: f64,
    light: f64,
    /// Cross-sections outside, before it enters and after it leaves, as shares of the outline.
    sections: [f64; 2],
}

impl BeamVisitor<UnpolarisedLight, 1> for Found {
    fn exit(&mut self, exit: &BeamExit<UnpolarisedLight, 1>) {
        let wanted = match self.sought {
            Some(to) => exit.direction.distance(to) < 1e-9 && exit.bounces == self.bounces,
            None => exit.bounces >= 3,
        };
        if wanted && exit.power > self.power {
            let [frame] = exit.coords;
            let [cos_out, cos_in] = [exit.direction, frame.direction].map(|d| d.dot(exit.normal));
            // area on the entry facet over area across the light: outside, and inside
            let outside = self.lit.dot(exit.entry.plane.normal).abs().recip();
            let inside = frame.across.cross(frame.along).length();
            let leaving = exit.share * outside / inside * cos_out / cos_in;
            (self.power, self.light, self.bounces) = (exit.power, exit.light.0, exit.bounces);
            (self.leaves, self.sections) = (exit.direction, [exit.share, leaving]);
        }
    }
}

/// Light sent back along the strongest exit returns by the same facets: the same share of it, in a
/// beam as wide as the one that left.
#[test]
fn light_sent_back_returns_by_the_same_way() {
    let stone = ConvexStone::new(brilliant());
    let direction = DVec3::new(0.21, 0.13, -0.9).normalize();
    let beams = Beams::new(&stone);
    let run = |mut found: Found| {
        let lit = IncidentBeam { direction: found.lit, indices: [DIAMOND] };
        let totals = beams.trace(&lit, UnpolarisedLight(1.0), StopCriteria::at_power(1e-5), &mut found);
        (found, totals.outline)
    };
    let (there, outline_there) = run(Found { lit: direction, ..Found::default() });
    let back =
        Found { lit: -there.leaves, sought: Some(-direction), bounces: there.bounces, ..Found::default() };
    let (back, outline_back) = run(back);
    assert!(there.light > 0.0 && (back.light / there.light - 1.0).abs() < 1e-9);
    let [enters, leaves] = there.sections.map(|s| s * outline_there);
    let [enters_back, leaves_back] = back.sections.map(|s| s * outline_back);
    assert!((enters / leaves_back - 1.0).abs() < 1e-9, "{enters} {leaves_back}");
    assert!((leaves / enters_back - 1.0).abs() < 1e-9, "{leaves} {enters_back}");
}
