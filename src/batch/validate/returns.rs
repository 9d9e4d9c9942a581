//! What comes back: weighted light return, its trends, ASET shares, leakage.

use super::figures::{self, ReferenceFigure};
use super::stones::{GivenParameter, INDEX, brilliant, brilliant_by_name};
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

/// Samples that bring the error of a stone's light return to ±.0002, and to ±.0001.
const USUAL: u64 = 1 << 20;
const SHARP: u64 = 1 << 22;

const SCATTER: &str = "the list scatters by more than its ±.001: it has .2838 for the stone that is .2832 \
    among the six";

/// More crown angles, for the trends and the line.
const OTHER_CROWNS: [f64; 13] = [0.0, 12.0, 17.0, 19.0, 21.0, 22.0, 24.0, 25.0, 28.0, 34.5, 35.0, 38.0, 42.0];

/// The checks of this subject.
pub fn checks() -> Vec<Check> {
    let mut checks: Vec<Check> = figures::set("light return").into_iter().map(of_a_stone).collect();
    checks.extend([normalisations(), by_crown(), local_maximum(), by_table(), jump()]);
    checks.push(shares("strongest path", "reference"));
    checks.extend(figures::subjects("viewer bands").into_iter().map(|name| shares("viewer bands", name)));
    checks
}

fn wlr(lab: &CheckContext, given: &[GivenParameter], samples: u64) -> Result<Estimate, CheckError> {
    let found = lab.scores(&brilliant(given)?, &Material::from_index(INDEX), &["wlr"], samples)?;
    found.into_iter().next().ok_or_else(|| CheckError::Unknown("wlr".into()))
}

fn of_a_stone(expected: &'static ReferenceFigure) -> Check {
    let name = &expected.of;
    Check::new(SUBJECT, vec![expected.named(format!("wlr of {name}"))], move |lab| {
        Ok(Measured::new(lab.scores(
            &brilliant_by_name(name)?,
            &Material::from_index(INDEX),
            &["wlr"],
            USUAL,
        )?))
    })
}

fn normalisations() -> Check {
    let figure = |f: &'static ReferenceFigure| {
        let by = if f.quantity.starts_with("by") { "" } else { "with " };
        f.named(format!("wlr {by}{}", f.quantity))
    };
    let figures = figures::set("normalisation").into_iter().map(figure).collect();
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
    let list = varied("crown angle");
    let value = |(crown, f): &(f64, &'static ReferenceFigure)| {
        f.named(format!("wlr at crown {crown}°")).at_x(*crown).because(SCATTER)
    };
    let mut figures: Vec<Figure> = list.iter().map(value).collect();
    let above = |name, source| Figure::new(name, source, Expected::Above(0.0));
    figures.push(above("wlr without a crown less the best with one", JCK));
    let best = "best crown angle of 10° or more, in steps of 1° about 23°";
    figures.push(Figure::near(best, JCK, 23.0, 1.0).unit("°"));
    figures.push(above("wlr at crown 34.5° less the best above it", JCK));
    let check = Check::new(SUBJECT, figures, move |lab| {
        let mut crowns: Vec<f64> = list.iter().map(|r| r.0).chain(OTHER_CROWNS).collect();
        crowns.sort_by(f64::total_cmp);
        let at = |crown: f64| Ok((crown, wlr(lab, &[("crown-angle", crown)], USUAL)?));
        let line = crowns.into_iter().map(at).collect::<Result<Vec<_>, CheckError>>()?;
        let best = |from: f64, to: f64| {
            let inside = line.iter().filter(|(c, _)| (from..=to).contains(c)).copied();
            let none = (f64::NAN, Estimate::exact(f64::NAN));
            inside.max_by(|a, b| a.1.value.total_cmp(&b.1.value)).unwrap_or(none)
        };
        let of = |crown| best(crown, crown).1;
        let mut ours: Vec<Estimate> = list.iter().map(|(crown, _)| of(*crown)).collect();
        ours.extend([
            less(of(0.0), best(10.0, 45.0).1),
            Estimate::exact(best(10.0, 45.0).0),
            less(of(34.5), best(35.0, 45.0).1),
        ]);
        Ok(Measured { ours, line })
    });
    check.drawn("wlr against crown angle", "crown angle (°)", "wlr")
}

/// The figures of a set, each with the parameter that the set varies.
fn varied(set: &str) -> Vec<(f64, &'static ReferenceFigure)> {
    figures::set(set).into_iter().filter_map(|f| Some((f.at?, f))).collect()
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
    let list = varied("table");
    let value = |(table, f): &(f64, &'static ReferenceFigure)| {
        f.named(format!("wlr at table {table} %")).at_x(*table).because(SCATTER)
    };
    let check = Check::new(SUBJECT, list.iter().map(value).collect(), move |lab| {
        let at = |(table, _): &(f64, _)| wlr(lab, &[("table", *table)], USUAL);
        let ours = list.iter().map(at).collect::<Result<Vec<_>, _>>()?;
        let line = list.iter().map(|r| r.0).zip(ours.clone()).collect();
        Ok(Measured { ours, line })
    });
    check.drawn("wlr against table", "table (%)", "wlr")
}

fn jump() -> Check {
    let value = |(pavilion, f): (f64, &'static ReferenceFigure)| {
        f.named(format!("leakage (strongest path) at pavilion {pavilion}°")).at_x(pavilion)
    };
    let mut figures: Vec<Figure> = varied("pavilion angle").into_iter().map(value).collect();
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

/// Shares of a stone's view, in percent as the set has them.
fn shares(set: &str, name: &'static str) -> Check {
    let rows = figures::set_of(set, name);
    let figure = |f: &&'static ReferenceFigure| f.share_named(format!("{} of {name}", f.quantity));
    let figures = rows.iter().map(figure).collect();
    let metrics: Vec<&str> = rows.iter().map(|f| f.quantity.as_str()).collect();
    Check::new(SUBJECT, figures, move |lab| {
        Ok(Measured::new(lab.scores(
            &brilliant_by_name(name)?,
            &Material::from_index(INDEX),
            &metrics,
            1 << 17,
        )?))
    })
}
