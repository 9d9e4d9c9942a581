//! Scores of faceters, Harding's closed form, spread and weight.

use super::context::cut;
use super::figures::{self, ReferenceFigure};
use super::{Check, CheckError, Figure, FigureSource, Measured, SourceKind};
use crate::formats;
use crate::geometry::Plane;
use crate::materials::Material;
use crate::scoring::score::{ScoreRequest, Target};
use crate::trace::reference;
use glam::DVec3;

const SUBJECT: &str = "faceters' scores";

const HARDING: FigureSource = FigureSource { kind: SourceKind::Derived, name: "Harding 1975, closed form" };
const DEFINITION: FigureSource = FigureSource { kind: SourceKind::Derived, name: "definition of the score" };

/// The checks of this subject.
pub fn checks() -> Vec<Check> {
    let mut checks: Vec<Check> = figures::subjects("no head shadow").into_iter().map(published).collect();
    checks.extend(grids().into_iter().map(grid));
    checks.extend([closed_form(), gutter(), tolkowsky(), cube()]);
    checks
}

fn published(name: &'static str) -> Check {
    let rows = figures::set_of("no head shadow", name);
    let metrics: Vec<&str> = rows.iter().map(|f| f.quantity.as_str()).collect();
    let figure =
        |f: &&'static ReferenceFigure| f.named(format!("{} of {name} at 1.54, no head shadow", f.quantity));
    Check::new(SUBJECT, rows.iter().map(figure).collect(), move |lab| {
        let plan =
            ScoreRequest { observer: Some(0.0), target: Target::Samples(1 << 16), ..ScoreRequest::default() };
        Ok(Measured::new(lab.planned(&cut(name)?, &Material::from_index(1.54), &metrics, plan)?))
    })
}

/// Figures with a head of 10°, on a grid of 300 × 300 cell centres: those of one file and index together.
fn grids() -> Vec<Vec<&'static ReferenceFigure>> {
    let all = figures::set("head of 10°");
    all.chunk_by(|a, b| (&a.of, a.at) == (&b.of, b.at)).map(<[_]>::to_vec).collect()
}

fn grid(rows: Vec<&'static ReferenceFigure>) -> Check {
    let figure = |f: &&'static ReferenceFigure| {
        f.named(format!("{} of {} at {}", f.quantity, f.of, f.at.unwrap_or(f64::NAN)))
    };
    Check::new(SUBJECT, rows.iter().map(figure).collect(), move |lab| {
        let Some(ReferenceFigure { of: file, at: Some(index), .. }) = rows.first() else {
            return Err(CheckError::Unknown("a file with its index".into()));
        };
        let design =
            formats::read_content(&lab.file(&format!("pairs/{file}"))?, lab.limits)?.into_design()?.design;
        let metrics: Vec<&str> = rows.iter().map(|f| f.quantity.as_str()).collect();
        Ok(Measured::new(lab.scores(&design, &Material::from_index(*index), &metrics, 1 << 17)?))
    })
}

/// Full angle in degrees between a symmetric ray table–pavilion–pavilion–table and itself outside:
/// sin(D′/2) = n sin(D/2), D = 4(45° − P).
fn turn(index: f64, pavilion_deg: f64) -> f64 {
    2.0 * (index * (2.0 * (45.0 - pavilion_deg)).to_radians().sin()).asin().to_degrees()
}

fn closed_form() -> Check {
    let rows = figures::set("turn by 10°");
    let index = |f: &ReferenceFigure| f.at.unwrap_or(f64::NAN);
    let figure = |f: &&'static ReferenceFigure| {
        f.named(format!("pavilion angle at which light turns by 10° at {}", index(f)))
    };
    Check::new(SUBJECT, rows.iter().map(figure).collect(), move |_| {
        // the greatest angle that turns it by 10° or more
        let solve = |n: f64| {
            let (mut lo, mut hi) = (42.0f64, 45.0f64);
            for _ in 0..60 {
                let middle = 0.5 * (lo + hi);
                if walked(n, middle, 10.0) > 0.0 { lo = middle } else { hi = middle }
            }
            0.5 * (lo + hi)
        };
        Ok(Measured::exact(rows.iter().map(|f| solve(index(f)))))
    })
}

/// Sends a ray into a gutter of two pavilion facets under a table, from `turned`/2 degrees beside the
/// zenith; gives by how many degrees it leaves farther from the zenith on the other side: 0 where it
/// is symmetric.
fn walked(index: f64, pavilion_deg: f64, turned: f64) -> f64 {
    let (sin, cos) = pavilion_deg.to_radians().sin_cos();
    let planes = [
        Plane::new(DVec3::Z, 0.0),
        Plane::new(DVec3::new(sin, 0.0, -cos), 1.0),
        Plane::new(DVec3::new(-sin, 0.0, -cos), 1.0),
        Plane::new(DVec3::Y, 1.0),
        Plane::new(-DVec3::Y, 1.0),
    ];
    let half = (0.5 * turned).to_radians();
    let inside = half.sin() / index;
    let ray = reference::ScalarRay {
        point: DVec3::new(0.6, 0.0, -1e-12),
        direction: DVec3::new(-inside, 0.0, -(1.0 - inside * inside).sqrt()),
        power: 1.0,
        index,
        absorption: 0.0,
        stokes: None,
    };
    let mut out = None;
    reference::trace(&planes, ray, 1e-3, |m| {
        if m.facet == 0 && out.is_none() {
            out = Some(m.direction);
        }
    });
    let angle = |d: DVec3| (-d.x).atan2(d.z).to_degrees();
    out.map_or(f64::NAN, |d| angle(d) - 0.5 * turned)
}

fn gutter() -> Check {
    let name = "a ray walked through a gutter of 42° at 1.76 leaves beside Harding's direction by";
    Check::new(SUBJECT, vec![Figure::near(name, HARDING, 0.0, 1e-9).unit("°")], |_| {
        Ok(Measured::exact([walked(1.76, 42.0, turn(1.76, 42.0))]))
    })
}

fn tolkowsky() -> Check {
    let figures = vec![
        Figure::near("spread of tolkowsky", DEFINITION, 0.0, 1e-9).unit("%"),
        Figure::near("weight_ratio of tolkowsky", DEFINITION, 1.0, 1e-9),
    ];
    Check::new(SUBJECT, figures, |lab| {
        let stone = cut("tolkowsky")?.sized(7.0)?;
        Ok(Measured::new(lab.scores(&stone, &Material::from_index(1.54), &["spread", "weight_ratio"], 1)?))
    })
}

fn cube() -> Check {
    // a cube has its width's cube; the Tolkowsky stone less
    let name = "weight_ratio of a cube, times the volume of tolkowsky over its width cubed";
    Check::new(SUBJECT, vec![Figure::near(name, DEFINITION, 1.0, 1e-9)], |lab| {
        let solid = cut("tolkowsky")?.solid()?;
        let volume = solid.volume() / solid.width().powi(3);
        let found = lab.scores(&cut("cube")?, &Material::from_index(1.54), &["weight_ratio"], 1)?;
        Ok(Measured::exact(found.iter().map(|e| e.value * volume)))
    })
}
