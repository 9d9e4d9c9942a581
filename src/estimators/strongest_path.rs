//! Strongest path: of all the ways that light goes from its entry, the one on which most of it leaves the stone.
//!
//! Photons and beams keep it by the same two rules: the exit of greatest power, of equal ones the first; and
//! whether that is at the first pavilion facet that the light met, which is a window.

use crate::trace::{Interaction, LANES, Lanes};

/// The strongest exit of light so far. Reflection at entry is none.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StrongestExit<T, D> {
    /// Its power; 0 before the first exit.
    pub power: T,
    /// Where it goes.
    pub towards: D,
    /// 1 if it is at the first pavilion facet that the light met, else 0.
    pub windowed: T,
}

impl<T: Copy + PartialOrd, D: Copy> StrongestExit<T, D> {
    /// The stronger of the strongest exit so far and the next one.
    ///
    /// - `power`: of the next one; `exit`: gives its `towards` and `windowed`, called if it is the stronger
    #[inline(always)]
    pub(super) fn or_stronger(self, power: T, exit: impl FnOnce() -> (D, T)) -> StrongestExit<T, D> {
        if power > self.power {
            let (towards, windowed) = exit();
            StrongestExit { power, towards, windowed }
        } else {
            self
        }
    }
}

/// Light meets a facet: 1 if that is the first of the pavilion that it meets, else 0.
///
/// - `been_below`: above 0 once the light has met the pavilion; `pavilion`: 1 if the facet belongs to it, else 0
#[inline(always)]
pub(super) fn first_below<T: Copy + PartialOrd + Default>(been_below: &mut T, pavilion: T) -> T {
    let none = T::default();
    let first = if *been_below > none { none } else { pavilion };
    *been_below = if pavilion > none { pavilion } else { *been_below };
    first
}

/// The strongest paths of the rays of a packet, `K` wavelengths each, in lanes next to each other: the exit with
/// the greatest power over all wavelengths, by the direction of the strongest of them.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct StrongestPaths<const K: usize> {
    power: Lanes,
    up: Lanes,
    windowed: Lanes,
    been_below: Lanes,
}

impl<const K: usize> StrongestPaths<K> {
    /// A new ray is in the lanes from `lane` on.
    pub(super) fn begin(&mut self, lane: usize) {
        self.been_below[lane..lane + K].fill(0.0);
    }

    /// What is known of the path in a lane so far: whether it has met the pavilion.
    pub(super) fn state(&self, lane: usize) -> f32 {
        self.been_below[lane]
    }

    /// Another branch of the ray goes on in a lane.
    pub(super) fn resume(&mut self, lane: usize, state: f32) {
        self.been_below[lane] = state;
    }

    /// Every ray meets a facet.
    ///
    /// - `up`: for each lane, sine of the elevation at which its light leaves; `pavilion`: 1 if its facet
    ///   belongs to the pavilion, else 0
    #[inline(always)]
    pub(super) fn interact(&mut self, m: &Interaction, up: &Lanes, pavilion: &Lanes) {
        let mut first = [0.0; LANES];
        for l in 0..LANES {
            first[l] = first_below(&mut self.been_below[l], pavilion[l]);
        }
        for ray in (0..LANES).step_by(K) {
            let powers = &m.power[ray..ray + K];
            let power = powers.iter().sum::<f32>();
            let so_far =
                StrongestExit { power: self.power[ray], towards: self.up[ray], windowed: self.windowed[ray] };
            let StrongestExit { power, towards, windowed } = so_far.or_stronger(power, || {
                let most = (1..K).fold(0, |most, k| if powers[k] > powers[most] { k } else { most });
                (up[ray + most], first[ray + most])
            });
            (self.power[ray], self.up[ray], self.windowed[ray]) = (power, towards, windowed);
        }
    }

    /// The strongest exit of the ray in the lanes from `lane` on, which is at its end; `towards` is the sine of its
    /// elevation.
    pub(super) fn finish(&mut self, lane: usize) -> StrongestExit<f32, f32> {
        StrongestExit {
            power: std::mem::take(&mut self.power[lane]),
            towards: self.up[lane],
            windowed: std::mem::take(&mut self.windowed[lane]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three facets, the second and third of the pavilion: exits at all, the last two equally strong.
    #[test]
    fn the_first_of_the_strongest_exits_counts_and_is_a_window_at_the_first_pavilion_facet() {
        let (pavilion, powers, ups) = ([0.0, 1.0, 1.0], [0.1, 0.3, 0.3], [0.5, -0.2, 0.9]);
        let (mut best, mut been_below) = (StrongestExit::<f64, f64>::default(), 0.0);
        let mut lanes = StrongestPaths::<2>::default();
        lanes.begin(4);
        for i in 0..3 {
            let windowed = first_below(&mut been_below, pavilion[i]);
            best = best.or_stronger(powers[i], || (ups[i], windowed));
            let mut m = Interaction::default();
            // the second wavelength is the stronger one
            (m.power[4], m.power[5]) = (0.0, powers[i] as f32);
            let mut up = [-1.0; LANES];
            up[5] = ups[i] as f32;
            lanes.interact(&m, &up, &[pavilion[i] as f32; LANES]);
        }
        assert_eq!(best, StrongestExit { power: 0.3, towards: -0.2, windowed: 1.0 });
        assert_eq!(lanes.finish(4), StrongestExit { power: 0.3, towards: -0.2, windowed: 1.0 });
        assert_eq!(lanes.finish(4).power, 0.0, "the next ray has no exit yet");
    }
}
