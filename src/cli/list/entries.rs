//! The entries of each catalogue.

use super::CatalogueEntry;
use crate::cli::{terminal_table, wrap};
use crate::color::Illuminant;
use crate::color::illuminants::ILLUMINANTS;
use crate::design::design_file::DesignFile;
use crate::design::{families, library};
use crate::formats::{FORMATS, Format};
use crate::limits::{self as limit, Limit};
use crate::metrics::{METRICS, Metric, MetricSource, Statistic};
use crate::scene::lights::{LIGHTS, LightType as LightKind};
use crate::scene::{SCENES, preset};
use serde_json::{Value, json};
use std::sync::Arc;

/// Width of a block's text, without its label.
const WIDTH: usize = 84;

/// A name and lines with labels.
pub(super) fn block(head: &str, lines: &[(&str, String)]) -> String {
    let rows = lines.iter().filter(|(_, text)| !text.is_empty());
    let rows = rows.map(|(label, text)| (*label, wrap::lines(text, WIDTH).join("\n")));
    let least = lines.iter().map(|(label, _)| label.len()).max().unwrap_or(0);
    format!("{head}\n{}", terminal_table::labelled(rows, 4, u16::try_from(least).unwrap_or(0)))
}

/// Scores.
pub fn metrics() -> Vec<CatalogueEntry> {
    METRICS.iter().map(|m| metric(m)).collect()
}

fn metric(m: &Metric) -> CatalogueEntry {
    let unit = match m.unit {
        "" if m.scale == 1.0 && m.range.1 <= 1.0 => "a fraction",
        "" => "a ratio",
        unit => unit,
    };
    let observer = m.observer.map_or("none".into(), |a| format!("{a}° half-angle, or --observer"));
    let how = match m.read_from {
        MetricSource::Solid(_) => "none: a closed form",
        MetricSource::Sums(Statistic::Share(..)) => "by Wilson's interval, of 64 batches of random rays",
        MetricSource::Sums(Statistic::Median(_)) => {
            "of 64 batches of random rays: the longer side of a 95 % interval for the median, over 1.96"
        }
        _ => "of 64 batches of random rays",
    };
    let error = format!("{how}{}", if m.by_beams { "; beams with --exact" } else { "" });
    let shapes = if m.nonconvex { "convex or not" } else { "convex" };
    let text = block(
        &format!("{}: {}", m.name, m.about),
        &[
            ("definition", m.definition()),
            ("observer", observer),
            ("unit", format!("{unit}, {} to {}", m.range.0, m.range.1)),
            (
                "better",
                match m.better.word() {
                    "" => "neither more nor less by itself".into(),
                    word => word.into(),
                },
            ),
            ("experiment", m.estimator.name().into()),
            ("stones", shapes.into()),
            ("error", error),
            ("source", m.source.into()),
        ],
    );
    let facts = json!({
        "unit": m.unit,
        "range": [m.range.0, m.range.1],
        "better": (!m.better.word().is_empty()).then(|| m.better.word()),
        "observer_deg": m.observer,
        "experiment": m.estimator.name(),
        "by_beams": m.by_beams,
        "dented": m.nonconvex,
        "definition": m.definition(),
        "source": m.source,
    });
    CatalogueEntry { name: m.name.into(), about: m.about_and_better(), text, facts }
}

/// Cuts of the library.
pub fn cuts() -> Vec<CatalogueEntry> {
    library::names().map(cut).collect()
}

fn cut(name: &'static str) -> CatalogueEntry {
    let document = match library::document(name) {
        Some(Ok(document)) => document,
        // a test keeps both from happening
        Some(Err(error)) => DesignFile { about: error.to_string(), ..DesignFile::default() },
        None => DesignFile::default(),
    };
    let family = document.family.as_deref().and_then(|f| families::family(f).ok());
    let parameters = family.map_or(&[][..], |f| f.parameters).iter().map(|p| {
        let own = document.parameters.get(p.key).copied();
        json!({
            "key": p.key,
            "default": own.unwrap_or(p.default),
            "range": [p.range.0, p.range.1],
            "unit": p.unit.trim(),
            "about": p.about,
        })
    });
    let facts = json!({
        "source": document.source,
        "family": document.family,
        "parameters": parameters.collect::<Vec<_>>(),
    });
    let text = library::source(name).unwrap_or_default().into();
    CatalogueEntry { name: name.into(), about: document.about, text, facts }
}

/// Lights by which colours are judged.
pub fn illuminants() -> Vec<CatalogueEntry> {
    let entry = |i: &Arc<Illuminant>| CatalogueEntry {
        name: i.name.to_string(),
        about: i.about.to_string(),
        text: block(&format!("{}: {}", i.name, i.about), &[("source", i.source.to_string())]),
        facts: json!({ "source": i.source }),
    };
    ILLUMINANTS.iter().map(entry).collect()
}

/// File formats.
pub fn formats() -> Vec<CatalogueEntry> {
    let entry = |f: &&Format| {
        let how = if f.write.is_some() { "read, written" } else { "read" };
        let about = format!("{} ({how}; .{})", f.about, f.extensions.join(", ."));
        CatalogueEntry {
            name: f.name.into(),
            text: format!("{}: {about}", f.name),
            about,
            facts: json!({ "extensions": f.extensions, "written": f.write.is_some() }),
        }
    };
    FORMATS.iter().map(entry).collect()
}

/// Scenes for pictures.
pub fn scenes() -> Vec<CatalogueEntry> {
    let entry = |(name, text): &(&'static str, &'static str)| {
        let about = preset(name).and_then(Result::ok).map_or_else(String::new, |s| s.about().into());
        CatalogueEntry { name: (*name).into(), about, text: (*text).into(), facts: Value::Null }
    };
    SCENES.iter().map(entry).collect()
}

/// Kinds of light for scene files.
pub fn lights() -> Vec<CatalogueEntry> {
    let entry = |k: &&LightKind| CatalogueEntry {
        name: k.name.into(),
        about: k.about.into(),
        text: format!("{}: {}", k.name, k.about),
        facts: Value::Null,
    };
    LIGHTS.iter().map(entry).collect()
}

/// How much a file may hold.
pub fn limits() -> Vec<CatalogueEntry> {
    let limits = crate::cli::limits::limits();
    let entry = |l: &&Limit| {
        let (most, of) = (limits.max(l), l.of);
        CatalogueEntry {
            name: most.to_string(),
            about: of.into(),
            text: format!("{most} {of}"),
            facts: json!({ "most": most, "of": of }),
        }
    };
    limit::ALL.iter().map(entry).collect()
}
