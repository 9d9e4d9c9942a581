//! Meets that cannot be kept.

/// A change that the meet network does not allow. Facets are numbers in the design.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NetworkError {
    /// Facets that met in a corner no longer can.
    #[error("the meet cannot be kept: it opens by {:.2e} of the width", .by)]
    Opens {
        /// The facets that met.
        facets: Vec<usize>,
        /// By how much the worst misses the corner of the others, in parts of the width.
        by: f64,
    },
    /// A corner in which facets met would be cut away by another facet.
    #[error("the meet would be cut away by another facet, {:.2e} of the width deep", .depth)]
    CutAway {
        /// The facets that met.
        facets: Vec<usize>,
        /// The facet that cuts it away.
        by: usize,
        /// How deep, in parts of the width.
        depth: f64,
    },
    /// Facets of which nothing would be left.
    #[error("facets would be lost")]
    Lost {
        /// The facets.
        facets: Vec<usize>,
    },
    /// Planes that bound no stone any more.
    #[error("no stone is left: {0}")]
    Solid(crate::geometry::SolidError),
}
