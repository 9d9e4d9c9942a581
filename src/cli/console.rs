//! What a command says and where: results on standard output, notes and progress on standard
//! error.

use super::outcome::{Failure, complain, printable};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::Write;

/// The options that every command has.
#[derive(Debug, Clone, Copy, clap::Args)]
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
}

impl Console {
    /// A result: standard output.
    pub fn print(&self, text: &str) -> Result<(), Failure> {
        let mut out = std::io::stdout().lock();
        let newline = if text.ends_with('\n') { "" } else { "\n" };
        write!(out, "{text}{newline}").and_then(|()| out.flush()).map_err(|e| Failure::output(&e))
    }

    /// A result as JSON: standard output.
    pub fn print_json(&self, value: &impl serde::Serialize) -> Result<(), Failure> {
        let text = serde_json::to_string_pretty(value).map_err(|e| Failure::input(e.to_string()))?;
        self.print(&text)
    }

    /// A remark: standard error, unless quiet.
    pub fn note(&self, text: &str) {
        if !self.quiet {
            let _ = writeln!(std::io::stderr(), "{}", printable(text));
        }
    }

    /// Something went wrong with one stone of several: one line on standard error.
    pub fn complain(&self, text: &str) {
        complain(text);
    }

    /// A bar over `steps` on standard error; hidden in a pipe or when quiet.
    pub fn progress(&self, steps: usize, what: &'static str) -> ProgressBar {
        let target = if self.quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
        let bar = ProgressBar::with_draw_target(Some(steps as u64), target).with_message(what);
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
