//! Topaz.

use super::{Material, gems};
use std::borrow::Cow;

/// Topaz rich in fluorine, as colourless and blue stones are; biaxial: its middle index. Stones rich in
/// OH have higher ones: `imperial-topaz`.
pub static TOPAZ: Material = Material {
    name: Cow::Borrowed("topaz"),
    about: "topaz rich in fluorine (colourless, blue), middle index of 1.609, 1.612 and 1.619",
    source: "n_D and B–G of gemmological tables (Wikipedia, Topaz; The Gemology Project), as a Cauchy law through both",
    dispersion: gems::through(1.612, Some(0.014)),
    extraordinary: None,
    valid_nm: gems::VALID_NM,
    specific_gravity: Some(3.56),
    absorption: None,
};
