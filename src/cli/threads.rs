//! The threads that work is done on.

use crate::progress::Progress;

/// More threads than that only take memory, and minutes to start.
pub const MOST_THREADS: u32 = 256;

/// How many threads there are, if `--threads` does not say.
const THREADS: &str = "RAYON_NUM_THREADS";

/// Starts as many threads as were asked for, but no more than [`MOST_THREADS`].
///
/// - `asked`: by `--threads`
/// - `progress`: hears if the environment asks for too many
pub fn start(asked: Option<u32>, progress: &dyn Progress) {
    let of_environment = std::env::var(THREADS).ok().and_then(|n| n.trim().parse::<u64>().ok()).unwrap_or(0);
    if asked.is_none() && of_environment > u64::from(MOST_THREADS) {
        progress.note(&format!(
            "note: {THREADS}={of_environment}: {MOST_THREADS} threads are used, the most there can be"
        ));
    }
    let threads = asked.map_or(of_environment.min(MOST_THREADS.into()), u64::from);
    // there is no pool yet, so it can only fail for want of threads: then fewer are started on demand
    let _ = rayon::ThreadPoolBuilder::new().num_threads(threads as usize).build_global();
}
