//! A metric: one score, and the sums it is computed from.

use crate::estimators;
use crate::geometry::Polyhedron;
use crate::sampling::statistic::Statistic;
use serde::{Serialize, Serializer};

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
}

/// As its name.
impl Serialize for Metric {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name)
    }
}
