//! Progress of long work where there is no terminal: a line on standard error every half minute.

use crate::storage::terminal::printable;
use indicatif::{HumanDuration, ProgressBar, WeakProgressBar};
use std::io::Write;
use std::sync::{Mutex, Once, PoisonError};
use std::time::Duration;

/// Time from one line to the next.
const EVERY: Duration = Duration::from_secs(30);

/// Bars of work that may still go on, the newest last.
static BARS: Mutex<Vec<WeakProgressBar>> = Mutex::new(Vec::new());
static BEAT: Once = Once::new();

/// Tells of a bar until it is finished or dropped.
pub fn watch(bar: &ProgressBar) {
    BARS.lock().unwrap_or_else(PoisonError::into_inner).push(bar.downgrade());
    BEAT.call_once(|| {
        std::thread::spawn(|| {
            loop {
                std::thread::sleep(EVERY);
                if let Some(bar) = newest() {
                    let _ = writeln!(std::io::stderr(), "{}", printable(&line(&bar)));
                }
            }
        });
    });
}

/// The bar of the work that began last of those that go on.
fn newest() -> Option<ProgressBar> {
    let mut bars = BARS.lock().unwrap_or_else(PoisonError::into_inner);
    let going = |bar: &WeakProgressBar| bar.upgrade().filter(|bar| !bar.is_finished());
    bars.retain(|bar| going(bar).is_some());
    bars.last().and_then(going)
}

/// What is done, how much of how much, for how long, and for how long still.
fn line(bar: &ProgressBar) -> String {
    let elapsed = HumanDuration(bar.elapsed());
    let message = bar.message();
    match bar.length().filter(|n| *n > 0) {
        None => format!("{message}: {elapsed} so far"),
        Some(all) => {
            let left = bar.eta();
            let left =
                if left.is_zero() { String::new() } else { format!(", about {} left", HumanDuration(left)) };
            format!("{message}: {} of {all}, {elapsed} so far{left}", bar.position())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_tells_how_far_the_work_is() {
        let bar = ProgressBar::hidden();
        bar.set_message("round 7, noise 4.1 %");
        assert!(line(&bar).starts_with("round 7, noise 4.1 %: 0 seconds so far"), "{}", line(&bar));
        let rows = ProgressBar::hidden();
        rows.set_length(480);
        rows.set_message("rendering");
        rows.inc(120);
        std::thread::sleep(Duration::from_millis(20));
        rows.inc(120);
        assert!(line(&rows).starts_with("rendering: 240 of 480, "), "{}", line(&rows));
    }

    #[test]
    fn the_newest_work_that_goes_on_is_told_of() {
        let (outer, inner) = (ProgressBar::hidden(), ProgressBar::hidden());
        outer.set_message("frames");
        inner.set_message("photons");
        watch(&outer);
        watch(&inner);
        assert_eq!(newest().map(|b| b.message()).as_deref(), Some("photons"));
        inner.finish_and_clear();
        assert_eq!(newest().map(|b| b.message()).as_deref(), Some("frames"));
        drop(outer);
        assert!(newest().is_none());
    }
}
