//! Scintillation.

use super::{Better, Metric, MetricSource, Statistic};
use crate::estimators::pixel_cells::AGS_OBSERVER_DEG;

/// Scintillation.
pub static SCINTILLATION: Metric = Metric {
    name: "scintillation",
    about: "how much the picture changes for each degree that the stone is rocked",
    unit: "1/°",
    range: (0.0, 2.0),
    scale: 1.0,
    better: Better::Neither,
    observer: Some(AGS_OBSERVER_DEG),
    by_beams: false,
    nonconvex: false,
    definition: "Parallel view traced backward over the whole outline; unpolarised light, Fresnel \
        with its polarisation followed inside (scalar with --polarisation off), D line (for a stone \
        that absorbs, luminance under D65). White dome above the horizon with a dark observer cone of \
        15° half-angle, or --observer; reflection at entry included. The luminance is the mean over \
        square cells of 1/100 of the girdle's width (what of them lies in the outline; mean over all \
        ways to lay the grid). The stone is rocked over ±15° in steps of 1° about the picture's right \
        and about its top (azimuths 0 and 90°); the pivot is the middle of the table, which stays in \
        its place in the picture, or without a table the middle of the outline at half the girdle's \
        height. The dome stays with the viewer. Mean |change of a cell's luminance| in a step, per \
        mean luminance, by the cells' area in the outline.",
    source: "resolution: J. Sasián et al., Optical Engineering 46 (2007) 093604; observer: American Gem Society; the figure is cutlab's",
    read_from: MetricSource::Scintillation(Statistic::Smooth(|t| t.change / t.luminance)),
};
