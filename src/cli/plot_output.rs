//! Plots of a table's scores: where each is written, and what stands along its axes.

mod look;

use super::args::stone;
use super::console::Console;
use super::exit_code::CliError;
use super::outputs::Outputs;
use crate::batch::sidecar::{TableLayout, TableMeta};
use crate::batch::table::{NumericColumns, TableFormat};
use crate::cli::limits::limits;
use crate::metrics::Metric;
use crate::render::Record;
use crate::report::plot::{Axis, ScorePlot, Style};
use crate::report::{pdf, raster};
use crate::stone::grammar;
use crate::storage::atomic_write;
use std::path::{Path, PathBuf};

pub use look::Look;

/// Plots to be drawn: each file with its score.
#[derive(Debug, Clone)]
pub struct Plots {
    files: Vec<(PathBuf, &'static Metric)>,
    style: Style,
    /// Pixels across those that are pictures.
    width: u32,
}

impl Plots {
    /// The files of the plots asked for. One that is called as a metric shows that metric; of any
    /// other name there is one for each, NAME-METRIC.svg.
    ///
    /// - `axes`: columns along the axes
    pub fn new(
        paths: &[PathBuf],
        metrics: &[&'static Metric],
        look: &Look,
        axes: &[String],
    ) -> Result<Plots, CliError> {
        if let (true, Some(option)) = (paths.is_empty(), look.given()) {
            return Err(CliError::input(format!("{option} is about plots: --plot FILE draws one")));
        }
        let mut files = Vec::new();
        for path in paths {
            let Some(extension) = ending_of(path) else {
                return Err(CliError::input(format!(
                    "{}: plots are .svg, .pdf or .png",
                    stone::display_name(path)
                )));
            };
            let stem = stone::display_name(path.file_stem().unwrap_or_default());
            let own = metrics.iter().find(|m| m.name == stem);
            match (own, metrics) {
                (Some(metric), _) | (None, [metric]) => files.push((path.clone(), *metric)),
                _ if atomic_write::is_stream(path) => {
                    return Err(CliError::input(format!(
                        "{} takes one plot, and there are {} scores: name a file",
                        stone::display_name(path),
                        metrics.len()
                    )));
                }
                _ => files.extend(metrics.iter().map(|metric| {
                    let name = format!("{stem}-{}.{extension}", metric.name);
                    (path.with_file_name(name), *metric)
                })),
            }
        }
        Ok(Plots { files, style: look.style(metrics, axes)?, width: look.width() })
    }

    /// Whether there is none to be drawn.
    pub fn is_empty(&self) -> bool {
        self.files.is_empty()
    }

    /// Takes the places of all files.
    ///
    /// - `record`: of what makes the table
    pub fn claim(&self, record: &Record, outputs: &mut Outputs) -> Result<(), CliError> {
        self.files.iter().try_for_each(|(file, _)| outputs.claim(file, |there| record.matches(there)))
    }

    /// Draws the plots of a table; their files.
    ///
    /// - `record`: that each has
    pub fn draw(
        &self,
        bytes: &[u8],
        form: TableFormat,
        layout: &TableLayout,
        record: &Record,
    ) -> Result<Vec<PathBuf>, CliError> {
        if self.is_empty() {
            return Ok(Vec::new());
        }
        let table = NumericColumns::read(bytes, form, limits())?;
        let family = grammar::family(&layout.stone);
        let axes: Vec<Axis> = layout.axes.iter().map(|key| Axis::new(key, family)).collect();
        for (path, metric) in &self.files {
            let (stone, is_diamond, style) = (&layout.stone, layout.is_diamond, &self.style);
            let drawing = ScorePlot { metric, axes: &axes, stone, family, is_diamond, style, own: None };
            let svg = drawing.svg(&table, layout.scattered, &layout.curves);
            let bytes = match ending_of(path) {
                Some("svg") => record.in_markup(svg).into_bytes(),
                Some("pdf") => {
                    let page = pdf::pdf(&svg).map_err(|e| CliError::input(e.to_string()))?;
                    record.in_pdf(page)
                }
                _ => {
                    let png = raster::png_of(&svg, self.width, Some(record));
                    png.map_err(|e| CliError::input(e.to_string()))?
                }
            };
            atomic_write::write(path, &bytes)?;
        }
        Ok(self.files.iter().map(|(path, _)| path.clone()).collect())
    }
}

/// What a table's sidecar says of its axes.
pub fn layout_of(table: &Path, meta: &TableMeta) -> Result<TableLayout, CliError> {
    let why = || {
        let table = stone::display_name(table);
        match meta.build.is_empty() {
            true => format!("{table} is of an older cutlab, which did not note its axes: make it anew"),
            false => {
                format!(
                    "{table} has nothing to draw its scores against: it is neither of a sweep nor of --tilt"
                )
            }
        }
    };
    meta.layout.clone().filter(|l| (1..=2).contains(&l.axes.len())).ok_or_else(|| CliError::input(why()))
}

/// The metrics of a table.
pub fn metrics_of(meta: &TableMeta) -> Vec<&'static Metric> {
    meta.metrics.iter().filter_map(|m| Metric::by_name(&m.name)).collect()
}

/// `svg`, `pdf` or `png`, by the file's extension.
fn ending_of(path: &Path) -> Option<&'static str> {
    let extension = path.extension()?.to_string_lossy().to_lowercase();
    ["svg", "pdf", "png"].into_iter().find(|e| *e == extension)
}

/// Says which files were drawn.
pub fn tell(files: &[PathBuf], console: &Console) -> Result<(), CliError> {
    if console.json {
        return console.print_json(&files.iter().map(stone::display_name).collect::<Vec<_>>());
    }
    files.iter().for_each(|file| console.note(&format!("wrote {}", stone::display_name(file))));
    Ok(())
}
