//! The view as scores have it, and its metrics.

use super::EstimatorError;
use super::kind::{Better, EstimatorKind, LIGHT, Method, Metric, MetricSource, Setup};
use super::view::{
    self, BELOW, BLUE, COLUMNS, DARK_RAYS, GREEN, LUMINANCE, RAYS, RED, SCOPE_BRIGHT, SCOPE_DARK,
    STRONGEST_BELOW, STRONGEST_BLUE, STRONGEST_GREEN, STRONGEST_RED, View, WINDOWED,
};
use super::viewer_lighting::{GIA_OBSERVER_DEG, SCOPE_DEG, ViewerLighting};
use crate::sampling::statistic::Statistic;
use crate::sampling::tally::{Column, Tally};
use crate::trace::ConvexStone;

/// The view.
#[derive(Debug, Clone, Copy)]
pub struct ViewKind;

impl EstimatorKind for ViewKind {
    fn name(&self) -> &'static str {
        "view"
    }

    fn metrics(&self) -> &'static [Metric] {
        &METRICS
    }

    fn columns(&self) -> &'static [Column] {
        &COLUMNS
    }

    fn methods<'a>(&self, stone: &'a ConvexStone, setup: Setup<'a>, _: &[&Metric]) -> Vec<Method<'a>> {
        vec![Method::samples("view", setup.medium.wavelengths_per_point(), move || {
            View::in_setup(stone, &setup)
        })]
    }

    fn bounds_of_untraced(&self, sums: &Tally) -> Vec<Tally> {
        view::bounds_of_untraced(sums)
    }
}

impl<'a> View<'a> {
    /// Looks at a stone as its metrics do.
    pub fn in_setup(stone: &'a ConvexStone, setup: &Setup) -> Result<Self, EstimatorError> {
        let view = Self::in_frame(stone, &setup.medium, setup.view_frame, lighting(setup))?;
        Ok(view.with_stop_power(setup.stop_power))
    }
}

/// The lighting of the view in a setup.
pub(super) fn lighting(setup: &Setup) -> ViewerLighting {
    ViewerLighting { scope: setup.dome(SCOPE_DEG), dome: setup.dome(GIA_OBSERVER_DEG) }
}

const VIEW_WITHOUT_HEAD: &str =
    "Parallel face-up view traced backward over the whole outline, no observer's head;";
const VIEW: &str = "Parallel face-up view traced backward over the whole outline;";
const POWER: &str = "Share of the sight lines' power that comes from";
const STRONGEST_PATH: &str = "Share of the outline whose strongest path comes from";
const NO_GLARE: &str = "by whatever facet; reflection at entry not counted.";
const AS_SHOWN: &str = "as a photograph shows it; reflection at entry not counted.";
const CONE: &str = "The cone's half-angle is 12° (about 24° are blocked in all), or --observer.";

/// What the rows have in common.
const ROW: Metric = Metric {
    by_beams: true,
    nonconvex: true,
    source: "colours of the ASET, American Gem Society (P. Yantzer et al., 2005)",
    ..Metric::of(&ViewKind, MetricSource::Sums(Statistic::Mean(GREEN, RAYS, 1.0)))
};

