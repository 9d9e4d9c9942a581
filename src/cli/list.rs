//! `cutlab list`: what there is to choose from, straight from the catalogues.

use super::console::Console;
use super::outcome::{Code, Failure};
use crate::cut::library;
use crate::formats::FORMATS;
use crate::metrics::{METRICS, Metric, Reading};
use crate::optics::dispersion::lines;
use crate::optics::illuminants::ILLUMINANTS;
use crate::optics::materials::MATERIALS;
use crate::optics::{Illuminant, Material, colour};
use crate::scene::lights::LIGHTS;
use crate::scene::{SCENES, preset};
use crate::store::limits;
use serde::Serialize;

#[derive(Debug, clap::Args)]
pub struct Args {
    /// Which catalogue
    kind: Kind,
    /// Print one cut's design file, in the form it is written in: `cutlab list cuts classic`
    #[arg(value_name = "NAME")]
    name: Option<String>,
}

#[derive(Debug, Clone, Copy, clap::ValueEnum)]
enum Kind {
    /// Cuts of the library
    Cuts,
    /// Materials
    Materials,
    /// Lights by which colours are judged
    Illuminants,
    /// Scores
    Metrics,
    /// File formats
    Formats,
    /// Scenes for pictures
    Scenes,
    /// Kinds of light for scene files
    Lights,
    /// How much a file may hold, CUTLAB_LIMIT in the environment counted in
    Limits,
}

#[derive(Serialize)]
struct Entry {
    name: String,
    about: String,
}

/// Lists a catalogue.
pub fn run(args: &Args, console: &Console) -> Result<Code, Failure> {
    if let Some(name) = &args.name {
        return one(args.kind, name, console);
    }
    let entries = match args.kind {
        Kind::Cuts => cuts(),
        Kind::Materials => entries(MATERIALS.iter().map(|m| (m.name.to_string(), material(m)))),
        Kind::Illuminants => {
            entries(ILLUMINANTS.iter().map(|i| (i.name.to_string(), format!("{} [{}]", i.about, i.source))))
        }
        Kind::Metrics => entries(METRICS.iter().map(|m| {
            let unit = if m.unit.is_empty() { String::new() } else { format!(" [{}]", m.unit) };
            let beams = if m.by_beams { " By beams with --exact." } else { "" };
            let dented = if m.dented { " Of stones with dents too." } else { "" };
            (m.name.to_string(), format!("{}{beams}{dented} Source: {}.{unit}", m.definition, m.source))
        })),
        Kind::Formats => entries(FORMATS.iter().map(|f| {
            let how = if f.write.is_some() { "read, written" } else { "read" };
            (f.name.to_string(), format!("{} ({how}; .{})", f.about, f.extensions.join(", .")))
        })),
        Kind::Scenes => entries(SCENES.iter().map(|(name, _)| {
            let about = preset(name).and_then(Result::ok).map_or_else(String::new, |s| s.about().into());
            (name.to_string(), about)
        })),
        Kind::Limits => entries(limits::ALL.iter().map(|l| (l.most().to_string(), l.of.to_string()))),
        Kind::Lights => entries(LIGHTS.iter().map(|k| (k.name.to_string(), k.about.to_string()))),
    };
    if console.json {
        console.print_json(&entries)?;
    } else if matches!(args.kind, Kind::Metrics) {
        let blocks: Vec<String> = METRICS.iter().map(|m| block(m)).collect();
        console.print(blocks.join("\n").trim_end())?;
    } else {
        let width = entries.iter().map(|e| e.name.len()).max().unwrap_or(0);
        let lines: Vec<String> = entries.iter().map(|e| format!("{:width$}  {}", e.name, e.about)).collect();
        console.print(&lines.join("\n"))?;
    }
    Ok(Code::Done)
}

/// Prints the design file of one cut.
fn one(kind: Kind, name: &str, console: &Console) -> Result<Code, Failure> {
    if !matches!(kind, Kind::Cuts) {
        return Err(Failure::input(format!(
            "'{name}': only cuts can be printed one by one, as `cutlab list cuts classic`"
        )));
    }
    let text = library::source(name).ok_or_else(|| {
        let near = library::nearest(name);
        Failure::input(format!("no cut is called '{name}', the nearest is '{near}' (all: cutlab list cuts)"))
    })?;
    match (console.json, library::document(name)) {
        (true, Some(Ok(document))) => console.print_json(&document)?,
        _ => console.print(text)?,
    }
    Ok(Code::Done)
}

/// A score for people: what it tells, its definition, and what belongs to it line by line.
fn block(m: &Metric) -> String {
    let unit = if m.unit.is_empty() { "a fraction" } else { m.unit };
    let observer = m.observer.map_or("none".into(), |a| format!("{a}° half-angle, or --observer"));
    let error = match (m.reading, m.by_beams) {
        (Reading::Solid(_), _) => "none: a closed form",
        (_, true) => "of 64 batches of random rays; beams with --exact",
        (_, false) => "of 64 batches of random rays",
    };
    let mut out = format!("{}: {}\n", m.name, m.about);
    let lines = [
        ("definition", m.definition.to_string()),
        ("observer", observer),
        ("unit", format!("{unit}, {} to {}", m.range.0, m.range.1)),
        ("experiment", m.reading.experiment().into()),
        ("error", error.into()),
        ("source", m.source.into()),
    ];
    for (label, text) in lines {
        for (i, line) in wrapped(&text, 84).iter().enumerate() {
            out += &format!("    {:<11} {line}\n", if i == 0 { label } else { "" });
        }
    }
    out
}

/// Words in lines of up to `width` characters.
fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => {
                *line += " ";
                *line += word;
            }
            _ => lines.push(word.into()),
        }
    }
    lines
}

/// Indices, range, density, colour and sources of a material.
fn material(m: &Material) -> String {
    /// Depth at which a material shows its colour, mm: what light goes through in a small stone.
    const DEPTH_MM: f64 = 10.0;
    let mut text = format!("{}: n_D {:.4}", m.about, m.index_d());
    if let Some(law) = m.extraordinary {
        text += &format!(", n_e {:.4}", law.index(lines::D));
    }
    text += &format!(", B–G {:.4}", m.index(lines::G) - m.index(lines::B));
    text += &format!(", {:.0}–{:.0} nm", 1000.0 * m.valid_um.0, 1000.0 * m.valid_um.1);
    if let Some(sg) = m.specific_gravity {
        text += &format!(", {sg} g/cm³");
    }
    if let Some(absorption) = m.absorption {
        let left = |nm: f32| (-DEPTH_MM * absorption.per_mm(f64::from(nm) / 1000.0)).exp() as f32;
        let byte = |x| (255.0 * colour::srgb_encode(x)).round() as u8;
        let [r, g, b] = Illuminant::daylight().linear_srgb(left).to_array().map(byte);
        text += &format!(", #{r:02x}{g:02x}{b:02x} through {DEPTH_MM} mm by daylight");
        text += &format!(" ({}; {})", absorption.about, absorption.source);
    }
    text + &format!(" [{}]", m.source)
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
