//! Light at facets: Fresnel's formulas, energy, exact beams and the tracers that they must agree with.

use super::context::{cut, material};
use super::figures::{self, ReferenceFigure};
use super::stones::{INDEX, brilliant, brilliant_by_name};
use super::{Check, CheckError, Expected, Figure, FigureSource, Measured, SourceKind};
use crate::design::library;
use crate::estimators::weighted_exits::BeamEffort as Work;
use crate::estimators::{BatchedEstimate, TraceOptics, View, beam_view, view};
use crate::materials::Material;
use crate::metrics::{METRICS, Metric};
use crate::optics::fresnel;
use crate::sampling::stats::Estimate;
use crate::sampling::tally::Tally;
use crate::scoring::score::{ScoreRequest, Target};
use crate::trace::ConvexStone;
use crate::trace::beams::{
    BeamExit, BeamLight, BeamVisitor, Beams, EnergyBudget, IncidentBeam, StopCriteria, UnpolarisedLight,
};
use glam::DVec3;

const SUBJECT: &str = "light at facets";

/// Index of the reference figures of this chapter.
const DIAMOND: f64 = 2.417298;

const FRESNEL: FigureSource = FigureSource { kind: SourceKind::Derived, name: "Snell and Fresnel" };
const ENERGY: FigureSource = FigureSource { kind: SourceKind::Derived, name: "energy is conserved" };
const TWO_WAYS: FigureSource =
    FigureSource { kind: SourceKind::Derived, name: "beams and photons are the same light" };

/// The tracer that the figures are from gave a beam up after so many facets, which tells at 1e-7.
const MOST_FACETS: u32 = 201;

/// The figures of the set "vertical view", the limit by 262,144 quasi-random traces, with tolerances.
///
/// - `way`: by which ours are found
fn limit(way: &str, tolerances: [f64; 4]) -> Vec<Figure> {
    let row = |(f, tolerance): (&'static ReferenceFigure, f64)| {
        Figure::near(format!("{}, {way}", f.quantity), f.source(), f.expected, tolerance)
    };
    figures::set("vertical view").into_iter().zip(tolerances).map(row).collect()
}

/// The checks of this subject.
pub fn checks() -> Vec<Check> {
    let mut checks = vec![formulas(), air()];
    let all = figures::set("beams");
    checks.extend(all.chunk_by(|a, b| a.at == b.at).map(beams));
    checks.extend([limit_by_photons(), limit_by_beams(), polarisation(), energy(), beams_sum()]);
    checks.push(beams_against_photons());
    checks
}

fn formulas() -> Check {
    let n = 2.41726f64;
    let figures = vec![
        Figure::near("diamond reflects head on", FRESNEL, ((n - 1.0) / (n + 1.0)).powi(2), 1e-6),
        Figure::near("R_p at Brewster's angle of diamond", FRESNEL, 0.0, 1e-12),
        Figure::near("critical angle of diamond", FRESNEL, (1.0 / n).asin().to_degrees(), 1e-3).unit("°"),
        Figure::near("reflectance at grazing incidence", FRESNEL, 1.0, 1e-12),
    ];
    Check::new(SUBJECT, figures, |_| {
        let n = material("diamond")?.index_d();
        let brewster = n.atan().cos();
        Ok(Measured::exact([
            fresnel::unpolarised(1.0, n).0,
            fresnel::FresnelCoefficients::new(brewster, n).r_p,
            fresnel::critical_angle_deg(n),
            fresnel::unpolarised(0.0, n).0,
        ]))
    })
}

fn air() -> Check {
    const AIR: FigureSource = FigureSource { kind: SourceKind::Derived, name: "an index of 1 is air" };
    let metrics = ["light_return", "glare", "leakage", "aset_leak"];
    let figure = |(m, x)| Figure::near(format!("{m} at index 1"), AIR, x, 1e-5);
    let figures = metrics.into_iter().zip([0.0, 0.0, 1.0, 1.0]).map(figure).collect();
    Check::new(SUBJECT, figures, move |lab| {
        Ok(Measured::new(lab.scores(&brilliant(&[])?, &Material::from_index(1.0), &metrics, 1 << 12)?))
    })
}

/// Exits added up: up, down, up·cos².
#[derive(Default)]
struct ExitSums([f64; 3]);

impl<L> BeamVisitor<L, 1> for ExitSums {
    fn exit(&mut self, exit: &BeamExit<L, 1>) {
        let z = exit.direction.z;
        self.0[usize::from(z <= 0.0)] += exit.power;
        self.0[2] += exit.power * z.max(0.0).powi(2);
    }
}

/// A vertical view of a stone of diamond by beams.
fn follow(stone: &ConvexStone, light: impl BeamLight, until: StopCriteria) -> (EnergyBudget, [f64; 3]) {
    let mut sums = ExitSums::default();
    let lit = IncidentBeam { direction: DVec3::NEG_Z, indices: [DIAMOND] };
    let totals = Beams::new(stone).trace(&lit, light, until, &mut sums);
    (totals, sums.0)
}

fn reference() -> Result<ConvexStone, CheckError> {
    Ok(ConvexStone::new(brilliant(&[])?.solid()?))
}

