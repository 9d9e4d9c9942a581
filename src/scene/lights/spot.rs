//! The spot: a small disc that shines in a cone.

use super::LightType;
use super::disc::Disc;
use std::sync::Arc;

/// `at`, `to`, `radius`, `cone`.
pub static KIND: LightType = LightType {
    name: "spot",
    about: "a disc that shines in a cone of so many degrees: at, to, radius, cone",
    read: |entry, place| {
        let radius = entry.radius(place)?;
        let half_deg = 0.5 * entry.cone_deg()?;
        Ok(Arc::new(Disc::facing(entry.position(place)?, entry.to(place)?, radius, half_deg)))
    },
};
