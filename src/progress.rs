//! Progress of long work, as it is told to whoever waits for it; and whether it is to end early.

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
