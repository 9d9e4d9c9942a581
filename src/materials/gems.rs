//! Gems known by the figures of gemmological tables: indices at the D line, dispersion and density.
//!
//! None has a spectrum here: a gem of colour is traced as if it had none, and its line for people says
//! so. Natural stones vary by a few .001, garnets, sphene and tourmaline by more.

use super::Material;
use crate::optics::dispersion::{Dispersion, lines};
use std::borrow::Cow;

/// The lines between which the laws are drawn, nm.
pub(super) const VALID_NM: (f64, f64) = (lines::G, lines::B);

/// How many there are.
pub(super) const COUNT: usize = 33;

/// A row: name, line for people, index at D (of the ordinary ray; of three indices the middle one), that
/// of the extraordinary ray, B–G, mass per volume in g/cm³, source.
const fn gem(
    name: &'static str,
    about: &'static str,
    n_d: f64,
    n_e: Option<f64>,
    b_g: Option<f64>,
    specific_gravity: f64,
    source: &'static str,
) -> Material {
    Material {
        name: Cow::Borrowed(name),
        about,
        source,
        dispersion: through(n_d, b_g),
        extraordinary: match n_e {
            Some(n_e) => Some(through(n_e, b_g)),
            None => None,
        },
        valid_nm: VALID_NM,
        specific_gravity: Some(specific_gravity),
        absorption: None,
    }
}

/// Cauchy's law through an index at D and a difference between G and B; one index if that is not known.
pub(super) const fn through(n_d: f64, b_g: Option<f64>) -> Dispersion {
    let Some(b_g) = b_g else { return Dispersion::Constant(n_d) };
    let (b_um, d_um, g_um) = (lines::B / 1000.0, lines::D / 1000.0, lines::G / 1000.0);
    let b = b_g / (1.0 / (g_um * g_um) - 1.0 / (b_um * b_um));
    Dispersion::Cauchy { a: n_d - b / (d_um * d_um), b }
}

