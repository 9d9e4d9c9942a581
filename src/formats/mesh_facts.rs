//! What is known of a file that was understood but holds no convex stone.

use super::error::FormatError;
use crate::geometry::SolidError;
use crate::geometry::facet_recovery::RecoverError;

/// What is known of a file that was understood but holds no convex stone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeshFacts {
    /// The file's format.
    pub format: &'static str,
    /// How many facets it lists, if it lists facets.
    pub facets: Option<usize>,
    /// Whether its surface closes.
    pub closed: bool,
    /// Whether it is convex, if that can be said.
    pub convex: Option<bool>,
}

impl FormatError {
    /// What is known of the file, if it was understood but holds no convex stone.
    pub fn mesh_facts(&self) -> Option<MeshFacts> {
        let FormatError::NoStone { format, facets, cause } = self else { return None };
        let (closed, convex) = match &**cause {
            FormatError::Solid { cause: SolidError::Open { .. }, .. } => (false, Some(true)),
            FormatError::Mesh { cause: RecoverError::Open(_), .. } => (false, None),
            FormatError::Mesh { cause: RecoverError::NotConvex(_) | RecoverError::Shells(_), .. } => {
                (true, Some(false))
            }
            _ => return None,
        };
        Some(MeshFacts { format, facets: *facets, closed, convex })
    }
}
