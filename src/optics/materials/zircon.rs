//! Zircon.

use super::Material;
use crate::optics::dispersion::Dispersion;
use std::borrow::Cow;

/// High zircon, ordinary ray; its extraordinary law is not in the project's sources.
pub static ZIRCON: Material = Material {
    name: Cow::Borrowed("zircon"),
    about: "zircon, ordinary ray",
    source: "n_D and B–G of gemmological tables, as a Cauchy law through both",
    dispersion: Dispersion::Cauchy { a: 1.890963, b: 0.011820 },
    extraordinary: None,
    valid_um: (0.4308, 0.6867),
    specific_gravity: Some(4.65),
    absorption: None,
};
