//! An interrupt from the keyboard, SIGTERM or SIGHUP: one line, exit code 130.

use super::error::complain;
use std::io::{IsTerminal, Write};
use std::sync::atomic::{AtomicBool, Ordering};

/// Exit code after an interrupt: 128 + SIGINT, as shells have it.
const INTERRUPTED: i32 = 130;

/// Whether this command, started again, goes on where it was.
static RESUMABLE: AtomicBool = AtomicBool::new(false);

/// Marks the command as resumable: from here on it keeps what it has done, and an interrupt says so.
pub fn mark_resumable() {
    RESUMABLE.store(true, Ordering::Relaxed);
}

/// Ends after an interrupt, with one line.
pub fn interrupted() -> ! {
    if std::io::stderr().is_terminal() {
        let _ = writeln!(std::io::stderr()); // below the progress bar
    }
    let on = RESUMABLE.load(Ordering::Relaxed);
    complain(if on { "interrupted; the same command goes on where it was" } else { "interrupted" });
    std::process::exit(INTERRUPTED)
}
