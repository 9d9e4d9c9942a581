//! Stones of a table by the shape of their outlines.

use crate::design::outline_shape::OutlineShape;
use crate::parallel;
use crate::stone::{Stone, StoneOptions};
use std::ffi::OsString;

/// The stones with one of these outlines, in their order; with no outline given all of them.
///
/// A stone that does not open stays: its row says why. A mesh with dents has no outline.
pub fn with_outline(
    stones: Vec<OsString>,
    options: &StoneOptions,
    outlines: &[OutlineShape],
) -> Vec<OsString> {
    if outlines.is_empty() {
        return stones;
    }
    let stays = parallel::map(stones.len(), |i| {
        let Ok(stone) = Stone::open(&stones[i], options) else { return true };
        stone.solid().is_some_and(|solid| outlines.contains(&OutlineShape::of(solid)))
    });
    stones.into_iter().zip(stays).filter_map(|(stone, stays)| stays.then_some(stone)).collect()
}
