//! The catalogue of scores, one a file. A score reads one experiment and is a ratio of its sums.

mod aset_blue;
mod aset_blue_strongest;
mod aset_green;
mod aset_green_strongest;
mod aset_leak;
mod aset_red;
mod aset_red_strongest;
mod dispersion_mean;
mod fire_lit;
mod fire_streak;
mod glare;
mod leakage;
mod leakage_strongest;
mod light_return;
mod lost;
mod wlr;

use crate::experiments::{beam, hemisphere, view};

/// One score.
#[derive(Debug)]
pub struct Metric {
    /// Its name on the command line and in tables.
    pub name: &'static str,
    /// What it tells, in one line for people.
    pub about: &'static str,
    /// Its unit; empty for a fraction.
    pub unit: &'static str,
    /// Least and greatest value it can take.
    pub range: (f64, f64),
    /// What an error asked for is measured against: 1 for fractions and degrees, 100 for percentages.
    pub scale: f64,
    /// Half-angle in degrees of the observer's dark cone, for a metric that has one; a plan may set
    /// another.
    pub observer: Option<f64>,
    /// Illumination, observer, polarisation, wavelengths, what counts, normalisation.
    pub definition: &'static str,
    /// Where the definition is from.
    pub source: &'static str,
    /// The experiment it reads, and the numerator and denominator in it.
    pub reading: Reading,
}

/// Numerator and denominator of a score, from the tally of the experiment that it reads. None of
/// them changes when the stone is turned about its axis.
#[derive(Debug, Clone, Copy)]
pub enum Reading {
    /// A dome of light: [`hemisphere`].
    Hemisphere(fn(&hemisphere::Tally) -> (f64, f64)),
    /// A parallel eye: [`view`].
    View(fn(&view::Tally) -> (f64, f64)),
    /// A point light at infinity: [`beam`].
    Beam(fn(&beam::Tally) -> (f64, f64)),
}

impl Reading {
    /// The experiment's name.
    pub fn experiment(self) -> &'static str {
        match self {
            Reading::Hemisphere(_) => "hemisphere",
            Reading::View(_) => "view",
            Reading::Beam(_) => "beam",
        }
    }
}

impl Metric {
    /// Whether the score speaks of colours, and so means nothing for a material without dispersion.
    pub fn needs_dispersion(&self) -> bool {
        matches!(self.reading, Reading::Beam(_))
    }

    /// The metric called `name`, or none.
    pub fn named(name: &str) -> Option<&'static Metric> {
        METRICS.iter().copied().find(|m| m.name == name)
    }
}

/// Every metric, in the order of the columns.
pub static METRICS: &[&Metric] = &[
    &wlr::WLR,
    &light_return::LIGHT_RETURN,
    &glare::GLARE,
    &leakage::LEAKAGE,
    &lost::LOST,
    &fire_lit::FIRE_LIT,
    &fire_streak::FIRE_STREAK,
    &dispersion_mean::DISPERSION_MEAN,
    &aset_green::ASET_GREEN,
    &aset_red::ASET_RED,
    &aset_blue::ASET_BLUE,
    &aset_leak::ASET_LEAK,
    &aset_green_strongest::ASET_GREEN_STRONGEST,
    &aset_red_strongest::ASET_RED_STRONGEST,
    &aset_blue_strongest::ASET_BLUE_STRONGEST,
    &leakage_strongest::LEAKAGE_STRONGEST,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_metric_says_what_it_is_and_has_a_name_of_its_own() {
        for (i, m) in METRICS.iter().enumerate() {
            assert!(!m.source.is_empty() && !m.about.is_empty() && m.range.0 < m.range.1, "{}", m.name);
            for word in ["npolarised", "Fresnel", "line"] {
                assert!(m.definition.contains(word), "{} does not state: {word}", m.name);
            }
            assert!(METRICS[..i].iter().all(|other| other.name != m.name), "{}", m.name);
            assert_eq!(Metric::named(m.name).map(|m| m.name), Some(m.name));
        }
    }
}
