//! Progress of library work, as bars on a terminal.

use super::console::Console;
use crate::progress::Progress;
use indicatif::ProgressBar;
use std::sync::{Mutex, PoisonError};

/// Shows each step as a bar, or as a clock where it has no count.
pub struct BarProgress<'a> {
    console: &'a Console,
    bar: Mutex<Option<ProgressBar>>,
}

impl<'a> BarProgress<'a> {
    /// Of a command.
    pub fn new(console: &'a Console) -> BarProgress<'a> {
        BarProgress { console, bar: Mutex::new(None) }
    }

    fn with_bar(&self, work: impl FnOnce(&ProgressBar)) {
        if let Some(bar) = &*self.bar.lock().unwrap_or_else(PoisonError::into_inner) {
            work(bar);
        }
    }
}

impl Progress for BarProgress<'_> {
    fn begin(&self, what: &str, parts: u64) {
        let bar = match parts {
            0 => self.console.spinner(""),
            parts => self.console.progress(parts as usize, ""),
        };
        bar.set_message(what.to_owned());
        *self.bar.lock().unwrap_or_else(PoisonError::into_inner) = Some(bar);
    }

    fn advance(&self, parts: u64) {
        self.with_bar(|bar| bar.inc(parts));
    }

    fn say(&self, what: &str) {
        self.with_bar(|bar| bar.set_message(what.to_owned()));
    }

    fn end(&self) {
        if let Some(bar) = self.bar.lock().unwrap_or_else(PoisonError::into_inner).take() {
            bar.finish_and_clear();
        }
    }

    fn note(&self, text: &str) {
        let bar = self.bar.lock().unwrap_or_else(PoisonError::into_inner);
        match &*bar {
            Some(bar) => bar.suspend(|| self.console.note(text)),
            None => self.console.note(text),
        }
    }
}
