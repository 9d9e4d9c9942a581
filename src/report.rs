//! Reports: diagrams, the ASET picture, and the page that shows everything about one stone.

pub mod aset;
pub mod diagram;
pub mod page;
