//! `cutlab import`: any format in, any format out, whole folders at once.

use super::args::stone;
use super::args::stone::{OrientationArgs, StoneArgs};
use super::console::Console;
use super::exit_code::{self, CliError, ExitStatus};
use super::form::TargetFormat;
use super::outputs::{self, Outputs};
use super::terminal_table;
use super::weight;
use crate::batch::output_places::{self, Job};
use crate::cli::limits::limits;
use crate::formats::{self, Encoded};
use crate::materials::weight::Weight;
use crate::report::diagram::Paper;
use crate::stone::grammar;
use crate::storage::terminal::in_line;
use crate::storage::{atomic_write, output_path};
use comfy_table::{Cell, CellAlignment};
use serde::Serialize;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab import stone.gem -o stone.asc
  cutlab import designs -o meshes --to glb     a folder with all that is in it, as glb into meshes/

Files of a folder that are of no known format are passed over. Nothing is overwritten without
--force; what an interrupted import has written is left as it is. A closed mesh with dents or in several parts is written as a mesh, and said to be one.")]
pub struct ImportArgs {
    /// Designs, meshes, and folders of them; the content decides the format of each
    #[arg(required = true, value_name = "FILE|DIR")]
    files: Vec<OsString>,
    /// Where to write: a file whose extension chooses the format, or a folder
    #[arg(long, short, value_name = "OUT")]
    output: PathBuf,
    /// Format to write, a name or extension from `cutlab list formats`, or svg or png for the cutting
    /// diagram [for a folder: toml]
    #[arg(long, value_name = "FORMAT")]
    to: Option<String>,
    /// Scale to this girdle width in millimetres
    #[arg(long, value_name = "MM", value_parser = stone::millimetres)]
    size: Option<f64>,
    #[command(flatten)]
    orientation: OrientationArgs,
    /// What `generate` sets beside, for the stones of a folder.
    #[arg(skip)]
    made: GenerateSettings,
}

/// What `generate` sets, of which `import` has no options.
#[derive(Debug, Clone, Default)]
pub struct GenerateSettings {
    /// Weight in carats, in place of a size.
    pub carat: Option<f64>,
    /// Paper of cutting diagrams.
    pub paper: Option<Paper>,
    /// What the stones are made of.
    pub stone_args: StoneArgs,
}

/// What happened to one file.
#[derive(Debug, Clone, Default, Serialize)]
struct ImportRow {
    file: String,
    outcome: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    format: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    facets: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    wrote: Option<String>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    warnings: Vec<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<String>,
}

impl ImportArgs {
    /// Of everything in one folder into another.
    pub fn for_folder(
        folder: OsString,
        output: PathBuf,
        to: &str,
        size: Option<f64>,
        made: GenerateSettings,
    ) -> ImportArgs {
        let orientation = made.stone_args.orientation;
        ImportArgs { files: vec![folder], output, to: Some(to.to_owned()), size, orientation, made }
    }
}

const WRITTEN: &str = "written";
const THERE: &str = "there already";
const PASSED_OVER: &str = "passed over";

/// Reads every file and writes it again.
pub fn run(args: &ImportArgs, console: &Console) -> Result<ExitStatus, CliError> {
    let to_output = atomic_write::is_stdout(&args.output);
    let (jobs, form) = plan(args)?;
    let outputs = Outputs::reading_stones(jobs.iter().map(|job| &job.stone), console);
    if !to_output {
        if let Some(job) = jobs.first() {
            // nothing is read for a place where nothing can be written
            output_path::check_writable(&job.target.with_file_name(".cutlab-import"))?;
        }
        exit_code::mark_resumable();
    }
    let work = |job: &Job| import(job, args, form, &outputs, console);
    let mut results = stone::open_each(&jobs, console, "importing", work);
    let row = |(job, result): (&Job, &Result<ImportRow, CliError>)| match result {
        Ok(row) => row.clone(),
        Err(failure) => {
            let error = Some(failure.message());
            ImportRow {
                file: stone::display_name(&job.stone),
                outcome: "failed",
                error,
                ..ImportRow::default()
            }
        }
    };
    let rows: Vec<ImportRow> = jobs.iter().zip(&results).map(row).collect();
    rows.iter().for_each(|r| r.warnings.iter().for_each(|w| console.note(&format!("{}: note: {w}", r.file))));
    results.retain(|r| r.as_ref().map_or(true, |row| row.outcome != PASSED_OVER));
    if console.json && !to_output {
        console.print_json(&rows)?;
    } else {
        rows.iter().filter_map(|r| r.error.as_ref()).for_each(|e| console.complain(e));
        if to_output {
            table(&rows).lines().for_each(|line| console.note(line));
        } else if rows.iter().any(|r| [WRITTEN, THERE].contains(&r.outcome)) {
            console.tell(&table(&rows))?;
        }
    }
    if results.is_empty() {
        return Err(CliError::input(format!(
            "no designs and no meshes in {}",
            args.files.iter().map(stone::display_name).collect::<Vec<_>>().join(", ")
        )));
    }
    Ok(stone::code(&results))
}

