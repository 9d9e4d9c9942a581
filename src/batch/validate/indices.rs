//! Indices of refraction and dispersion of materials.

use super::context::material;
use super::{Check, CheckError, Figure, FigureSource, Measured, SourceKind};
use crate::optics::dispersion::{Dispersion, lines};

const SUBJECT: &str = "indices";

const PETER: FigureSource =
    FigureSource { kind: SourceKind::Published, name: "diamond at the Fraunhofer lines (Peter)" };
const DATABASE: FigureSource = FigureSource { kind: SourceKind::Published, name: "refractiveindex.info" };
const SCHOTT: FigureSource = FigureSource { kind: SourceKind::Published, name: "Schott's data sheet" };
const HANDBOOK: FigureSource = FigureSource { kind: SourceKind::Published, name: "gemmological tables" };

const DIAMOND: [(&str, f64, f64); 8] = [
    ("B", lines::B, 2.40728),
    ("C", lines::C, 2.40990),
    ("D", lines::D, 2.41726),
    ("d", lines::D_HELIUM, 2.41749),
    ("e", lines::E, 2.42359),
    ("F", lines::F, 2.43554),
    ("G", lines::G, 2.45173),
    ("h", lines::H, 2.46205),
];

/// Whether the extraordinary ray; n_D and its tolerance; B–G and its tolerance (both lines are rounded
/// where it is printed).
type IndexRow = (&'static str, bool, (f64, f64), Option<(f64, f64)>, FigureSource);

const FIVE: f64 = 1e-5;

const MATERIALS: [IndexRow; 24] = [
    ("diamond", false, (2.41726, FIVE), Some((0.04444, FIVE)), DATABASE),
    ("corundum", false, (1.76808, FIVE), Some((0.0181, 1e-4)), DATABASE),
    ("corundum", true, (1.76000, FIVE), Some((0.0177, 1e-4)), DATABASE),
    ("quartz", false, (1.54421, FIVE), Some((0.0133, 1e-4)), DATABASE),
    ("quartz", true, (1.55331, FIVE), Some((0.0138, 1e-4)), DATABASE),
    ("spinel", false, (1.71610, FIVE), Some((0.0202, 1e-4)), DATABASE),
    ("moissanite", false, (2.64743, FIVE), Some((0.112, 1e-3)), DATABASE),
    ("moissanite", true, (2.68897, FIVE), None, DATABASE),
    ("cubic-zirconia", false, (2.15846, FIVE), Some((0.0604, 1e-4)), DATABASE),
    ("yag", false, (1.83265, FIVE), Some((0.0272, 1e-4)), DATABASE),
    ("strontium-titanate", false, (2.40799, FIVE), Some((0.2096, 1e-4)), DATABASE),
    ("rutile", false, (2.61291, FIVE), Some((0.31, 1e-2)), DATABASE),
    ("rutile", true, (2.90865, FIVE), Some((0.40, 1e-2)), DATABASE),
    ("zircon", false, (1.925, 1e-3), Some((0.039, 6e-4)), HANDBOOK),
    ("zircon", true, (1.984, 1e-3), None, HANDBOOK),
    ("topaz", false, (1.612, 1e-3), Some((0.014, 6e-4)), HANDBOOK),
    ("imperial-topaz", false, (1.631, 1e-3), Some((0.014, 6e-4)), HANDBOOK),
    ("beryl", false, (1.583, 1e-3), Some((0.014, 6e-4)), HANDBOOK),
    ("beryl", true, (1.577, 1e-3), None, HANDBOOK),
    ("tourmaline", false, (1.644, 1e-3), Some((0.017, 6e-4)), HANDBOOK),
    ("tourmaline", true, (1.624, 1e-3), None, HANDBOOK),
    ("calcite", false, (1.6584, 1e-3), None, HANDBOOK),
    ("calcite", true, (1.4864, 1e-3), None, HANDBOOK),
    ("chrysoberyl", false, (1.748, 1e-3), None, HANDBOOK),
];

/// The checks of this subject.
pub fn checks() -> Vec<Check> {
    let line = |(name, _, n): &(&str, f64, f64)| {
        Figure::near(format!("diamond at the line {name}"), PETER, *n, 2e-5)
    };
    let mut checks = vec![Check::new(SUBJECT, DIAMOND.iter().map(line).collect(), |_| {
        let diamond = material("diamond")?;
        Ok(Measured::exact(DIAMOND.map(|(_, nm, _)| diamond.index(nm))))
    })];
    checks.extend(MATERIALS.into_iter().map(index_check));
    let glass = vec![
        Figure::near("n-bk7 at d", SCHOTT, 1.51680, FIVE),
        Figure::near("n-bk7, F–C", SCHOTT, 0.008054, 2e-6),
    ];
    checks.push(Check::new(SUBJECT, glass, |_| {
        let glass = material("n-bk7")?;
        Ok(Measured::exact([glass.index(lines::D_HELIUM), glass.index(lines::F) - glass.index(lines::C)]))
    }));
    for (name, n, tolerance) in [("fused-silica", 1.45846, 1e-5), ("fluorite", 1.43385, 2e-5)] {
        let source = FigureSource { kind: SourceKind::Published, name: "Malitson's table" };
        let figure = Figure::near(format!("{name} at d"), source, n, tolerance);
        checks.push(Check::new(SUBJECT, vec![figure], move |_| {
            Ok(Measured::exact([material(name)?.index(lines::D_HELIUM)]))
        }));
    }
    checks
}

fn index_check((name, extraordinary, (n, digits), b_g, source): IndexRow) -> Check {
    let ray = if extraordinary { " extraordinary" } else { "" };
    let mut figures = vec![Figure::near(format!("{name}{ray} at D"), source, n, digits)];
    figures.extend(b_g.map(|(b_g, d)| Figure::near(format!("{name}{ray}, B–G"), source, b_g, d)));
    Check::new(SUBJECT, figures, move |_| {
        let material = material(name)?;
        let none = || CheckError::Unknown(format!("extraordinary ray of {name}"));
        let law: &Dispersion = if extraordinary {
            material.extraordinary.as_ref().ok_or_else(none)?
        } else {
            &material.dispersion
        };
        Ok(Measured::exact([law.index(lines::D), law.index(lines::G) - law.index(lines::B)]))
    })
}
