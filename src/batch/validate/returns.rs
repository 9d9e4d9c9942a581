//! What comes back: weighted light return, its trends, ASET shares, leakage.

use super::stones::{GivenParameter, INDEX, STONES, brilliant, brilliant_by_name};
use super::{Check, CheckContext, CheckError, Expected, Figure, FigureSource, Measured, SourceKind, TRACER};
use crate::estimators::{BatchedEstimate, Hemisphere, TraceOptics, hemisphere};
use crate::materials::Material;
use crate::sampling::stats::Estimate;
use crate::scoring::score::ScoreRequest;
use crate::trace::ConvexStone;

const SUBJECT: &str = "light return";

const JCK: FigureSource =
    FigureSource { kind: SourceKind::Published, name: "Hemphill et al. 1998, by JCK's account" };
const PRICESCOPE: FigureSource = FigureSource { kind: SourceKind::Published, name: "PriceScope, DiamCalc" };

/// What the tracer's figures are said to be good for.
const WLR: f64 = 0.001;
/// The same of the six stones: two tracers gave .2840 and .2832 for one of them.
const OF_A_STONE: f64 = 0.002;
/// The same of shares of a view.
const SHARE: f64 = 0.005;

/// Samples that bring the error of a stone's light return to ±.0002, and to ±.0001.
const USUAL: u64 = 1 << 20;
const SHARP: u64 = 1 << 22;

const OF_THE_SIX: [f64; 6] = [0.2832, 0.2864, 0.2816, 0.2731, 0.2694, 0.2661];

const SCATTER: &str = "the list scatters by more than its ±.001: it has .2838 for the stone that is .2832 \
    among the six";

/// WLR by crown angle in degrees, of the reference stone else, cross-checked.
#[allow(clippy::approx_constant)] // .3010 is a light return here, not a logarithm
pub const BY_CROWN: [(f64, f64); 11] = [
    (10.0, 0.2890),
    (15.0, 0.2925),
    (20.0, 0.2986),
    (23.0, 0.3010),
    (26.0, 0.2952),
    (30.0, 0.2849),
    (32.0, 0.2829),
    (34.0, 0.2838),
    (36.0, 0.2787),
    (40.0, 0.2592),
    (45.0, 0.2205),
];

/// More crown angles, for the trends and the line.
const OTHER_CROWNS: [f64; 13] = [0.0, 12.0, 17.0, 19.0, 21.0, 22.0, 24.0, 25.0, 28.0, 34.5, 35.0, 38.0, 42.0];

/// WLR by table in percent, of the reference stone else, cross-checked.
pub const BY_TABLE: [(f64, f64); 6] =
    [(50.0, 0.2793), (53.0, 0.2814), (56.0, 0.2838), (60.0, 0.2814), (65.0, 0.2696), (70.0, 0.2628)];

/// The checks of this subject.
pub fn checks() -> Vec<Check> {
    let mut checks: Vec<Check> = STONES.iter().zip(OF_THE_SIX).map(|(s, wlr)| of_a_stone(s.0, wlr)).collect();
    checks.extend([normalisations(), by_crown(), local_maximum(), by_table(), jump(), strongest()]);
    checks.extend(ASET.into_iter().map(aset));
    checks
}

fn wlr(lab: &CheckContext, given: &[GivenParameter], samples: u64) -> Result<Estimate, CheckError> {
    let found = lab.scores(&brilliant(given)?, &Material::from_index(INDEX), &["wlr"], samples)?;
    found.into_iter().next().ok_or_else(|| CheckError::Unknown("wlr".into()))
}

fn of_a_stone(name: &'static str, expected: f64) -> Check {
    let figure = Figure::near(format!("wlr of {name}"), TRACER, expected, OF_A_STONE);
    Check::new(SUBJECT, vec![figure], move |lab| {
        Ok(Measured::new(lab.scores(
            &brilliant_by_name(name)?,
            &Material::from_index(INDEX),
            &["wlr"],
            USUAL,
        )?))
    })
}

