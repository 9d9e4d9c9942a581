//! One counter-based random stream per photon or pixel.
//!
//! A stream is a pure function of (seed, purpose, index), so a result does not depend on how many
//! threads worked on it or in which order.

use rand_philox::{Philox, splitmix64, u32_to_unit_f32, u32_to_unit_f64};

/// What a stream is drawn for, by a name. Streams of different names never share numbers.
///
/// A user of random numbers declares its name once, as a constant: names are turned into keys while the
/// program is compiled. `tests/house/layers.rs` checks that no name is declared twice and no two names have one
/// key.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Purpose {
    key: u64,
}

/// Keys that published results were drawn with, from before keys were hashes of names: with other keys all
/// scores, pictures and files under `reports/` would change within their errors. New names need no row.
const PUBLISHED: [(&str, u64); 20] = [
    ("hemisphere", 1),
    ("view", 2),
    ("point light", 3),
    ("caustic photon", 4),
    ("global photon", 5),
    ("pixel", 6),
    ("test", 7),
    ("beam residual", 8),
    ("faceter view", 9),
    ("contrast", 10),
    ("scintillation", 11),
    ("quadrature", 12),
    ("nonconvex", 13),
    ("score hue", 14),
    ("scatter", 20),
    ("camera ray", 21),
    ("shadow ray", 22),
    ("hue", 23),
    ("lens", 24),
    ("glare", 25),
];

impl Purpose {
    /// Tests and tools.
    pub const TEST: Purpose = Purpose::named("test");

    /// The purpose called `name`.
    pub const fn named(name: &str) -> Purpose {
        let mut row = 0;
        while row < PUBLISHED.len() {
            if is_same(PUBLISHED[row].0.as_bytes(), name.as_bytes()) {
                return Purpose { key: PUBLISHED[row].1 };
            }
            row += 1;
        }
        Purpose { key: fnv_1a(name.as_bytes()) }
    }
}

/// Whether two strings are the same, for constants.
const fn is_same(a: &[u8], b: &[u8]) -> bool {
    let mut i = 0;
    while i < a.len() && i < b.len() && a[i] == b[i] {
        i += 1;
    }
    i == a.len() && i == b.len()
}

/// The 64-bit FNV-1a hash (G. Fowler, L. C. Noll, K.-P. Vo).
const fn fnv_1a(bytes: &[u8]) -> u64 {
    let mut hash = 0xcbf2_9ce4_8422_2325;
    let mut i = 0;
    while i < bytes.len() {
        hash = (hash ^ bytes[i] as u64).wrapping_mul(0x0000_0100_0000_01b3);
        i += 1;
    }
    hash
}

/// A stream of random numbers: Philox 4×32-10 keyed by seed and purpose, counted by index.
#[derive(Debug, Clone)]
pub struct Stream(Philox);

impl Stream {
    /// The stream number `index` of `purpose` under the user's `--seed`.
    pub fn new(seed: u64, purpose: Purpose, index: u64) -> Self {
        let key = splitmix64(seed ^ purpose.key.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        Self(Philox::from_u64_seed_stream(key, index))
    }

    /// Uniform on the open interval (0, 1), 23 bits.
    #[inline]
    pub fn unit(&mut self) -> f32 {
        u32_to_unit_f32(self.0.next_u32())
    }

    /// Uniform on the open interval (0, 1), 32 bits.
    #[inline]
    pub fn unit64(&mut self) -> f64 {
        u32_to_unit_f64(self.0.next_u32())
    }

    /// Two independent uniforms.
    #[inline]
    pub fn pair(&mut self) -> [f32; 2] {
        [self.unit(), self.unit()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stream_depends_on_seed_purpose_and_index_alone() {
        let draw = |seed, purpose, index| Stream::new(seed, purpose, index).unit();
        let first = draw(1, Purpose::TEST, 5);
        assert_eq!(first, draw(1, Purpose::TEST, 5));
        assert_ne!(first, draw(2, Purpose::TEST, 5));
        assert_ne!(first, draw(1, Purpose::named("view"), 5));
        assert_ne!(first, draw(1, Purpose::TEST, 6));
    }

    /// [P] FNV's authors give the hash of "foobar"; the first name published had the key 1.
    #[test]
    fn names_are_keys() {
        assert_eq!(fnv_1a(b"foobar"), 0x8594_4171_f739_67e8);
        assert_eq!(Purpose::named("foobar").key, 0x8594_4171_f739_67e8);
        assert_eq!(Purpose::named("hemisphere").key, 1);
        assert_ne!(Purpose::named("hemispher"), Purpose::named("hemisphere"));
    }

    #[test]
    fn neighbouring_streams_are_uncorrelated() {
        let n = 20_000;
        let xy: f64 = (0..n)
            .map(|i| {
                let a = Stream::new(1, Purpose::TEST, i).unit64() - 0.5;
                let b = Stream::new(1, Purpose::TEST, i + 1).unit64() - 0.5;
                a * b
            })
            .sum::<f64>()
            / n as f64;
        // standard error of the mean product: (1/12)/√n
        assert!(xy.abs() < 4.0 / 12.0 / (n as f64).sqrt(), "{xy}");
    }
}
