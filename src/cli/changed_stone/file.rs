//! Where a changed stone is written, and as what.

use super::text::ChangedText;
use crate::cli::args::scoring::{self, ScoringHow};
use crate::cli::args::stone;
use crate::cli::console::Console;
use crate::cli::error::CliError;
use crate::cli::exit_code::ExitStatus;
use crate::cli::limits::limits;
use crate::cli::outputs::{self, Outputs};
use crate::design::Design;
use crate::materials::Material;
use crate::metrics::Metric;
use crate::report::edited_file;
use crate::report::target_format::TargetFormat;
use crate::stone::Stone;
use crate::storage::{atomic_write, output_path};
use serde::Serialize;
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

/// Where a changed stone goes.
#[derive(Debug, Clone, clap::Args)]
pub struct WrittenArgs {
    /// Where to write the changed stone; the extension chooses the format, - is standard output. In the format of
    /// its own file, that file is changed and keeps all else; .svg, .pdf and .png are the cutting diagram
    #[arg(long, short, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Format for `-o -`, or where the extension of a file says none: a name or extension from
    /// `cutlab list formats`, svg, pdf or png [the stone's own, or toml]
    #[arg(long, value_name = "FORMAT", requires = "output")]
    pub to: Option<String>,
}

/// What the commands that change a stone have in common: where it goes, and what is scored.
#[derive(Debug, Clone, clap::Args)]
pub struct ChangeArgs {
    #[command(flatten)]
    pub written: WrittenArgs,
    /// Scores before and after, and their differences (see `cutlab list metrics`) [none; of a design for another
    /// stone windowing,iso,wlr,leakage]
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', value_parser = scoring::metric)]
    pub score: Vec<&'static Metric>,
    #[command(flatten)]
    pub how: ScoringHow,
}

/// The file of a changed stone.
pub struct ChangedFile<'a> {
    spec: OsString,
    args: &'a WrittenArgs,
    outputs: Outputs,
    encoded: Option<(PathBuf, Vec<u8>)>,
    remarks: Vec<String>,
}

/// A report with the file that the stone was written to, as JSON.
#[derive(Serialize)]
struct WithFile<'a, R: Serialize> {
    #[serde(flatten)]
    report: &'a R,
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<String>,
}

impl<'a> ChangedFile<'a> {
    /// Tries the place and the format before the work.
    pub fn new(spec: &OsStr, args: &'a WrittenArgs, console: &Console) -> Result<ChangedFile<'a>, CliError> {
        if let Some(path) = args.output.as_deref().filter(|path| !atomic_write::is_stream(path)) {
            TargetFormat::from_path(path, args.to.as_deref())?;
            output_path::check_writable(path)?;
        } else if let Some(to) = &args.to {
            TargetFormat::by_name(to)?;
        }
        let outputs = Outputs::reading_stones([spec], console);
        Ok(ChangedFile { spec: spec.into(), args, outputs, encoded: None, remarks: Vec::new() })
    }

    /// Makes the bytes of the file, and takes its place.
    ///
    /// - `material`: what it is of, if that was asked for
    pub fn encode(
        &mut self,
        stone: &Stone,
        changed: &Design,
        material: Option<&Material>,
    ) -> Result<(), CliError> {
        let Some(path) = &self.args.output else { return Ok(()) };
        let to = self.args.to.as_deref();
        let target = match atomic_write::is_stream(path) {
            true => TargetFormat::for_stream(path, to, edited_file::usual_format(stone))?,
            false => TargetFormat::from_path(path, to)?,
        };
        let encoded = edited_file::encode((&self.spec, stone), changed, material, target, limits())?;
        self.outputs.claim(path, |there| outputs::has_bytes(there, &encoded.bytes))?;
        self.remarks = encoded.remarks;
        self.encoded = Some((path.clone(), encoded.bytes));
        Ok(())
    }

    /// Writes the file and prints the report.
    pub fn finish<R: Serialize>(
        self,
        report: &R,
        text: &ChangedText,
        console: &Console,
    ) -> Result<ExitStatus, CliError> {
        let is_printed = |path: &Path| atomic_write::is_stdout(path);
        self.remarks.iter().for_each(|remark| console.note(&format!("note: {remark}")));
        text.warnings().iter().for_each(|warning| console.note(&format!("note: {warning}")));
        let mut file = None;
        if let Some((path, bytes)) = &self.encoded {
            atomic_write::write(path, bytes)?;
            if is_printed(path) {
                text.text().lines().for_each(|line| console.note(line));
                return Ok(ExitStatus::Done);
            }
            file = Some(stone::display_name(path));
        }
        if console.json {
            console.print_json(&WithFile { report, file: file.clone() })?;
        } else {
            console.print(&text.text())?;
        }
        match file {
            Some(file) => console.note(&format!("wrote {file}")),
            None => console.note("nothing is written: -o FILE writes the changed stone"),
        }
        Ok(ExitStatus::Done)
    }
}
