//! Indices of refraction and dispersion of materials.

use super::context::material;
use super::figures::{self, ReferenceFigure};
use super::{Check, CheckError, Measured};
use crate::materials::{Birefringence, Material};
use crate::optics::dispersion::{Dispersion, lines};

const SUBJECT: &str = "indices";

/// The checks of this subject.
pub fn checks() -> Vec<Check> {
    let lines_of_diamond = figures::set("lines of diamond");
    let line = |f: &&'static ReferenceFigure| f.named(format!("diamond at the line {}", f.quantity));
    let mut checks = vec![Check::new(SUBJECT, lines_of_diamond.iter().map(line).collect(), move |_| {
        let diamond = material("diamond")?;
        let index = |f: &&ReferenceFigure| line_nm(&f.quantity).map_or(f64::NAN, |nm| diamond.index(nm));
        Ok(Measured::exact(lines_of_diamond.iter().map(index)))
    })];
    let all = figures::set("indices");
    let ray = |f: &ReferenceFigure| f.quantity.starts_with(EXTRAORDINARY);
    checks.extend(all.chunk_by(|a, b| a.of == b.of && ray(a) == ray(b)).map(index_check));
    let glass = |f: &'static ReferenceFigure| match f.quantity.as_str() {
        "n_d" => f.named("n-bk7 at d"),
        other => f.named(format!("n-bk7, {other}")),
    };
    let glass = figures::set("indices of glass").into_iter().map(glass).collect();
    checks.push(Check::new(SUBJECT, glass, |_| {
        let glass = material("n-bk7")?;
        Ok(Measured::exact([glass.index(lines::D_HELIUM), glass.index(lines::F) - glass.index(lines::C)]))
    }));
    for row in figures::set("indices of Malitson") {
        let figure = row.named(format!("{} at d", row.of));
        checks.push(Check::new(SUBJECT, vec![figure], move |_| {
            Ok(Measured::exact([material(&row.of)?.index(lines::D_HELIUM)]))
        }));
    }
    checks
}

/// How quantities of the extraordinary ray begin.
const EXTRAORDINARY: &str = "extraordinary";

/// The dispersion of the extraordinary ray of a uniaxial material.
fn extraordinary(material: &Material) -> Option<&Dispersion> {
    match material.crystal.as_ref()? {
        Birefringence::Uniaxial { extraordinary } => Some(&extraordinary.dispersion),
        Birefringence::Biaxial { .. } => None,
    }
}

/// The wavelength of a Fraunhofer line, in nanometres.
fn line_nm(name: &str) -> Option<f64> {
    let all = [
        ("B", lines::B),
        ("C", lines::C),
        ("D", lines::D),
        ("d", lines::D_HELIUM),
        ("e", lines::E),
        ("F", lines::F),
        ("G", lines::G),
        ("h", lines::H),
    ];
    all.into_iter().find(|(line, _)| *line == name).map(|(_, nm)| nm)
}

/// The index at D of one ray of a material, and its dispersion from B to G where it is known.
fn index_check(rows: &[&'static ReferenceFigure]) -> Check {
    let rows = rows.to_vec();
    let figure = |f: &&'static ReferenceFigure| {
        let ray = if f.quantity.starts_with(EXTRAORDINARY) { " extraordinary" } else { "" };
        let what = if f.quantity.ends_with("B–G") { ", B–G" } else { " at D" };
        f.named(format!("{}{ray}{what}", f.of))
    };
    Check::new(SUBJECT, rows.iter().map(figure).collect(), move |_| {
        let Some(first) = rows.first() else { return Ok(Measured::default()) };
        let material = material(&first.of)?;
        let none = || CheckError::Unknown(format!("extraordinary ray of {}", first.of));
        let law: &Dispersion = if first.quantity.starts_with(EXTRAORDINARY) {
            extraordinary(material).ok_or_else(none)?
        } else {
            &material.dispersion
        };
        Ok(Measured::exact([law.index(lines::D), law.index(lines::G) - law.index(lines::B)]))
    })
}
