//! How many rays a packet has.

/// Lanes of a packet: one AVX-512 register of `f32`, two of AVX2.
pub const LANES: usize = 16;

/// One number per lane.
pub type Lanes = [f32; LANES];
