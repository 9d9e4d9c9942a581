//! Reports: everything about one stone, with drawings, pictures and a page.

mod attribution;
pub mod chart;
pub mod comparison_page;
pub mod diagram;
pub mod drawing_format;
pub mod edited_file;
pub mod estimates;
mod html;
pub mod optimised_page;
pub mod page;
pub mod pdf;
pub mod plot;
pub mod raster;
pub mod references;
mod request;
pub mod sections;
pub mod stone_report;
pub mod svg_canvas;
pub mod table_plots;
pub mod target_format;
pub mod tier_advice;
pub mod tilt_curves;
pub mod validation;
pub mod viewer_images;
pub mod virtual_facets;

pub use request::{LEAST_WIDTH, ReportInput, ReportRequest, USUAL_WIDTH};
pub use stone_report::{ReportError, StoneReport, make};
