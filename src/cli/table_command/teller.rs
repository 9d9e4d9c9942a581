//! What is told while a table is made.

use crate::batch::table_job::JobEvent;
use crate::cli::args::stone;
use crate::cli::console::Console;
use crate::progress::SaidOnce;
use crate::storage::journal::JournalRemark;
use indicatif::ProgressBar;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

/// Tells how a table goes on: a bar, and lines above it.
pub struct Teller<'a> {
    console: &'a Console,
    output: &'a Path,
    bar: ProgressBar,
    noted: SaidOnce,
    waited: AtomicBool,
}

impl<'a> Teller<'a> {
    /// Of a table at `output`.
    ///
    /// - `what`: word for the bar
    pub fn new(console: &'a Console, what: &'static str, output: &'a Path) -> Teller<'a> {
        let bar = console.progress(0, what);
        Teller { console, output, bar, noted: SaidOnce::default(), waited: AtomicBool::new(false) }
    }

    /// Tells of an event.
    pub fn tell(&self, event: JobEvent) {
        match event {
            JobEvent::Remark(JournalRemark::Waiting) => self.bar.suspend(|| {
                self.waited.store(true, Ordering::Relaxed);
                let output = stone::display_name(self.output);
                self.console.note(&format!("another cutlab is making {output}: waiting for it to end"));
            }),
            JobEvent::Remark(JournalRemark::Quarantined(path, why)) => self.bar.suspend(|| {
                self.console
                    .note(&format!("progress not used, {why}; it is now {}", stone::display_name(&path)));
            }),
            JobEvent::Begins { done, rows } => {
                if done > 0 {
                    self.bar
                        .suspend(|| self.console.note(&format!("{done} of {rows} rows are there: going on")));
                }
                self.bar.set_length(rows);
                self.bar.set_position(done);
                self.bar.reset_eta();
            }
            JobEvent::Row(line) => {
                if let Some(complaint) = &line.complaint {
                    self.bar.suspend(|| self.console.complain(complaint));
                }
                if let Some(note) = &line.note
                    && self.noted.is_new(kind_of(note))
                {
                    self.bar.suspend(|| self.console.note(&format!("note: {note}")));
                }
                self.bar.inc(1);
            }
        }
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }

    /// Whether the table had to wait for another process that made it.
    pub fn has_waited(&self) -> bool {
        self.waited.load(Ordering::Relaxed)
    }
}

/// What a note has in common with those of other stones that differ in their index alone.
fn kind_of(note: &str) -> &str {
    note.split(" (n = ").next().unwrap_or(note)
}
