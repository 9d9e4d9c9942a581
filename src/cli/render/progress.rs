//! Progress of pictures and frames, as it is shown.

use crate::cli::console::Console;
use indicatif::ProgressBar;

/// Where the work on a picture tells how far it is.
pub enum PictureProgress<'a> {
    /// On signs of its own.
    Single(&'a Console),
    /// On the bar of an animation, which counts rows of all its frames.
    Frame { console: &'a Console, bar: &'a ProgressBar, frame: u32, frames: u32 },
}

/// A sign of a step of the work, which ends with the step.
pub struct ProgressSign {
    bar: ProgressBar,
    prefix: String,
    own: bool,
}

impl ProgressSign {
    /// Says what is done now.
    pub fn say(&self, what: &str) {
        self.bar.set_message(format!("{}{what}", self.prefix));
    }

    /// Counts a row.
    pub fn row(&self) {
        self.bar.inc(1);
    }
}

impl Drop for ProgressSign {
    fn drop(&mut self) {
        if self.own {
            self.bar.finish_and_clear();
        }
    }
}

impl PictureProgress<'_> {
    pub fn console(&self) -> &Console {
        match self {
            PictureProgress::Single(console) | PictureProgress::Frame { console, .. } => console,
        }
    }

    /// Begins a step.
    ///
    /// - `steps`: rows of the picture, 0 for a step without a count
    pub fn begin(&self, what: &'static str, steps: usize) -> ProgressSign {
        match self {
            PictureProgress::Single(console) => {
                let bar = if steps == 0 { console.spinner(what) } else { console.progress(steps, what) };
                ProgressSign { bar, prefix: String::new(), own: true }
            }
            PictureProgress::Frame { bar, frame, frames, .. } => {
                let prefix = format!("frame {} of {frames}: ", frame + 1);
                let sign = ProgressSign { bar: (*bar).clone(), prefix, own: false };
                sign.say(what);
                sign
            }
        }
    }
}