fn beams(rows: &[&'static ReferenceFigure]) -> Check {
    let power = rows.first().and_then(|f| f.at).unwrap_or(f64::NAN);
    let mut figures: Vec<Figure> =
        rows.iter().map(|f| f.named(format!("{}, beams down to {power:e}", f.quantity))).collect();
    figures.push(Figure::near(format!("all light, beams down to {power:e}"), ENERGY, 1.0, 1e-9));
    Check::new(SUBJECT, figures, move |_| {
        let until = StopCriteria { facets: MOST_FACETS, ..StopCriteria::at_power(power) };
        let (t, [up, down, cos2]) = follow(&reference()?, UnpolarisedLight(1.0), until);
        Ok(Measured::exact([t.beams as f64, up, down, cos2, t.not_followed, t.reflected, t.sum()]))
    })
}

fn limit_by_photons() -> Check {
    Check::new(SUBJECT, limit("photons", [1e-6, 2e-4, 2e-4, 2e-4]), |lab| {
        let (stone, material) = (reference()?, Material::from_index(DIAMOND));
        let medium = TraceOptics { material: &material, polarised: false };
        let mut seen = BatchedEstimate::new(View::new(&stone, &medium)?, lab.seed);
        seen.extend_to(1 << 18);
        let share = |of: fn(&Tally) -> f64| seen.estimate(|t| of(t) / t[view::RAYS]);
        let found = [
            share(|t| t[view::REFLECTED]),
            share(view::up),
            share(|t| t[view::UP_COS2]),
            share(|t| t[view::BELOW]),
        ];
        Ok(Measured::new(found.into()))
    })
}

/// Beams as far as they are followed here, and photons for the .2 % that are left.
const FAR: Work = Work {
    stop: StopCriteria {
        power: 1e-7,
        residual: 0.0,
        facets: crate::trace::beams::MAX_FACETS,
        beams: u64::MAX,
    },
    photons: 65_536,
    seed: 1,
    untraced: 0.0,
};

fn limit_by_beams() -> Check {
    // 262,144 quasi-random traces are good to 3e-5
    let figures = limit("beams finished by photons", [2e-5, 6e-5, 6e-5, 6e-5]);
    Check::new(SUBJECT, figures, |lab| {
        let stone = reference()?;
        let work = Work { seed: lab.seed, ..FAR };
        let g = beam_view::beam_view(&Beams::new(&stone), DVec3::NEG_Z, DIAMOND, false, &work)?;
        Ok(Measured::new(vec![g.reflected, g.up, g.up_cos2, g.down]))
    })
}

fn polarisation() -> Check {
    let figures = figures::set("polarisation").into_iter().map(|f| f.named(&f.quantity)).collect();
    Check::new(SUBJECT, figures, |lab| {
        let stone = reference()?;
        let work = Work { seed: lab.seed, ..FAR };
        let up = |polarised| {
            beam_view::beam_view(&Beams::new(&stone), DVec3::NEG_Z, DIAMOND, polarised, &work).map(|g| g.up)
        };
        let (with, without) = (up(true)?, up(false)?);
        let value = (with.value - without.value).abs();
        Ok(Measured::new(vec![Estimate { value, error: with.error.hypot(without.error) }]))
    })
}

/// The worst of all cuts of the library.
fn worst(of: impl Fn(&str) -> Result<f64, CheckError>) -> Result<Measured, CheckError> {
    let each: Vec<f64> = library::names().map(of).collect::<Result<_, _>>()?;
    Ok(Measured::exact([each.into_iter().map(|sum| (sum - 1.0).abs()).fold(0.0, f64::max)]))
}

fn energy() -> Check {
    let name = "light of a dome unaccounted for, worst cut of the library";
    Check::new(SUBJECT, vec![Figure::near(name, ENERGY, 0.0, 1e-4)], |lab| {
        let parts = ["light_return", "glare", "leakage", "absorbed", "lost"];
        worst(|name| {
            let found = lab.scores(&cut(name)?, &Material::from_index(INDEX), &parts, 1 << 12)?;
            Ok(found.iter().map(|e| e.value).sum())
        })
    })
}

fn beams_sum() -> Check {
    let name = "light of beams unaccounted for, worst cut of the library";
    Check::new(SUBJECT, vec![Figure::near(name, ENERGY, 0.0, 1e-9)], |_| {
        worst(|name| {
            Ok(follow(
                &ConvexStone::new(cut(name)?.solid()?),
                UnpolarisedLight(1.0),
                StopCriteria::at_power(1e-4),
            )
            .0
            .sum())
        })
    })
}

/// Every score that both ways give.
fn beams_against_photons() -> Check {
    let metrics: Vec<&'static Metric> = METRICS.iter().copied().filter(|m| m.by_beams).collect();
    let figure = |m: &&Metric| {
        // beyond the errors: what lanes of f32 give up, and the beams' undecided points
        let expected = Expected::Near(0.0, 5e-5 * m.scale);
        Figure::new(format!("{} of the nailhead, photons less beams", m.name), TWO_WAYS, expected)
            .unit(m.unit)
    };
    Check::new(SUBJECT, metrics.iter().map(figure).collect(), move |lab| {
        let (stone, material) = (brilliant_by_name("nailhead")?, material("diamond")?);
        let names: Vec<&str> = metrics.iter().map(|m| m.name).collect();
        let photons = lab.scores(&stone, material, &names, 1 << 17)?;
        let plan = ScoreRequest { exact: true, target: Target::Samples(1 << 18), ..ScoreRequest::default() };
        let beams = lab.planned(&stone, material, &names, plan)?;
        let less = |(a, b): (&Estimate, &Estimate)| Estimate {
            value: a.value - b.value,
            error: a.error.hypot(b.error),
        };
        Ok(Measured::new(photons.iter().zip(&beams).map(less).collect()))
    })
}
