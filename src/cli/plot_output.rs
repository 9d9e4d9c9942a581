//! Plots of a table's scores: options about them, and where each is written.

mod look;

use super::args::stone;
use super::console::Console;
use super::error::CliError;
use super::outputs::Outputs;
use crate::batch::sidecar::{TableLayout, TableMeta};
use crate::batch::table::{NumericColumns, TableFormat};
use crate::cli::limits::limits;
use crate::metrics::Metric;
use crate::render::Record;
use crate::report::plot::Style;
use crate::report::table_plots::TablePlots;
use std::path::{Path, PathBuf};

pub use look::Look;

/// Plots to be drawn.
#[derive(Debug, Clone)]
pub struct Plots(TablePlots);

impl Plots {
    /// The plots asked for.
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
        // a wrong file is told before a wrong range
        let plain = TablePlots::new(paths, metrics, Style::default(), look.width())?;
        Ok(Plots(plain.with_style(look.style(metrics, axes)?)))
    }

    /// Whether there is none to be drawn.
    pub fn is_empty(&self) -> bool {
        self.0.files().next().is_none()
    }

    /// Takes the places of all files.
    ///
    /// - `record`: of what makes the table
    pub fn claim(&self, record: &Record, outputs: &mut Outputs) -> Result<(), CliError> {
        self.0.files().try_for_each(|file| outputs.claim(file, |there| record.matches(there)))
    }

    /// Draws the plots of a table; their files.
    ///
    /// - `record`: of what made the table, which each has
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
        self.0.draw(&NumericColumns::read(bytes, form, limits())?, layout, record)?;
        Ok(self.0.files().map(Path::to_owned).collect())
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

/// Says which files were drawn.
pub fn tell(files: &[PathBuf], console: &Console) -> Result<(), CliError> {
    if console.json {
        return console.print_json(&files.iter().map(stone::display_name).collect::<Vec<_>>());
    }
    files.iter().for_each(|file| console.note(&format!("wrote {}", stone::display_name(file))));
    Ok(())
}
