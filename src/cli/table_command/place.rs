//! A table to be made, and what stands in its place: the same table, another, its plots.

use crate::batch::merge::TablePart;
use crate::batch::request::TableRequest;
use crate::batch::shard::Shard;
use crate::batch::sidecar::TableMeta;
use crate::batch::table::TableFormat;
use crate::batch::table_job::TableSummary;
use crate::batch::table_rows::TableRows;
use crate::cli::args::tables::TableArgs;
use crate::cli::console::Console;
use crate::cli::error::CliError;
use crate::cli::limits::limits;
use crate::cli::outputs::Outputs;
use crate::cli::plot_output::Plots;
use crate::cli::table_files;
use crate::render::Record;
use std::path::PathBuf;

/// A table to be made.
pub struct TableCommand<'a> {
    /// What was asked for.
    pub request: &'a TableRequest,
    /// Its rows.
    pub rows: &'a dyn TableRows,
    /// What to say before the work.
    pub notes: Vec<String>,
    /// Word for the progress bar.
    pub what: &'static str,
}

impl TableCommand<'_> {
    /// What plots of the table say of where they come from.
    pub fn record(&self) -> Record {
        Record::of_request(self.request.command(), self.request)
    }

    /// Draws the plots, if there are any; their files.
    ///
    /// - `bytes`: of the whole table
    pub fn draw(
        &self,
        plots: &Plots,
        bytes: impl FnOnce() -> Result<Vec<u8>, CliError>,
        form: TableFormat,
    ) -> Result<Vec<PathBuf>, CliError> {
        match self.rows.layout() {
            Some(layout) if !plots.is_empty() => plots.draw(&bytes()?, form, &layout, &self.record()),
            _ => Ok(Vec::new()),
        }
    }

    /// The table that is there already, if it is whole and of just this job.
    pub fn already(&self, table: &TableArgs, begun: bool, console: &Console) -> Option<TablePart> {
        let part = TablePart::open(&table.output, limits()).ok().filter(|_| !begun && !console.force)?;
        let is_same = part.meta.study == self.rows.identity() && part.meta.shard == shard_of(table);
        is_same.then_some(part)
    }

    /// Takes the places of the table and its sidecar.
    ///
    /// - `begun`: whether an earlier start of the same command left its progress there
    pub fn claim(&self, table: &TableArgs, begun: bool, outputs: &mut Outputs) -> Result<(), CliError> {
        table_files::claim(&table.output, &|meta| meta.is_of(self.request), shard_of(table), begun, outputs)
    }

    /// The sidecar of the table.
    pub fn meta(&self, table: &TableArgs, summary: &TableSummary, crc32: u32) -> TableMeta {
        TableMeta {
            layout: self.rows.layout(),
            total: self.rows.total(),
            shard: shard_of(table),
            summary: summary.clone(),
            crc32: format!("{crc32:08x}"),
            ..TableMeta::new(self.request, self.rows.identity().into(), self.rows.columns().to_vec())
        }
    }
}

/// The part of the table that is made; none for the whole.
fn shard_of(table: &TableArgs) -> Option<Shard> {
    (table.shard != Shard::WHOLE).then_some(table.shard)
}
