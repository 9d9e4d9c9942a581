//! Chooses the instruction set at run time: the only `unsafe` of the crate.
//!
//! The kernels are safe code compiled three times, under `#[target_feature]`. Calling such a
//! function is `unsafe` because the machine might lack the instructions; an [`Isa`] can only be
//! obtained after asking the machine, so the calls below are sound. The portable build of the same
//! kernels is their twin; `tests/trace/` checks that all agree.

#![allow(unsafe_code)]

use super::beams::beam_tracer::BeamTracer;
use super::beams::{BeamLight, BeamVisitor, EnergyBudget};
use super::packet::{Interaction, NextFacets, Packet};
use super::stone::{ConvexStone, FacetHit};
use super::{intersect, kernel};
use glam::Vec3;

/// An instruction set that this machine has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Isa(InstructionSet);

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum InstructionSet {
    Portable,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl Isa {
    /// Whatever the compiler's baseline has.
    pub const PORTABLE: Isa = Isa(InstructionSet::Portable);

    /// Every set that this machine has, slowest first.
    pub fn all() -> Vec<Isa> {
        #[allow(unused_mut)]
        let mut all = vec![Isa::PORTABLE];
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
                all.push(Isa(InstructionSet::Avx2));
                if is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("avx512vl")
                    && is_x86_feature_detected!("avx512dq")
                {
                    all.push(Isa(InstructionSet::Avx512));
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
            InstructionSet::Portable => "portable",
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx2 => "avx2",
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx512 => "avx512",
        }
    }
}

/// [`kernel::interact`] with what the packet's light needs.
#[inline(always)]
fn interact_as_needed<const FUSED: bool, const W: usize, const B: usize>(
    stone: &ConvexStone,
    packet: &mut Packet,
    out: &mut Interaction,
) {
    match (packet.polarised, packet.absorbing) {
        (false, false) => kernel::interact::<FUSED, W, B, false, false>(stone, packet, out),
        (false, true) => kernel::interact::<FUSED, W, B, false, true>(stone, packet, out),
        (true, false) => kernel::interact::<FUSED, W, B, true, false>(stone, packet, out),
        (true, true) => kernel::interact::<FUSED, W, B, true, true>(stone, packet, out),
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl,avx512dq,avx2,fma")]
fn interact_avx512(stone: &ConvexStone, packet: &mut Packet, out: &mut Interaction) {
    interact_as_needed::<true, 16, 4>(stone, packet, out);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn interact_avx2(stone: &ConvexStone, packet: &mut Packet, out: &mut Interaction) {
    interact_as_needed::<true, 8, 2>(stone, packet, out);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl,avx512dq,avx2,fma")]
fn next_facets_avx512(stone: &ConvexStone, packet: &Packet, next: &mut NextFacets) {
    intersect::next_facets::<true, 16, 4>(stone, packet, next);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn next_facets_avx2(stone: &ConvexStone, packet: &Packet, next: &mut NextFacets) {
    intersect::next_facets::<true, 8, 2>(stone, packet, next);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl,avx512dq,avx2,fma")]
fn intersect_outside_avx512(stone: &ConvexStone, origin: Vec3, direction: Vec3) -> Option<FacetHit> {
    intersect::intersect_outside::<true>(stone, origin, direction)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn intersect_outside_avx2(stone: &ConvexStone, origin: Vec3, direction: Vec3) -> Option<FacetHit> {
    intersect::intersect_outside::<true>(stone, origin, direction)
}

/// [`kernel::interact`] with the stone's instruction set.
pub(super) fn interact(stone: &ConvexStone, packet: &mut Packet, out: &mut Interaction) {
    match stone.isa.0 {
        InstructionSet::Portable => interact_as_needed::<false, 8, 1>(stone, packet, out),
        // SAFETY: an Isa of this level exists only where the features were detected
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx2 => unsafe { interact_avx2(stone, packet, out) },
        // SAFETY: as above
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx512 => unsafe { interact_avx512(stone, packet, out) },
    }
}

/// [`intersect::next_facets`] with the stone's instruction set.
pub(super) fn next_facets(stone: &ConvexStone, packet: &Packet) -> NextFacets {
    let mut next = NextFacets::default();
    match stone.isa.0 {
        InstructionSet::Portable => intersect::next_facets::<false, 8, 1>(stone, packet, &mut next),
        // SAFETY: an Isa of this level exists only where the features were detected
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx2 => unsafe { next_facets_avx2(stone, packet, &mut next) },
        // SAFETY: as above
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx512 => unsafe { next_facets_avx512(stone, packet, &mut next) },
    }
    next
}

/// [`intersect::intersect_outside`] with the stone's instruction set.
pub(super) fn intersect_outside(stone: &ConvexStone, origin: Vec3, direction: Vec3) -> Option<FacetHit> {
    match stone.isa.0 {
        InstructionSet::Portable => intersect::intersect_outside::<false>(stone, origin, direction),
        // SAFETY: an Isa of this level exists only where the features were detected
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx2 => unsafe { intersect_outside_avx2(stone, origin, direction) },
        // SAFETY: as above
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx512 => unsafe { intersect_outside_avx512(stone, origin, direction) },
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl,avx512dq,avx2,fma")]
fn trace_beams_avx512<L: BeamLight, W: BeamVisitor<L, K>, const K: usize>(
    run: BeamTracer<L, W, K>,
    light: L,
) -> EnergyBudget {
    run.run(light)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn trace_beams_avx2<L: BeamLight, W: BeamVisitor<L, K>, const K: usize>(
    run: BeamTracer<L, W, K>,
    light: L,
) -> EnergyBudget {
    run.run(light)
}

/// [`BeamTracer::run`] with the stone's instruction set.
pub(super) fn trace_beams<L: BeamLight, W: BeamVisitor<L, K>, const K: usize>(
    stone: &ConvexStone,
    run: BeamTracer<L, W, K>,
    light: L,
) -> EnergyBudget {
    match stone.isa.0 {
        InstructionSet::Portable => run.run(light),
        // SAFETY: an Isa of this level exists only where the features were detected
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx2 => unsafe { trace_beams_avx2(run, light) },
        // SAFETY: as above
        #[cfg(target_arch = "x86_64")]
        InstructionSet::Avx512 => unsafe { trace_beams_avx512(run, light) },
    }
}
