//! COS of the table.

use super::{Better, Metric, MetricSource, Statistic};
use crate::estimators::faceter_view::{FaceterWeight, GEMRAY_OBSERVER_DEG};

/// COS of the table.
pub static TABLE_COS: Metric = Metric {
    name: "table_cos",
    about: "percent of bright light that the table returns face-up, most weight for light from above (GemRay COS)",
    unit: "%",
    range: (0.0, 100.0),
    scale: 100.0,
    better: Better::More,
    observer: Some(GEMRAY_OBSERVER_DEG),
    by_beams: true,
    nonconvex: false,
    definition: "Parallel view from the eye over the table alone; light that is unpolarised at every \
        facet (scalar Fresnel, whatever --polarisation), D line (for a stone that absorbs, luminance \
        under D65). Rays of at most ten segments, the incoming one and nine inside. Power from \
        directions whose sine h of elevation lies above 0 and outside the shadow of the viewer's head \
        (10° half-angle, or --observer; 0 for none), weighted by h; exits and reflections at entry \
        count at facets that face the viewer (cosine above 1e-4). Mean over the table alone, in \
        percent. The light stays with the viewer when the stone is tilted.",
    source: "R. W. Strickland's GemRay, as the project's reference figures have it",
    read_from: MetricSource::FaceterView(Statistic::Mean(
        |t| [t.table[FaceterWeight::Cos as usize], t.table_rays],
        100.0,
    )),
};
