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
mod metric;
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

use crate::parse;
pub use crate::sampling::statistic::Statistic;
pub use metric::{Better, Metric, MetricSource};
use serde::{Deserialize, Deserializer};
use std::borrow::Cow;

impl Metric {
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

/// By its name, which must be in the catalogue.
impl<'de> Deserialize<'de> for &'static Metric {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<&'static Metric, D::Error> {
        let name = Cow::<str>::deserialize(deserializer)?;
        Metric::by_name(&name)
            .ok_or_else(|| serde::de::Error::custom(format!("no metric is called '{name}'")))
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
