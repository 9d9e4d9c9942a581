//! Chooses the instruction set at run time: the only `unsafe` of the crate.
//!
//! The kernels are safe code compiled three times, under `#[target_feature]`. Calling such a
//! function is `unsafe` because the machine might lack the instructions; an [`Isa`] can only be
//! obtained after asking the machine, so the calls below are sound. The portable build of the same
//! kernels is their twin; `tests/walk.rs` checks that all agree.

#![allow(unsafe_code)]

use super::beams::run::Run;
use super::beams::{Light, Totals, Watch};
use super::packet::{Meeting, NextFacets, Packet};
use super::stone::{Hit, Stone};
use super::{kernel, search};
use glam::Vec3;

/// An instruction set that this machine has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Isa(Level);

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Level {
    Portable,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl Isa {
    /// Whatever the compiler's baseline has.
    pub const PORTABLE: Isa = Isa(Level::Portable);

    /// Every set that this machine has, slowest first.
    pub fn all() -> Vec<Isa> {
        #[allow(unused_mut)]
        let mut all = vec![Isa::PORTABLE];
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
                all.push(Isa(Level::Avx2));
                if is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("avx512vl")
                    && is_x86_feature_detected!("avx512dq")
                {
                    all.push(Isa(Level::Avx512));
                }
            }
        }
        all
    }

    /// The fastest set of this machine.
    pub fn best() -> Isa {
        static BEST: std::sync::LazyLock<Isa> =
            std::sync::LazyLock::new(|| Isa::all().last().copied().unwrap_or(Isa::PORTABLE));
        *BEST
    }

    /// Its name in benchmarks and reports.
    pub fn name(self) -> &'static str {
        match self.0 {
            Level::Portable => "portable",
            #[cfg(target_arch = "x86_64")]
            Level::Avx2 => "avx2",
            #[cfg(target_arch = "x86_64")]
            Level::Avx512 => "avx512",
        }
    }
}

/// [`kernel::meet`] with what the packet's light needs.
#[inline(always)]
fn meet_as_needed<const FUSED: bool, const W: usize, const B: usize>(
    stone: &Stone,
    packet: &mut Packet,
    out: &mut Meeting,
) {
    match (packet.polarised, packet.absorbing) {
        (false, false) => kernel::meet::<FUSED, W, B, false, false>(stone, packet, out),
        (false, true) => kernel::meet::<FUSED, W, B, false, true>(stone, packet, out),
        (true, false) => kernel::meet::<FUSED, W, B, true, false>(stone, packet, out),
        (true, true) => kernel::meet::<FUSED, W, B, true, true>(stone, packet, out),
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl,avx512dq,avx2,fma")]
fn meet_avx512(stone: &Stone, packet: &mut Packet, out: &mut Meeting) {
    meet_as_needed::<true, 16, 4>(stone, packet, out);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn meet_avx2(stone: &Stone, packet: &mut Packet, out: &mut Meeting) {
    meet_as_needed::<true, 8, 2>(stone, packet, out);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl,avx512dq,avx2,fma")]
fn next_facets_avx512(stone: &Stone, packet: &Packet, next: &mut NextFacets) {
    search::next_facets::<true, 16, 4>(stone, packet, next);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn next_facets_avx2(stone: &Stone, packet: &Packet, next: &mut NextFacets) {
    search::next_facets::<true, 8, 2>(stone, packet, next);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl,avx512dq,avx2,fma")]
fn first_hit_avx512(stone: &Stone, origin: Vec3, direction: Vec3) -> Option<Hit> {
    search::first_hit::<true>(stone, origin, direction)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn first_hit_avx2(stone: &Stone, origin: Vec3, direction: Vec3) -> Option<Hit> {
    search::first_hit::<true>(stone, origin, direction)
}

/// [`kernel::meet`] with the stone's instruction set.
pub(super) fn meet(stone: &Stone, packet: &mut Packet, out: &mut Meeting) {
    match stone.isa.0 {
        Level::Portable => meet_as_needed::<false, 8, 1>(stone, packet, out),
        // SAFETY: an Isa of this level exists only where the features were detected
        #[cfg(target_arch = "x86_64")]
        Level::Avx2 => unsafe { meet_avx2(stone, packet, out) },
        // SAFETY: as above
        #[cfg(target_arch = "x86_64")]
        Level::Avx512 => unsafe { meet_avx512(stone, packet, out) },
    }
}

/// [`search::next_facets`] with the stone's instruction set.
pub(super) fn next_facets(stone: &Stone, packet: &Packet) -> NextFacets {
    let mut next = NextFacets::default();
    match stone.isa.0 {
        Level::Portable => search::next_facets::<false, 8, 1>(stone, packet, &mut next),
        // SAFETY: an Isa of this level exists only where the features were detected
        #[cfg(target_arch = "x86_64")]
        Level::Avx2 => unsafe { next_facets_avx2(stone, packet, &mut next) },
        // SAFETY: as above
        #[cfg(target_arch = "x86_64")]
        Level::Avx512 => unsafe { next_facets_avx512(stone, packet, &mut next) },
    }
    next
}

/// [`search::first_hit`] with the stone's instruction set.
pub(super) fn first_hit(stone: &Stone, origin: Vec3, direction: Vec3) -> Option<Hit> {
    match stone.isa.0 {
        Level::Portable => search::first_hit::<false>(stone, origin, direction),
        // SAFETY: an Isa of this level exists only where the features were detected
        #[cfg(target_arch = "x86_64")]
        Level::Avx2 => unsafe { first_hit_avx2(stone, origin, direction) },
        // SAFETY: as above
        #[cfg(target_arch = "x86_64")]
        Level::Avx512 => unsafe { first_hit_avx512(stone, origin, direction) },
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl,avx512dq,avx2,fma")]
fn follow_avx512<L: Light, W: Watch<L, K>, const K: usize>(run: Run<L, W, K>, light: L) -> Totals {
    run.all(light)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn follow_avx2<L: Light, W: Watch<L, K>, const K: usize>(run: Run<L, W, K>, light: L) -> Totals {
    run.all(light)
}

/// [`Run::all`] with the stone's instruction set.
pub(super) fn follow<L: Light, W: Watch<L, K>, const K: usize>(
    stone: &Stone,
    run: Run<L, W, K>,
    light: L,
) -> Totals {
    match stone.isa.0 {
        Level::Portable => run.all(light),
        // SAFETY: an Isa of this level exists only where the features were detected
        #[cfg(target_arch = "x86_64")]
        Level::Avx2 => unsafe { follow_avx2(run, light) },
        // SAFETY: as above
        #[cfg(target_arch = "x86_64")]
        Level::Avx512 => unsafe { follow_avx512(run, light) },
    }
}