fn normalisations() -> Check {
    let figures = vec![
        Figure::near("wlr with rejected directions counted", TRACER, 0.264, WLR),
        Figure::near("wlr by the flux through the girdle disc", TRACER, 0.3055, WLR),
    ];
    Check::new(SUBJECT, figures, |lab| {
        let stone = ConvexStone::new(brilliant(&[])?.solid()?);
        let medium = TraceOptics { material: &Material::from_index(INDEX), polarised: false };
        let mut dome = BatchedEstimate::new(Hemisphere::new(&stone, &medium)?, lab.seed);
        dome.extend_to(USUAL);
        let drawn = dome.estimate(|t| t[hemisphere::RETURNED_COS2] / t[hemisphere::DRAWN]);
        let areas = dome.estimator().crown_area / dome.estimator().outline_area;
        let disc = Estimate { value: drawn.value * areas, error: drawn.error * areas };
        Ok(Measured::new(vec![drawn, disc]))
    })
}

/// The list of an independent tracer, and the published trends, which read one line.
fn by_crown() -> Check {
    let value = |(crown, wlr)| {
        Figure::near(format!("wlr at crown {crown}°"), TRACER, wlr, WLR).at_x(crown).because(SCATTER)
    };
    let mut figures: Vec<Figure> = BY_CROWN.into_iter().map(value).collect();
    let above = |name, source| Figure::new(name, source, Expected::Above(0.0));
    figures.push(above("wlr without a crown less the best with one", JCK));
    let best = "best crown angle of 10° or more, in steps of 1° about 23°";
    figures.push(Figure::near(best, JCK, 23.0, 1.0).unit("°"));
    figures.push(above("wlr at crown 34.5° less the best above it", JCK));
    let check = Check::new(SUBJECT, figures, |lab| {
        let mut crowns: Vec<f64> = BY_CROWN.iter().map(|r| r.0).chain(OTHER_CROWNS).collect();
        crowns.sort_by(f64::total_cmp);
        let at = |crown: f64| Ok((crown, wlr(lab, &[("crown-angle", crown)], USUAL)?));
        let line = crowns.into_iter().map(at).collect::<Result<Vec<_>, CheckError>>()?;
        let best = |from: f64, to: f64| {
            let inside = line.iter().filter(|(c, _)| (from..=to).contains(c)).copied();
            let none = (f64::NAN, Estimate::exact(f64::NAN));
            inside.max_by(|a, b| a.1.value.total_cmp(&b.1.value)).unwrap_or(none)
        };
        let of = |crown| best(crown, crown).1;
        let mut ours: Vec<Estimate> = BY_CROWN.map(|(crown, _)| of(crown)).into();
        ours.extend([
            less(of(0.0), best(10.0, 45.0).1),
            Estimate::exact(best(10.0, 45.0).0),
            less(of(34.5), best(35.0, 45.0).1),
        ]);
        Ok(Measured { ours, line })
    });
    check.drawn("wlr against crown angle", "crown angle (°)", "wlr")
}

fn less(a: Estimate, b: Estimate) -> Estimate {
    Estimate { value: a.value - b.value, error: a.error.hypot(b.error) }
}

fn local_maximum() -> Check {
    let figure = |crown: f64| {
        let name = format!("wlr at crown 34° less at {crown}° (a local maximum)");
        Figure::new(name, TRACER, Expected::Above(0.0))
    };
    Check::new(SUBJECT, [32.0, 36.0].map(figure).into(), |lab| {
        let at = |crown| wlr(lab, &[("crown-angle", crown)], SHARP);
        let top = at(34.0)?;
        Ok(Measured::new(vec![less(top, at(32.0)?), less(top, at(36.0)?)]))
    })
}

