//! Progress of long work, as it is told to whoever waits for it; and whether it is to end early.

/// Hears how long work goes on, and may end it. Every method has a default that does nothing.
///
/// It is called from all threads. `()` hears nothing and ends nothing.
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
