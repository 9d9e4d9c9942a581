//! Course of a command that writes a table: to a stream, or to a file with its sidecar, and with plots.

mod place;
mod stream;
mod teller;

use super::args::stone;
use super::args::tables::TableArgs;
use super::console::Console;
use super::error::CliError;
use super::exit_code::ExitStatus;
use super::interrupt;
use super::outputs::Outputs;
use super::plot_output::Plots;
use super::table_files;
use crate::batch::merge::TablePart;
use crate::batch::table_job::TableJob;
use crate::storage::atomic_write;
pub use place::TableCommand;
use teller::Teller;

impl TableCommand<'_> {
    /// Makes the table and writes it, with its plots.
    ///
    /// - `outputs`: of the command
    ///
    /// A table that is there already, whole and of just this job, is not made again.
    pub fn run(
        &self,
        table: &TableArgs,
        plots: &Plots,
        outputs: &mut Outputs,
        console: &Console,
    ) -> Result<ExitStatus, CliError> {
        let (output, form) = (&table.output, table.format(console)?);
        plots.claim(&self.record(), outputs)?;
        let teller = Teller::new(console, self.what, output);
        let job = TableJob {
            identity: self.rows.identity(),
            total: self.rows.total(),
            shard: table.shard,
            form,
            columns: self.rows.columns(),
            order: self.rows.order(),
            line: &|i| self.rows.row(i, form),
            tell: &|event| teller.tell(event),
        };
        let say_notes = || self.notes.iter().for_each(|note| console.note(note));
        if atomic_write::is_stream(output) {
            say_notes();
            let asked = (&self.request.scores().metrics[..], !plots.is_empty());
            let (summary, bytes) = stream::write(&job, output, asked, console, || teller.finish())?;
            let drawn = self.draw(plots, || Ok(bytes), form)?;
            drawn.iter().for_each(|file| console.note(&format!("wrote {}", stone::display_name(file))));
            return Ok(table_files::code(&summary));
        }
        let begun = job.is_begun(output);
        self.claim(table, begun, outputs)?;
        say_notes();
        match self.already(table, begun, console) {
            Some(part) => self.reused(&part, plots, console),
            None => self.to_file(&job, table, plots, (console, &teller)),
        }
    }

    /// Makes the rows that are not there yet, and writes plots, sidecar and table.
    fn to_file(
        &self,
        job: &TableJob,
        table: &TableArgs,
        plots: &Plots,
        (console, teller): (&Console, &Teller),
    ) -> Result<ExitStatus, CliError> {
        let output = &table.output;
        interrupt::mark_resumable();
        let progress = job.begin(output)?;
        if teller.has_waited() {
            // the other process may have put a table there, its own or this one
            let claimed = self.claim(table, false, &mut Outputs::new(console));
            let part = self.already(table, false, console);
            if claimed.is_err() || part.is_some() {
                progress.finish()?;
                claimed?;
                return part.map_or(Ok(ExitStatus::Done), |part| self.reused(&part, plots, console));
            }
        }
        let mut finished = job.finish(progress, output)?;
        teller.finish();
        let mut written = self.draw(plots, || Ok(finished.bytes()?), job.form)?;
        let summary = finished.summary.clone();
        self.meta(table, &summary, finished.crc32).write_for(output)?;
        finished.publish(output)?; // last: where the table is, all is
        written.insert(0, output.clone());
        table_files::tell_written(&written, &summary, "", console)?;
        Ok(table_files::code(&summary))
    }

    /// What is still to be done for a table that is there already.
    fn reused(&self, part: &TablePart, plots: &Plots, console: &Console) -> Result<ExitStatus, CliError> {
        let mut files = self.draw(plots, || Ok(part.bytes()?), part.form)?;
        let table = stone::display_name(&part.table);
        console.note(&format!("{table} is there already: its rows are used again"));
        files.insert(0, part.table.clone());
        table_files::tell_written(&files, &part.meta.summary, "", console)?;
        Ok(table_files::code(&part.meta.summary))
    }
}