/// The gems. Indices and B–G are checked in `tests/optics.rs`.
#[rustfmt::skip]
pub(super) static GEMS: [Material; COUNT] = [
    gem("pyrope", "pyrope garnet; its colour is not known here: traced as colourless", 1.746, None, Some(0.022), 3.78, "cadby.co.uk on garnets; titangems.com (dispersion)"),
    gem("almandine", "almandine garnet; its colour is not known here: traced as colourless", 1.79, None, Some(0.024), 4.05, "cadby.co.uk on garnets (dispersion .024; Schumann .027)"),
    gem("rhodolite", "rhodolite garnet, between pyrope and almandine; its colour is not known here: traced as colourless", 1.76, None, Some(0.024), 3.84, "rocksandgems.info (index, dispersion .023 to .026); density usual, from memory"),
    gem("spessartine", "spessartine garnet; its colour is not known here: traced as colourless", 1.81, None, Some(0.027), 4.15, "cadby.co.uk on garnets; titangems.com (dispersion)"),
    gem("grossular", "grossular garnet: tsavorite, hessonite; its colour is not known here: traced as colourless", 1.74, None, Some(0.028), 3.61, "cadby.co.uk on garnets (dispersion .027 to .028; others have .020)"),
    gem("demantoid", "demantoid: green andradite garnet; its colour is not known here: traced as colourless", 1.888, None, Some(0.057), 3.84, "W. Schumann, Gemstones of the World (2009); cadby.co.uk on garnets"),
    gem("aquamarine", "aquamarine: blue beryl, ordinary ray; its colour is not known here: traced as colourless", 1.583, Some(1.577), Some(0.014), 2.71, "gemmological tables; titangems.com (dispersion)"),
    gem("morganite", "morganite: pink beryl, ordinary ray; its colour is not known here: traced as colourless", 1.592, Some(1.584), Some(0.014), 2.8, "usual values; dispersion of beryl"),
    gem("heliodor", "heliodor: yellow beryl, ordinary ray; its colour is not known here: traced as colourless", 1.577, Some(1.571), Some(0.014), 2.69, "usual values; dispersion of beryl"),
    gem("rubellite", "rubellite: red tourmaline, ordinary ray; its colour is not known here: traced as colourless", 1.644, Some(1.624), Some(0.017), 3.06, "W. Schumann, Gemstones of the World (2009); The Gemology Project"),
    gem("indicolite", "indicolite: blue tourmaline, ordinary ray; its colour is not known here: traced as colourless", 1.644, Some(1.624), Some(0.017), 3.06, "W. Schumann, Gemstones of the World (2009); The Gemology Project"),
    gem("paraiba", "Paraíba tourmaline, coloured by copper, ordinary ray; its colour is not known here: traced as colourless", 1.643, Some(1.622), Some(0.017), 3.08, "W. Schumann, Gemstones of the World (2009) (dispersion); indices and density usual, from memory"),
    gem("imperial-topaz", "topaz rich in OH: imperial, pink, middle index of 1.629, 1.631 and 1.637; its colour is not known here: traced as colourless", 1.631, None, Some(0.014), 3.53, "Wikipedia, Topaz; titangems.com (dispersion)"),
    gem("alexandrite", "alexandrite: chrysoberyl with chromium, middle index of 1.746, 1.748 and 1.755; its colour is not known here: traced as colourless", 1.748, None, Some(0.015), 3.73, "W. Schumann, Gemstones of the World (2009)"),
    gem("tanzanite", "tanzanite: blue zoisite, middle index of 1.692, 1.693 and 1.700; its colour is not known here: traced as colourless", 1.693, None, Some(0.021), 3.35, "M. O'Donoghue, Gems, 6th ed., by gemfame.com (lists of its dispersion have .012 to .030)"),
    gem("peridot", "peridot: gem olivine, middle index of 1.654, 1.671 and 1.690; its colour is not known here: traced as colourless", 1.671, None, Some(0.02), 3.34, "aglthai.com; titangems.com (dispersion)"),
    gem("kunzite", "kunzite: pink spodumene, middle index of 1.660, 1.666 and 1.676; its colour is not known here: traced as colourless", 1.666, None, Some(0.017), 3.18, "W. Schumann, Gemstones of the World (2009); gemstones-guide.com"),
    gem("hiddenite", "hiddenite: green spodumene, middle index of 1.660, 1.666 and 1.676; its colour is not known here: traced as colourless", 1.666, None, Some(0.017), 3.18, "W. Schumann, Gemstones of the World (2009); gemstones-guide.com"),
    gem("iolite", "iolite: gem cordierite, middle index of 1.542, 1.547 and 1.551; its colour is not known here: traced as colourless", 1.547, None, Some(0.017), 2.61, "W. Schumann, Gemstones of the World (2009); The Gemology Project"),
    gem("andalusite", "andalusite, middle index of 1.634, 1.639 and 1.644; its colour is not known here: traced as colourless", 1.639, None, Some(0.016), 3.16, "W. Schumann, Gemstones of the World (2009); M. O'Donoghue, Gems, 6th ed., by gemfame.com"),
    gem("chrome-diopside", "chrome diopside, middle index of 1.668, 1.676 and 1.698; its colour is not known here: traced as colourless", 1.676, None, Some(0.018), 3.29, "M. O'Donoghue, Gems, 6th ed., by gemfame.com (dispersion .017 to .020)"),
    gem("sphene", "sphene: gem titanite, middle index of 1.900, 1.907 and 2.034; its colour is not known here: traced as colourless", 1.907, None, Some(0.051), 3.53, "W. Schumann, Gemstones of the World (2009); M. O'Donoghue, Gems, 6th ed., by gemfame.com"),
    gem("apatite", "apatite, ordinary ray; its colour is not known here: traced as colourless", 1.638, Some(1.634), Some(0.013), 3.18, "The Gemology Project"),
    gem("benitoite", "benitoite, ordinary ray", 1.757, Some(1.804), Some(0.044), 3.65, "W. Schumann, Gemstones of the World (2009) (dispersion .044; others have .046)"),
    gem("danburite", "danburite, middle index of 1.630, 1.633 and 1.636", 1.633, None, Some(0.017), 3.0, "W. Schumann, Gemstones of the World (2009); M. O'Donoghue, Gems, 6th ed., by gemfame.com"),
    gem("phenakite", "phenakite, ordinary ray", 1.654, Some(1.67), Some(0.015), 2.96, "M. O'Donoghue, Gems, 6th ed., by gemfame.com"),
    gem("sphalerite", "sphalerite: zinc blende", 2.3669, None, Some(0.1625), 4.05, "Debenham, as ZnS/Debenham in refractiveindex.info (CC0), n_D and B–G of its law; lists have .156"),
    gem("opal", "precious opal, without its play of colour; its dispersion is not known", 1.45, None, None, 2.1, "usual values of the GIA Gem Reference Guide, from memory"),
    gem("fire-opal", "fire opal; its dispersion is not known; its colour is not known here: traced as colourless", 1.42, None, None, 2.0, "usual values of the GIA Gem Reference Guide, from memory"),
    gem("synthetic-spinel", "flame-fusion spinel", 1.728, None, Some(0.02), 3.64, "usual values of the GIA Gem Reference Guide, from memory"),
    gem("ggg", "GGG (gadolinium gallium garnet)", 1.97, None, Some(0.038), 7.05, "W. Schumann, Gemstones of the World (2009) (dispersion .038; others have .045)"),
    gem("lithium-niobate", "lithium niobate, ordinary ray", 2.2997, Some(2.2135), Some(0.125), 4.64, "Zelmon et al., as LiNbO3/Zelmon-o and -e in refractiveindex.info (CC0), n_D and B–G of the laws"),
    gem("paste", "paste: lead glass as Schott's F2", 1.6199, None, Some(0.03), 3.6, "Schott, as F2 in refractiveindex.info (CC0), n_D and B–G of its law"),
];
