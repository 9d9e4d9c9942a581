//! Zircon.

use super::{Material, gems};
use std::borrow::Cow;

/// Line B less line G of the ordinary ray; that of the other is not known apart.
const B_G: f64 = 0.039;

/// High zircon, ordinary ray: of the gems in common use the one that doubles most, by .059.
pub static ZIRCON: Material = Material {
    name: Cow::Borrowed("zircon"),
    about: "zircon of high type, ordinary ray",
    source: "n_D and B–G of gemmological tables (W. Schumann 2009; indygem.com), as a Cauchy law through both",
    dispersion: gems::through(1.925, Some(B_G)),
    extraordinary: Some(gems::through(1.984, Some(B_G))),
    valid_nm: gems::VALID_NM,
    specific_gravity: Some(4.70),
    absorption: None,
};
