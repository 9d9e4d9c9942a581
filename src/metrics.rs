//! The catalogue of scores, one a file. A score reads one estimator and is a function of its sums.

mod absorbed;
mod aset_blue;
mod aset_blue_strongest;
mod aset_green;
mod aset_green_strongest;
mod aset_leak;
mod aset_leak_strongest;
mod aset_red;
mod aset_red_strongest;
mod brightness;
mod contrast;
mod cos;
mod dispersion_mean;
mod dispersion_median;
mod extinction;
mod fire_lit;
mod fire_streak;
mod glare;
mod ideal_scope_black;
mod ideal_scope_red;
mod ideal_scope_white;
mod iso;
mod leakage;
mod leakage_strongest;
mod light_return;
mod sc2;
mod scintillation;
mod spread;
mod table_cos;
mod table_iso;
mod table_sc2;
mod untraced;
mod weight_ratio;
mod windowing;
mod wlr;

use crate::estimators;
use crate::geometry::Polyhedron;
use crate::parse;
pub use crate::sampling::statistic::Statistic;

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
    /// Whether a stone is the better for more of it.
    pub better: Better,
    /// Half-angle in degrees of the observer's dark cone, for a metric that has one; a plan may set
    /// another.
    pub observer: Option<f64>,
    /// Whether beams give it too (`--exact`).
    pub by_beams: bool,
    /// Whether stones that are not convex have it too: a sum of power.
    pub nonconvex: bool,
    /// Illumination, observer, polarisation, wavelengths, what counts, normalisation.
    pub definition: &'static str,
    /// Where the definition is from.
    pub source: &'static str,
    /// The estimator it reads, and what of its sums.
    pub read_from: MetricSource,
}

/// Which of two values of a score is the better, all else alike.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Better {
    /// The greater.
    More,
    /// The less.
    Less,
    /// Neither by itself: a matter of balance with others, of taste, or of no merit at all.
    Neither,
}

impl Better {
    /// In one word; empty for neither.
    pub fn word(self) -> &'static str {
        match self {
            Better::More => "more",
            Better::Less => "less",
            Better::Neither => "",
        }
    }

    /// `more is better`; empty for neither.
    pub fn said(self) -> &'static str {
        match self {
            Better::More => "more is better",
            Better::Less => "less is better",
            Better::Neither => "",
        }
    }
}

/// A score as a function of the tally of the estimator that it reads. None but `scintillation`,
/// whose axes stay, changes when the stone is turned about its own axis.
#[derive(Debug, Clone, Copy)]
pub enum MetricSource {
    /// A dome of light: [`estimators::hemisphere`].
    Hemisphere(Statistic<estimators::hemisphere::HemisphereTally>),
    /// A parallel eye: [`estimators::view`].
    View(Statistic<estimators::view::ViewTally>),
    /// A parallel eye by the rules of faceters: [`estimators::faceter_view`].
    FaceterView(Statistic<estimators::faceter_view::FaceterTally>),
    /// Cells of the picture: [`estimators::contrast`].
    Contrast(Statistic<estimators::contrast::ContrastTally>),
    /// Cells of the rocked picture: [`estimators::scintillation`].
    Scintillation(Statistic<estimators::scintillation::ScintillationTally>),
    /// A point light at infinity: [`estimators::point_light`].
    PointLight(Statistic<estimators::point_light::PointLightTally>),
    /// The solid itself: a closed form.
    Solid(fn(&Polyhedron) -> Option<f64>),
}

impl MetricSource {
    /// The estimator's name.
    pub fn estimator(self) -> &'static str {
        match self {
            MetricSource::Hemisphere(_) => "hemisphere",
            MetricSource::View(_) => "view",
            MetricSource::FaceterView(_) => "iso",
            MetricSource::Contrast(_) => "contrast",
            MetricSource::Scintillation(_) => "scintillation",
            MetricSource::PointLight(_) => "beam",
            MetricSource::Solid(_) => "solid",
        }
    }
}

impl Metric {
    /// Whether the score speaks of colours, and so means nothing for a material without dispersion.
    pub fn needs_dispersion(&self) -> bool {
        matches!(self.read_from, MetricSource::PointLight(_))
    }

    /// What it tells, and which values are the better.
    pub fn about_and_better(&self) -> String {
        match self.better.said() {
            "" => self.about.into(),
            said => format!("{}; {said}", self.about),
        }
    }

    /// The metric called `name`, or none.
    pub fn by_name(name: &str) -> Option<&'static Metric> {
        METRICS.iter().copied().find(|m| parse::is_name(m.name, name))
    }
}

/// Every metric, in the order of the columns.
pub static METRICS: &[&Metric] = &[
    &wlr::WLR,
    &light_return::LIGHT_RETURN,
    &leakage::LEAKAGE,
    &leakage_strongest::LEAKAGE_STRONGEST,
    &glare::GLARE,
    &absorbed::ABSORBED,
    &untraced::UNTRACED,
    &brightness::BRIGHTNESS,
    &aset_green::ASET_GREEN,
    &aset_red::ASET_RED,
    &aset_blue::ASET_BLUE,
    &aset_leak::ASET_LEAK,
    &aset_green_strongest::ASET_GREEN_STRONGEST,
    &aset_red_strongest::ASET_RED_STRONGEST,
    &aset_blue_strongest::ASET_BLUE_STRONGEST,
    &aset_leak_strongest::ASET_LEAK_STRONGEST,
    &ideal_scope_red::IDEAL_SCOPE_RED,
    &ideal_scope_white::IDEAL_SCOPE_WHITE,
    &ideal_scope_black::IDEAL_SCOPE_BLACK,
    &fire_lit::FIRE_LIT,
    &fire_streak::FIRE_STREAK,
    &dispersion_mean::DISPERSION_MEAN,
    &dispersion_median::DISPERSION_MEDIAN,
    &contrast::CONTRAST,
    &scintillation::SCINTILLATION,
    &iso::ISO,
    &cos::COS,
    &sc2::SC2,
    &table_iso::TABLE_ISO,
    &table_cos::TABLE_COS,
    &table_sc2::TABLE_SC2,
    &windowing::WINDOWING,
    &extinction::EXTINCTION,
    &spread::SPREAD,
    &weight_ratio::WEIGHT_RATIO,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_metric_says_what_it_is_and_has_a_name_of_its_own() {
        for (i, m) in METRICS.iter().enumerate() {
            assert!(!m.source.is_empty() && !m.about.is_empty() && m.range.0 < m.range.1, "{}", m.name);
            let light = !matches!(m.read_from, MetricSource::Solid(_));
            for word in ["npolarised", "Fresnel", "D line"].iter().filter(|_| light && !m.needs_dispersion())
            {
                assert!(m.definition.contains(word), "{} does not state: {word}", m.name);
            }
            assert_eq!(m.observer.is_some(), m.definition.contains("--observer"), "{}", m.name);
            assert_eq!(m.scale == 100.0, m.unit == "%", "{}", m.name);
            assert!(METRICS[..i].iter().all(|other| other.name != m.name), "{}", m.name);
            assert_eq!(Metric::by_name(m.name).map(|m| m.name), Some(m.name));
        }
    }
}
