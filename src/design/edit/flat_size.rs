//! Sizes that are set in percent: table, culet and girdle, as they are measured on the solid.

use crate::design::proportions;
use crate::geometry::Polyhedron;

/// A size that can be set.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Size {
    Table,
    Girdle,
    Culet,
}

impl Size {
    /// Its name in settings.
    pub fn name(self) -> &'static str {
        match self {
            Size::Table => "table",
            Size::Girdle => "girdle",
            Size::Culet => "culet",
        }
    }

    /// In percent of the girdle width; none if the stone has none.
    pub fn percent(self, solid: &Polyhedron) -> Option<f64> {
        let measured = proportions::measure(solid);
        match self {
            Size::Table => measured.table_percent,
            Size::Girdle => Some(measured.girdle_percent),
            Size::Culet => Some(measured.culet_percent).filter(|p| *p > 0.0),
        }
    }
}
