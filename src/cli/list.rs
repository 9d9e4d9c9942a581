//! `cutlab list`: what there is to choose from, straight from the catalogues.

use super::console::Console;
use super::outcome::{Code, Failure};
use crate::cut::library;
use crate::formats::FORMATS;
use crate::metrics::METRICS;
use crate::optics::materials::MATERIALS;
use crate::scene::SCENES;
use serde::Serialize;

#[derive(Debug, clap::Args)]
pub struct Args {
    /// Which catalogue
    kind: Kind,
}

#[derive(Debug, Clone, Copy, clap::ValueEnum)]
enum Kind {
    /// Cuts of the library
    Cuts,
    /// Materials
    Materials,
    /// Scores
    Metrics,
    /// File formats
    Formats,
    /// Scenes for pictures
    Scenes,
}

#[derive(Serialize)]
struct Entry {
    name: String,
    about: String,
}

/// Lists a catalogue.
pub fn run(args: &Args, console: &Console) -> Result<Code, Failure> {
    let entries = match args.kind {
        Kind::Cuts => cuts(),
        Kind::Materials => entries(MATERIALS.iter().map(|m| {
            let weight = m.specific_gravity.map_or(String::new(), |sg| format!(", density {sg} g/cm³"));
            (m.name.to_string(), format!("{}, n_D {:.4}{weight}", m.about, m.index_d()))
        })),
        Kind::Metrics => entries(METRICS.iter().map(|m| {
            let unit = if m.unit.is_empty() { String::new() } else { format!(" [{}]", m.unit) };
            let beams = if m.by_beams { " By beams with --exact." } else { "" };
            (m.name.to_string(), format!("{}{beams} Source: {}.{unit}", m.definition, m.source))
        })),
        Kind::Formats => entries(FORMATS.iter().map(|f| {
            let how = if f.write.is_some() { "read, written" } else { "read" };
            (f.name.to_string(), format!("{} ({how}; .{})", f.about, f.extensions.join(", .")))
        })),
        Kind::Scenes => entries(SCENES.iter().map(|s| (s.name.to_string(), s.about.to_string()))),
    };
    if console.json {
        console.print_json(&entries)?;
    } else {
        let width = entries.iter().map(|e| e.name.len()).max().unwrap_or(0);
        let lines: Vec<String> = entries.iter().map(|e| format!("{:width$}  {}", e.name, e.about)).collect();
        console.print(&lines.join("\n"))?;
    }
    Ok(Code::Done)
}

fn entries(pairs: impl Iterator<Item = (String, String)>) -> Vec<Entry> {
    pairs.map(|(name, about)| Entry { name, about }).collect()
}

fn cuts() -> Vec<Entry> {
    entries(library::names().map(|name| {
        let about = match library::document(name) {
            Some(Ok(document)) => document.about,
            Some(Err(error)) => error.to_string(), // a test keeps this from happening
            None => String::new(),
        };
        (name.to_string(), about)
    }))
}
