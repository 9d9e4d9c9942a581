//! Plots of a table's scores: which metric each file shows, and the files written.

use super::drawing_format::DrawingFormat;
use super::plot::{Axis, ScorePlot, Style};
use super::stone_report::ReportError;
use crate::batch::sidecar::TableLayout;
use crate::batch::table::NumericColumns;
use crate::metrics::Metric;
use crate::render::Record;
use crate::stone::grammar;
use crate::storage::atomic_write;
use crate::storage::text::display_name;
use std::path::{Path, PathBuf};

/// Plots to be drawn: each file with its score.
#[derive(Debug, Clone)]
pub struct TablePlots {
    files: Vec<(PathBuf, &'static Metric)>,
    style: Style,
    /// Pixels across those that are pictures.
    width: u32,
}

impl TablePlots {
    /// The plots of files that were asked for. A file that is called as a metric shows that metric; of any other name
    /// there is one for each metric, NAME-METRIC.svg.
    ///
    /// - `metrics`: of the table
    /// - `width`: pixels across those that are pictures
    pub fn new(
        paths: &[PathBuf],
        metrics: &[&'static Metric],
        style: Style,
        width: u32,
    ) -> Result<TablePlots, ReportError> {
        let mut files = Vec::new();
        for path in paths {
            let Some(format) = DrawingFormat::from_path(path) else {
                return Err(ReportError::NoPlot(display_name(path)));
            };
            let stem = display_name(path.file_stem().unwrap_or_default());
            let own = metrics.iter().find(|m| m.name == stem);
            match (own, metrics) {
                (Some(metric), _) | (None, [metric]) => files.push((path.clone(), *metric)),
                _ if atomic_write::is_stream(path) => {
                    return Err(ReportError::OnePlot { path: display_name(path), scores: metrics.len() });
                }
                _ => files.extend(metrics.iter().map(|metric| {
                    let name = format!("{stem}-{}.{}", metric.name, format.extension());
                    (path.with_file_name(name), *metric)
                })),
            }
        }
        Ok(TablePlots { files, style, width })
    }

    /// The same in another style.
    pub fn with_style(self, style: Style) -> TablePlots {
        TablePlots { style, ..self }
    }

    /// The files.
    pub fn files(&self) -> impl Iterator<Item = &Path> {
        self.files.iter().map(|(path, _)| path.as_path())
    }

    /// Draws the plots of a table and writes the files.
    ///
    /// - `layout`: what stands along the axes
    /// - `record`: of what made the table, which each has
    pub fn draw(
        &self,
        table: &NumericColumns,
        layout: &TableLayout,
        record: &Record,
    ) -> Result<(), ReportError> {
        let family = grammar::family(&layout.stone);
        let axes: Vec<Axis> = layout.axes.iter().map(|key| Axis::new(key, family)).collect();
        for (path, metric) in &self.files {
            let (stone, is_diamond, style) = (&layout.stone, layout.is_diamond, &self.style);
            let drawing = ScorePlot { metric, axes: &axes, stone, family, is_diamond, style, own: None };
            let svg = drawing.svg(table, layout.scattered, &layout.curves);
            let format = DrawingFormat::from_path(path).unwrap_or(DrawingFormat::Png);
            atomic_write::write(path, &format.bytes(svg, self.width, Some(record))?)?;
        }
        Ok(())
    }
}
