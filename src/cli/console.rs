//! What a command says and where: results on standard output, notes and progress on standard
//! error.

use super::args::values;
use super::error::{CliError, complain};
use super::heartbeat;
use super::threads::MOST_THREADS;
use crate::progress::Progress;
use crate::storage::terminal::{in_line, printable, printable_json};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::Write;

/// The options that every command has.
#[derive(Debug, Clone, clap::Args)]
pub struct Console {
    /// No notes and no progress, errors only
    #[arg(long, short, global = true, display_order = 1000)]
    quiet: bool,
    /// Replace files that are there, whoever made them; an input never
    #[arg(long, global = true, display_order = 1000)]
    pub force: bool,
    /// Results as JSON
    #[arg(long, global = true, display_order = 1000)]
    pub json: bool,
    /// Work on this many threads [RAYON_NUM_THREADS, or one for each processor]; the results are the
    /// same on any number
    #[arg(long, short = 'j', global = true, display_order = 1000, value_name = "N", value_parser = values::whole_number(1..=MOST_THREADS, "threads are a whole number"))]
    pub threads: Option<u32>,
}

/// What work tells without a bar: its notes.
impl Progress for Console {
    fn note(&self, text: &str) {
        Console::note(self, text);
    }
}

impl Console {
    /// A result: standard output, without what a terminal would obey.
    pub fn print(&self, text: &str) -> Result<(), CliError> {
        self.write(&printable(text))
    }

    fn write(&self, text: &str) -> Result<(), CliError> {
        let mut out = std::io::stdout().lock();
        let newline = if text.ends_with('\n') { "" } else { "\n" };
        write!(out, "{text}{newline}").and_then(|()| out.flush()).map_err(|e| CliError::output(&e))
    }

    /// What was made, where files are the result: standard output, unless quiet.
    pub fn tell(&self, text: &str) -> Result<(), CliError> {
        if self.quiet { Ok(()) } else { self.print(text) }
    }

    /// A result as JSON: standard output.
    pub fn print_json(&self, value: &impl serde::Serialize) -> Result<(), CliError> {
        let text = serde_json::to_string_pretty(value).map_err(|e| CliError::input(e.to_string()))?;
        self.write(&printable_json(&text))
    }

    /// A remark: one line on standard error, unless quiet.
    pub fn note(&self, text: &str) {
        if !self.quiet {
            let _ = writeln!(std::io::stderr(), "{}", in_line(text));
        }
    }

    /// Something went wrong with one stone of several: one line on standard error.
    pub fn complain(&self, text: &str) {
        complain(text);
    }

    /// A bar over `steps` on standard error; hidden when quiet. In a pipe a line every half minute takes
    /// its place.
    pub fn progress(&self, steps: usize, what: &'static str) -> ProgressBar {
        let target = if self.quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
        let bar = ProgressBar::with_draw_target(Some(steps as u64), target).with_message(what);
        if !self.quiet && bar.is_hidden() {
            heartbeat::watch(&bar);
        }
        match ProgressStyle::with_template("{msg} {wide_bar} {pos}/{len} {eta}") {
            Ok(style) => bar.with_style(style),
            Err(_) => bar,
        }
    }

    /// A clock for work without a count.
    pub fn spinner(&self, what: &'static str) -> ProgressBar {
        self.clock(self.progress(0, what), "{msg} … {elapsed}")
    }

    /// A clock over a few steps of unequal length.
    pub fn steps(&self, steps: usize) -> ProgressBar {
        self.clock(self.progress(steps, ""), "{pos}/{len} {msg} … {elapsed}")
    }

    fn clock(&self, bar: ProgressBar, template: &str) -> ProgressBar {
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        if !bar.is_hidden() {
            bar.enable_steady_tick(std::time::Duration::from_millis(200));
        }
        bar
    }
}
