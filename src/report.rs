//! Reports: everything about one stone, with drawings, the ASET picture and a page.

pub mod aset;
pub mod bundle;
pub mod diagram;
pub mod page;
pub mod pattern;
pub mod plot;
pub mod raster;
pub mod sections;
pub mod validation;
pub mod versus;

pub use bundle::{Bundle, ReportError, Request, make};
