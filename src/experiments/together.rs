//! Lines of one ray that are compared: as long as they meet the same facets.

use crate::walk::{LANES, Meeting};

/// For rays of `K` lines in lanes next to each other, whether the lines have met the same facets so
/// far. By the first lane of each ray.
#[derive(Debug, Clone, Copy)]
pub(super) struct Together<const K: usize>([bool; LANES]);

impl<const K: usize> Together<K> {
    /// Before the first ray.
    pub(super) const NONE: Together<K> = Together([false; LANES]);

    /// First lanes of the rays of a packet.
    pub(super) fn lanes() -> impl Iterator<Item = usize> {
        (0..LANES / K).map(|ray| ray * K)
    }

    /// A new ray in the lanes from `lane` on.
    pub(super) fn begin(&mut self, lane: usize) {
        self.0[lane] = true;
    }

    /// Whether the lines of the ray in the lanes from `lane` on have come the same way so far.
    pub(super) fn still(&self, lane: usize) -> bool {
        self.0[lane]
    }

    /// Whether all lines of the ray in the lanes from `lane` on leave at this meeting, and have come
    /// the same way.
    #[inline]
    pub(super) fn leave(&mut self, m: &Meeting, lane: usize) -> bool {
        let facets = &m.facet[lane..lane + K];
        self.0[lane] &= facets.iter().all(|f| *f == facets[0]);
        self.0[lane] && m.power[lane..lane + K].iter().all(|p| *p > 0.0)
    }
}
