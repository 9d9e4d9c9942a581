//! Shapes of the data set: corners and polygons.

use super::super::mesh_import::Digits;
use crate::geometry::facet_recovery::Polygon;
use glam::DVec3;

/// Corners and polygons of one shape.
pub(super) type PolygonShape = (Vec<DVec3>, Vec<Polygon>);

/// The shapes of a file, and the digits of their numbers.
pub(super) type PolygonShapes = (Vec<PolygonShape>, Digits);
