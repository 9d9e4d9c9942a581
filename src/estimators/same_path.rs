//! Same path: whether the spectral lines of one ray have met the same facets so far.

use crate::trace::{Interaction, LANES};

/// For rays of `K` lines in lanes next to each other, whether the lines have met the same facets so
/// far. By the first lane of each ray.
#[derive(Debug, Clone, Copy)]
pub(super) struct SamePath<const K: usize>([bool; LANES]);

impl<const K: usize> SamePath<K> {
    /// Before the first ray.
    pub(super) const NONE: SamePath<K> = SamePath([false; LANES]);

    /// First lanes of the rays of a packet.
    pub(super) fn lanes() -> impl Iterator<Item = usize> {
        (0..LANES / K).map(|ray| ray * K)
    }

    /// A new ray in the lanes from `lane` on.
    pub(super) fn begin(&mut self, lane: usize) {
        self.0[lane] = true;
    }

    /// Whether the lines of the ray in the lanes from `lane` on have met the same facets so far.
    pub(super) fn is_same(&self, lane: usize) -> bool {
        self.0[lane]
    }

    /// Whether all lines of the ray in the lanes from `lane` on leave at this interaction, and have met the
    /// same facets.
    #[inline]
    pub(super) fn leave(&mut self, m: &Interaction, lane: usize) -> bool {
        let facets = &m.facet[lane..lane + K];
        self.0[lane] &= facets.iter().all(|f| *f == facets[0]);
        self.0[lane] && m.power[lane..lane + K].iter().all(|p| *p > 0.0)
    }
}