fn by_table() -> Check {
    let value = |(table, wlr)| {
        Figure::near(format!("wlr at table {table} %"), TRACER, wlr, WLR).at_x(table).because(SCATTER)
    };
    let check = Check::new(SUBJECT, BY_TABLE.map(value).into(), |lab| {
        let at = |(table, _)| wlr(lab, &[("table", table)], USUAL);
        let ours = BY_TABLE.into_iter().map(at).collect::<Result<Vec<_>, _>>()?;
        let line = BY_TABLE.iter().map(|r| r.0).zip(ours.clone()).collect();
        Ok(Measured { ours, line })
    });
    check.drawn("wlr against table", "table (%)", "wlr")
}

fn jump() -> Check {
    const AT: [(f64, f64); 2] = [(41.15, 0.0394), (41.25, 0.124)];
    let value = |(pavilion, leakage)| {
        Figure::near(format!("leakage (strongest path) at pavilion {pavilion}°"), TRACER, leakage, SHARE)
            .at_x(pavilion)
    };
    let mut figures: Vec<Figure> = AT.into_iter().map(value).collect();
    let name = "rise of leakage from pavilion 41.15° to 41.25°, over that of the tenth before";
    figures.push(Figure::new(name, PRICESCOPE, Expected::Above(2.0)));
    let check = Check::new(SUBJECT, figures, |lab| {
        let at = |i: i32| {
            let pavilion = 40.65 + 0.1 * f64::from(i);
            let given = [("crown-angle", 35.0), ("lower-half", 80.0), ("pavilion-angle", pavilion)];
            let plan = ScoreRequest { exact: true, ..ScoreRequest::default() };
            let material = Material::from_index(INDEX);
            let found = lab.planned(&brilliant(&given)?, &material, &["leakage_strongest"], plan)?;
            let leakage = found.first().copied().unwrap_or(Estimate::exact(f64::NAN));
            Ok((pavilion, leakage))
        };
        let line = (0..=11).map(at).collect::<Result<Vec<_>, CheckError>>()?;
        let [before, low, high] = [4, 5, 6].map(|i| line[i].1);
        let rise = (high.value - low.value) / (low.value - before.value).abs().max(1e-3);
        Ok(Measured { ours: vec![low, high, Estimate::exact(rise)], line })
    });
    check.drawn(
        "leakage by the strongest path, crown 35°, table 56 %, lower halves 80 %",
        "pavilion angle (°)",
        "leakage_strongest",
    )
}

/// Green, red, blue and leaking share by energy, in percent.
const ASET: [(&str, [f64; 4]); 5] = [
    ("reference", [6.2, 50.1, 18.3, 7.9]),
    ("tolkowsky", [6.1, 51.5, 17.3, 7.6]),
    ("steep-deep", [24.1, 36.0, 9.6, 12.8]),
    ("nailhead", [31.0, 38.7, 2.6, 10.2]),
    ("fisheye", [8.1, 43.0, 23.6, 8.0]),
];

fn aset((name, expected): (&'static str, [f64; 4])) -> Check {
    let metrics = ["aset_green", "aset_red", "aset_blue", "aset_leak"];
    shares(name, metrics, expected)
}

fn strongest() -> Check {
    let metrics = ["aset_green_strongest", "aset_red_strongest", "aset_blue_strongest", "leakage_strongest"];
    shares("reference", metrics, [6.0, 66.7, 22.8, 4.5])
}

fn shares(name: &'static str, metrics: [&'static str; 4], percent: [f64; 4]) -> Check {
    let figure = |(m, x)| Figure::near(format!("{m} of {name}"), TRACER, x / 100.0, SHARE);
    Check::new(SUBJECT, metrics.into_iter().zip(percent).map(figure).collect(), move |lab| {
        Ok(Measured::new(lab.scores(
            &brilliant_by_name(name)?,
            &Material::from_index(INDEX),
            &metrics,
            1 << 17,
        )?))
    })
}
