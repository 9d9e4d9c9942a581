//! Chooses the instruction set at run time: the only `unsafe` of the crate.
//!
//! [`Vectorised`] work is safe code, compiled three times under `#[target_feature]`. Calling such a
//! function is `unsafe` because the machine might lack the instructions; an [`Isa`] can only be
//! obtained after asking the machine, so the calls below are sound. `tests/library/trace/` checks that all
//! three builds agree.

#![allow(unsafe_code)]

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

/// Work that is compiled for each instruction set.
pub(super) trait Vectorised {
    /// What it returns.
    type Output;

    /// Does the work; `#[inline(always)]`, so that it is compiled with the caller's instructions.
    ///
    /// - `FUSED`: whether a fused multiply-add is an instruction (a library call otherwise)
    /// - `W`: `f32` lanes that fill a register; `B`: accumulators of such lanes that fit into the registers
    fn run<const FUSED: bool, const W: usize, const B: usize>(self) -> Self::Output;
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl,avx512dq,avx2,fma")]
fn run_avx512<V: Vectorised>(work: V) -> V::Output {
    work.run::<true, 16, 4>()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn run_avx2<V: Vectorised>(work: V) -> V::Output {
    work.run::<true, 8, 2>()
}

impl Isa {
    /// Does some work with this instruction set.
    pub(super) fn run<V: Vectorised>(self, work: V) -> V::Output {
        match self.0 {
            InstructionSet::Portable => work.run::<false, 8, 1>(),
            // SAFETY: an Isa of this level exists only where the features were detected
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx2 => unsafe { run_avx2(work) },
            // SAFETY: as above
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx512 => unsafe { run_avx512(work) },
        }
    }
}
