//! Reports: everything about one stone, with drawings, pictures and a page.

pub mod bundle;
pub mod chart;
pub mod diagram;
pub mod page;
pub mod pattern;
pub mod pdf;
pub mod plot;
pub mod raster;
pub mod references;
pub mod scopes;
pub mod sections;
pub mod tilts;
pub mod validation;
pub mod versus;

pub use bundle::{Bundle, ReportError, Request, make};