/// What is to be imported, and the format to write it in.
fn plan(args: &ImportArgs) -> Result<(Vec<Job>, TargetFormat), CliError> {
    let alone = args.files.len() == 1 && !Path::new(&args.files[0]).is_dir();
    let is_folder =
        args.output.is_dir() || (args.output.extension().is_none() && !atomic_write::is_stream(&args.output));
    let to_file = !is_folder;
    if to_file && !alone {
        return Err(CliError::input(format!(
            "several stones do not fit into the one file {}: give a folder and --to FORMAT",
            stone::display_name(&args.output)
        )));
    }
    let to = args.to.as_deref();
    let form = match to_file && !atomic_write::is_stream(&args.output) {
        true => TargetFormat::from_path(&args.output, to)?,
        false => TargetFormat::for_stream(&args.output, to, "toml")?,
    };
    if to_file {
        let job =
            |stone: &OsString| Job { stone: stone.clone(), target: args.output.clone(), by_chance: false };
        return Ok((args.files.iter().map(job).collect(), form));
    }
    Ok((output_places::into_folder(&args.files, &args.output, form.extension(), limits())?, form))
}

fn import(
    job: &Job,
    args: &ImportArgs,
    form: TargetFormat,
    outputs: &Outputs,
    console: &Console,
) -> Result<ImportRow, CliError> {
    let file = stone::display_name(&job.stone);
    if job.by_chance {
        return Ok(ImportRow { file, outcome: PASSED_OVER, ..ImportRow::default() });
    }
    let to_stream = atomic_write::is_stream(&job.target);
    if !to_stream {
        outputs.check_inputs(&job.target)?;
        if console.force {
            output_path::check_writable(&job.target)?;
        }
    }
    let GenerateSettings { carat, paper, stone_args } = args.made.clone();
    let stone = StoneArgs { orientation: args.orientation, ..stone_args }.open(&job.stone)?;
    let size = match (carat, stone.design()) {
        (Some(carats), Some(design)) => {
            Some(weight::width_mm(&Weight::new(stone.material()), design, carats)?)
        }
        _ => args.size,
    };
    let stone = match size {
        Some(mm) => stone.with_width(mm)?,
        None => stone,
    };
    let mut warnings = stone.warnings().to_vec();
    let bytes = match (stone.mesh(), form) {
        (Some(mesh), TargetFormat::Format(format)) if carat.is_none() => {
            let name = stone::display_name(grammar::file_stem(&job.stone));
            let why = stone.why_not_convex().map_or_else(String::new, ToString::to_string);
            warnings = vec![why.strip_prefix(&format!("{file}: ")).unwrap_or(&why).to_owned()];
            formats::encode_mesh(&name, mesh, stone.unit(), format.name)?
        }
        _ => {
            let design = stone.convex_design()?;
            let paper = paper.unwrap_or(Paper::A4);
            let Encoded { bytes, remarks } = form.encoded(design, stone.given_material(), paper)?;
            warnings.extend(remarks);
            bytes
        }
    };
    let (format, facets) = (Some(stone.format()), Some(stone.facets()));
    let read = ImportRow { format, facets, warnings, ..ImportRow::default() };
    if to_stream || console.force {
        atomic_write::write(&job.target, &bytes)?;
    } else if job.target.symlink_metadata().is_ok() || !atomic_write::create(&job.target, &bytes)? {
        // an import that was interrupted, started again
        if !outputs::has_bytes(&job.target, &bytes) {
            return Err(CliError::exists(&file, &job.target));
        }
        return Ok(ImportRow { file, outcome: THERE, ..read });
    }
    Ok(ImportRow { file, outcome: WRITTEN, wrote: Some(stone::display_name(&job.target)), ..read })
}

/// The rows in columns, then how many had which outcome.
fn table(rows: &[ImportRow]) -> String {
    let mut table = terminal_table::new();
    let right = |text: String| Cell::new(text).set_alignment(CellAlignment::Right);
    table.set_header(["file".into(), "format".into(), right("facets".into()), Cell::new("wrote")]);
    table.add_rows(rows.iter().filter(|r| r.outcome != PASSED_OVER).map(|r| {
        let wrote = r.wrote.as_ref().map_or_else(|| r.outcome.into(), |wrote| in_line(wrote));
        let facets = r.facets.map_or_else(String::new, |n| n.to_string());
        [in_line(&r.file).into(), r.format.unwrap_or_default().into(), right(facets), Cell::new(wrote)]
    }));
    let mut text = terminal_table::lines(&table);
    let counts: Vec<String> = [WRITTEN, THERE, "failed", PASSED_OVER]
        .iter()
        .map(|outcome| (rows.iter().filter(|r| r.outcome == *outcome).count(), outcome))
        .filter(|(n, _)| *n > 0)
        .map(|(n, outcome)| format!("{n} {outcome}"))
        .collect();
    text += &counts.join(", ");
    text
}