/// The metrics.
static METRICS: [Metric; 15] = [
    Metric {
        name: "leakage_strongest",
        about: "share of the outline whose strongest path comes from below",
        better: Better::Less,
        nonconvex: false,
        definition: &[VIEW_WITHOUT_HEAD, LIGHT, STRONGEST_PATH, "below the horizon,", AS_SHOWN],
        read_from: MetricSource::Sums(Statistic::Share(STRONGEST_BELOW, RAYS)),
        ..ROW
    },
    Metric {
        name: "brightness",
        about: "mean luminance of the face-up stone under a white dome, dark where the viewer is",
        better: Better::More,
        observer: Some(GIA_OBSERVER_DEG),
        definition: &[
            VIEW,
            LIGHT,
            "White dome above the horizon with a dark observer cone of 23° half-angle, or --observer. \
                Mean luminance over the outline per luminance of the dome, by whatever facet, reflection at \
                entry included.",
        ],
        source: "dome with a dark cone of 23°: T. Moses et al., Gems & Gemology 40 (2004) 202; the mean is \
            cutlab's",
        read_from: MetricSource::Sums(Statistic::Mean(LUMINANCE, RAYS, 1.0)),
        ..ROW
    },
    Metric {
        name: "aset_green",
        about: "share of what one sees face-up that comes from low light, 0–45°",
        definition: &[VIEW_WITHOUT_HEAD, LIGHT, POWER, "0 to 45° above the girdle plane,", NO_GLARE],
        read_from: MetricSource::Sums(Statistic::Mean(GREEN, RAYS, 1.0)),
        ..ROW
    },
    Metric {
        name: "aset_red",
        about: "share from 45–75°, the light that matters most",
        better: Better::More,
        definition: &[VIEW_WITHOUT_HEAD, LIGHT, POWER, "45 to 75° above the girdle plane,", NO_GLARE],
        read_from: MetricSource::Sums(Statistic::Mean(RED, RAYS, 1.0)),
        ..ROW
    },
    Metric {
        name: "aset_blue",
        about: "share from 75–90°, where the viewer's head is: contrast",
        definition: &[VIEW_WITHOUT_HEAD, LIGHT, POWER, "75 to 90° above the girdle plane,", NO_GLARE],
        read_from: MetricSource::Sums(Statistic::Mean(BLUE, RAYS, 1.0)),
        ..ROW
    },
    Metric {
        name: "aset_leak",
        about: "share from below: windows",
        better: Better::Less,
        definition: &[VIEW_WITHOUT_HEAD, LIGHT, POWER, "below the horizon,", NO_GLARE],
        read_from: MetricSource::Sums(Statistic::Mean(BELOW, RAYS, 1.0)),
        ..ROW
    },
    Metric {
        name: "aset_green_strongest",
        about: "share of the outline whose strongest path is green, as in the picture",
        nonconvex: false,
        definition: &[VIEW_WITHOUT_HEAD, LIGHT, STRONGEST_PATH, "0 to 45° above the girdle plane,", AS_SHOWN],
        read_from: MetricSource::Sums(Statistic::Share(STRONGEST_GREEN, RAYS)),
        ..ROW
    },
    Metric {
        name: "aset_red_strongest",
        about: "share of the outline whose strongest path is red",
        better: Better::More,
        nonconvex: false,
        definition: &[
            VIEW_WITHOUT_HEAD,
            LIGHT,
            STRONGEST_PATH,
            "45 to 75° above the girdle plane,",
            AS_SHOWN,
        ],
        read_from: MetricSource::Sums(Statistic::Share(STRONGEST_RED, RAYS)),
        ..ROW
    },
    Metric {
        name: "aset_blue_strongest",
        about: "share of the outline whose strongest path is blue",
        nonconvex: false,
        definition: &[
            VIEW_WITHOUT_HEAD,
            LIGHT,
            STRONGEST_PATH,
            "75 to 90° above the girdle plane,",
            AS_SHOWN,
        ],
        read_from: MetricSource::Sums(Statistic::Share(STRONGEST_BLUE, RAYS)),
        ..ROW
    },
    Metric {
        name: "aset_leak_strongest",
        about: "share of the outline whose strongest path leaks, as in the picture; the same as \
            leakage_strongest",
        better: Better::Less,
        nonconvex: false,
        definition: &[VIEW, LIGHT, "No observer's head.", STRONGEST_PATH, "below the horizon,", AS_SHOWN],
        read_from: MetricSource::Sums(Statistic::Share(STRONGEST_BELOW, RAYS)),
        ..ROW
    },
    Metric {
        name: "ideal_scope_red",
        about: "share of what one sees face-up that comes back from around the viewer (Ideal-Scope red)",
        better: Better::More,
        observer: Some(SCOPE_DEG),
        definition: &[
            VIEW,
            LIGHT,
            POWER,
            "above the horizon, outside the dark cone about the viewer,",
            NO_GLARE,
            CONE,
        ],
        source: "colours of the Ideal-Scope (K. Okuda, 1984; G. Holloway): red return, white leakage, black \
            viewer",
        read_from: MetricSource::Sums(Statistic::Mean(SCOPE_BRIGHT, RAYS, 1.0)),
        ..ROW
    },
    Metric {
        name: "ideal_scope_white",
        about: "share of what one sees face-up that comes from below (Ideal-Scope white: leakage)",
        better: Better::Less,
        definition: &[
            VIEW,
            LIGHT,
            POWER,
            "below the horizon, by whatever facet: what an Ideal-Scope shows white; reflection at entry \
                not counted. Equal to aset_leak.",
        ],
        source: "colours of the Ideal-Scope (K. Okuda, 1984; G. Holloway): red return, white leakage, black \
            viewer",
        read_from: MetricSource::Sums(Statistic::Mean(BELOW, RAYS, 1.0)),
        ..ROW
    },
    Metric {
        name: "ideal_scope_black",
        about: "share of what one sees face-up that comes from the viewer himself (Ideal-Scope black)",
        observer: Some(SCOPE_DEG),
        definition: &[VIEW, LIGHT, POWER, "within the dark cone about the viewer,", NO_GLARE, CONE],
        source: "colours of the Ideal-Scope (K. Okuda, 1984; G. Holloway): red return, white leakage, black \
            viewer",
        read_from: MetricSource::Sums(Statistic::Mean(SCOPE_DARK, RAYS, 1.0)),
        ..ROW
    },
    Metric {
        name: "windowing",
        about: "share of the outline through which one looks straight out of the bottom",
        better: Better::Less,
        nonconvex: false,
        definition: &[
            VIEW,
            LIGHT,
            "No observer's head. Share of the outline whose strongest path leaves through the first \
                pavilion facet (or culet) that it meets; reflection at entry not counted.",
        ],
        source: "the faceters' window, as defined by cutlab",
        read_from: MetricSource::Sums(Statistic::Share(WINDOWED, RAYS)),
        ..ROW
    },
    Metric {
        name: "extinction",
        about: "share of the outline that is dark without being a window",
        better: Better::Less,
        observer: Some(GIA_OBSERVER_DEG),
        by_beams: false,
        nonconvex: false,
        definition: &[
            VIEW,
            LIGHT,
            "White dome above the horizon with a dark observer cone of 23° half-angle, or --observer. \
                Share of the outline, windowing aside, whose luminance is under a tenth of the dome's, by \
                whatever facet, reflection at entry included.",
        ],
        source: "the faceters' extinction, as defined by cutlab",
        read_from: MetricSource::Sums(Statistic::Share(DARK_RAYS, RAYS)),
        ..ROW
    },
];
