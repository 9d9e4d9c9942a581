//! Progress of long work, as it is told to whoever waits for it; and whether it is to end early.

use std::collections::BTreeSet;
use std::sync::{Mutex, PoisonError};

/// Hears how long work goes on, and may end it. Every method has a default that does nothing.
///
/// It is called from all threads. `()` hears nothing and ends nothing.
///
/// ```
/// use cutlab::Progress;
/// use std::sync::atomic::{AtomicU64, Ordering};
///
/// /// Counts the parts that are done, and ends the work after ten.
/// struct Ten(AtomicU64);
///
/// impl Progress for Ten {
///     fn advance(&self, parts: u64) {
///         self.0.fetch_add(parts, Ordering::Relaxed);
///     }
///
///     fn is_cancelled(&self) -> bool {
///         self.0.load(Ordering::Relaxed) >= 10
///     }
/// }
///
/// let progress = Ten(AtomicU64::new(0));
/// progress.advance(12);
/// assert!(progress.is_cancelled());
/// ```
pub trait Progress: Sync {
    /// A step begins.
    ///
    /// - `what`: the step, in a word or two
    /// - `parts`: how many parts it has; 0 if that is not known
    fn begin(&self, what: &str, parts: u64) {
        let _ = (what, parts);
    }

    /// So many more parts of the step are done.
    fn advance(&self, parts: u64) {
        let _ = parts;
    }

    /// More about the step: `round 3, noise 2.1 %`.
    fn say(&self, what: &str) {
        let _ = what;
    }

    /// The step has ended.
    fn end(&self) {}

    /// Something that the reader may want to know when the work is done.
    fn note(&self, text: &str) {
        let _ = text;
    }

    /// Whether the work is to end as soon as it can.
    fn is_cancelled(&self) -> bool {
        false
    }
}

impl Progress for () {}

/// What has been said already, of what is said once for many stones.
#[derive(Debug, Default)]
pub struct SaidOnce(Mutex<BTreeSet<String>>);

impl SaidOnce {
    /// Whether nothing of this key has been said; from now on it has.
    pub fn is_new(&self, key: &str) -> bool {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).insert(key.to_owned())
    }

    /// Notes something once.
    ///
    /// - `key`: what tells it from other things
    pub fn note(&self, progress: &dyn Progress, text: &str, key: &str) {
        if self.is_new(key) {
            progress.note(text);
        }
    }

    /// Notes something of one stone, once for all stones of which the same is to be said.
    ///
    /// - `key`: what is the same
    pub fn note_of_one(&self, progress: &dyn Progress, text: &str, key: &str) {
        self.note(progress, &format!("note: {text} (not said of others)"), key);
    }
}
