//! Quartz: rock crystal, amethyst, citrine, without their colour.

use super::Material;
use crate::optics::dispersion::Dispersion;
use std::borrow::Cow;

/// Quartz, ordinary ray.
const fn quartz(name: &'static str, about: &'static str) -> Material {
    Material {
        name: Cow::Borrowed(name),
        about,
        source: "G. Ghosh 1999, as SiO2/Ghosh-o and -e in refractiveindex.info (CC0)",
        dispersion: Dispersion::SellmeierSquared {
            c0: 0.28604141,
            terms: &[(1.07044083, 0.0100585997), (1.10202242, 100.0)],
        },
        extraordinary: Some(Dispersion::SellmeierSquared {
            c0: 0.28851804,
            terms: &[(1.09509924, 0.0102101864), (1.15662475, 100.0)],
        }),
        valid_nm: (198.0, 2050.0),
        specific_gravity: Some(2.65),
        absorption: None,
    }
}

/// Rock crystal.
pub static QUARTZ: Material = quartz("quartz", "quartz (rock crystal), ordinary ray, colourless");

/// Violet quartz.
pub static AMETHYST: Material = quartz(
    "amethyst",
    "amethyst: violet quartz, ordinary ray; its colour is not known here: traced as colourless",
);

/// Yellow quartz.
pub static CITRINE: Material = quartz(
    "citrine",
    "citrine: yellow quartz, ordinary ray; its colour is not known here: traced as colourless",
);
