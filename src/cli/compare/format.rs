//! What `compare -o` writes, and where.

use super::text::ComparisonText;
use crate::batch::comparison::StoneComparison;
use crate::batch::request::TableRequest;
use crate::batch::table::TableFormat;
use crate::cli::args::{stone, tables};
use crate::cli::console::Console;
use crate::cli::error::CliError;
use crate::cli::outputs::Outputs;
use crate::cli::table_files;
use crate::render::{Record, record};
use crate::report::{ReportInput, USUAL_WIDTH, comparison_page};
use crate::stone::StoneError;
use crate::storage::atomic_write;
use std::path::{Path, PathBuf};

/// What `-o` asks for, by its extension.
pub enum ComparisonFormat {
    /// A page in a folder, with pictures so many pixels across.
    Page(PathBuf, u32),
    /// The table for people.
    Markdown(PathBuf),
    /// The table with a row for each metric and stone.
    Table(PathBuf, TableFormat),
}

impl ComparisonFormat {
    /// Of what was asked for; none if nothing is to be written.
    ///
    /// - `width`: pixels across the pictures of a page
    pub fn new(
        path: Option<&Path>,
        width: Option<u32>,
        console: &Console,
    ) -> Result<Option<ComparisonFormat>, CliError> {
        let format = path.map(|path| ComparisonFormat::from_path(path, console)).transpose()?;
        match (format, width) {
            (Some(ComparisonFormat::Page(path, _)), Some(width)) => {
                Ok(Some(ComparisonFormat::Page(path, width)))
            }
            (_, Some(_)) => {
                Err(CliError::input("--width is of the pictures of a page: -o FOLDER writes one"))
            }
            (format, None) => Ok(format),
        }
    }

    fn from_path(path: &Path, console: &Console) -> Result<ComparisonFormat, CliError> {
        let path = path.to_owned();
        let is_markdown = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("md"));
        if atomic_write::is_stream(&path) && !is_markdown {
            let form = tables::format_of(&path, console)?;
            return Ok(ComparisonFormat::Table(path, form));
        }
        let extension = path.extension().filter(|_| !path.is_dir());
        Ok(match extension {
            Some(_) if is_markdown => ComparisonFormat::Markdown(path),
            Some(_) => {
                let form = TableFormat::from_path(&path).map_err(|_| {
                    let path = stone::display_name(&path);
                    CliError::input(format!("{path}: a comparison is .csv, .jsonl, .json, .md or a folder"))
                })?;
                ComparisonFormat::Table(path, form)
            }
            None => ComparisonFormat::Page(path.join("index.html"), USUAL_WIDTH),
        })
    }

    /// The file.
    pub fn path(&self) -> &Path {
        match self {
            ComparisonFormat::Page(path, _)
            | ComparisonFormat::Markdown(path)
            | ComparisonFormat::Table(path, _) => path,
        }
    }

    /// Takes the place of the file.
    ///
    /// - `request`: what the table is of; `record`: of it, which pages have
    pub fn claim(
        &self,
        request: &TableRequest,
        record: &Record,
        outputs: &mut Outputs,
    ) -> Result<(), CliError> {
        match self {
            ComparisonFormat::Page(path, _) | ComparisonFormat::Markdown(path) => {
                outputs.claim(path, |there| record.matches(there))
            }
            ComparisonFormat::Table(path, _) => {
                table_files::claim(path, &|meta| meta.is_of(request), None, false, outputs)
            }
        }
    }

    /// Writes the file.
    pub fn write(
        &self,
        compared: &StoneComparison,
        record: &Record,
        console: &Console,
    ) -> Result<(), CliError> {
        let path = self.path();
        match self {
            ComparisonFormat::Page(_, width) => {
                let page = page(compared, *width, console)?;
                atomic_write::write(path, record.in_markup(page).as_bytes())?;
            }
            ComparisonFormat::Markdown(_) => {
                let text = ComparisonText(compared).markdown();
                atomic_write::write(path, record.in_markup(text).as_bytes())?;
            }
            ComparisonFormat::Table(_, form) => {
                let notes = ComparisonText(compared).weight_notes();
                notes.iter().for_each(|said| console.note(&format!("note: {said}")));
                compared.write(path, *form)?;
            }
        }
        if !atomic_write::is_stdout(path) {
            console.note(&format!("wrote {}", stone::display_name(path)));
        }
        Ok(())
    }
}

/// The page with the stones beside each other.
///
/// - `width`: pixels across the pictures on the table
fn page(compared: &StoneComparison, width: u32, console: &Console) -> Result<String, CliError> {
    let scores = compared.scores();
    let input = |stone| {
        let plain = ReportInput::new(stone, record::command_line())?;
        Ok(ReportInput { polarised: scores.polarised, seed: scores.seed, width, ..plain })
    };
    let inputs: Vec<ReportInput> = compared.stones.iter().map(input).collect::<Result<_, StoneError>>()?;
    let bar = console.steps(comparison_page::STEPS * inputs.len());
    let page = comparison_page::html(&inputs, &compared.comparison, scores, &|what| {
        bar.set_message(what);
        bar.inc(1);
    });
    bar.finish_and_clear();
    Ok(page?)
}
