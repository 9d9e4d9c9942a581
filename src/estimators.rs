//! Estimators: the traced sums that metrics read, each traced once a stone.
//!
//! [`Hemisphere`]: a dome of light, everything that comes out. [`View`]: a parallel eye in front of the
//! stone, traced backward; [`FaceterView`] the same by the rules of faceters; [`Contrast`] and
//! [`Scintillation`] what a picture of it shows in cells that an eye can tell apart. [`PointLight`]: a
//! point light at infinity, in colours. [`nonconvex`] has the first two for stones that are not convex;
//! [`picture`] traces a view pixel by pixel. An estimator adds up the columns of its tally in independent
//! batches ([`BatchedEstimate`]); a [`Metric`] is a function of such sums, a row of its estimator's table, and
//! the spread of the batches is its error. A kind of estimator says what it is an [`EstimatorKind`] of;
//! [`ESTIMATORS`] lists them all. The viewer, and the light with him, stands in a [`ViewFrame`].

pub mod batches;
pub mod beam_tallies;
pub mod beam_view;
pub mod catalogue;
pub mod colour_separation;
pub mod contrast;
mod entry_sampling;
pub mod facet_leakage;
pub mod faceter_view;
pub mod fire;
pub mod hemisphere;
pub mod horizon;
pub mod kind;
pub mod nonconvex;
pub mod picture;
pub mod pixel_cells;
pub mod point_light;
pub mod quadrature;
mod same_path;
pub mod scintillation;
pub mod solid;
pub mod strongest_path;
mod trace_optics;
pub mod view;
pub mod view_frame;
pub mod view_metrics;
pub mod viewer_lighting;
mod wavelengths;
pub mod weighted_exits;

pub use batches::{BATCHES, BatchedEstimate, Estimator};
pub use catalogue::ESTIMATORS;
pub use contrast::Contrast;
pub use faceter_view::FaceterView;
pub use hemisphere::Hemisphere;
pub use kind::{Better, EstimatorKind, Method, Metric, MetricSource, Setup};
pub use point_light::PointLight;
pub use quadrature::Quadrature;
pub use scintillation::Scintillation;
pub use trace_optics::{EstimatorError, STOP_POWER, TraceOptics};
use trace_optics::{LineOptics, check_index};
pub use view::View;
pub use view_frame::ViewFrame;
