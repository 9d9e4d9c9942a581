//! `cutlab import`: any format in, any format out, whole folders at once.

pub mod plan;

use super::console::Console;
use super::form::Form;
use super::outcome::{self, Code, Failure};
use super::outputs::{self, Outputs};
use super::stones::{self, Substance};
use super::weight;
use crate::cut::Unit;
use crate::formats::{self, Encoded};
use crate::optics::weight::Weight;
use crate::report::diagram::Paper;
use crate::store::terminal::in_line;
use crate::store::{place, replace};
use plan::Job;
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
pub struct Args {
    /// Designs, meshes, and folders of them; the content decides the format of each
    #[arg(required = true, value_name = "FILE|DIR")]
    files: Vec<OsString>,
    /// Where to write: a file whose ending chooses the format, or a folder
    #[arg(long, short, value_name = "OUT")]
    output: PathBuf,
    /// Format to write, a name or ending from `cutlab list formats`, or svg or png for the cutting
    /// diagram [for a folder: toml]
    #[arg(long, value_name = "FORMAT")]
    to: Option<String>,
    /// Scale to this girdle width in millimetres
    #[arg(long, value_name = "MM", value_parser = stones::millimetres)]
    size: Option<f64>,
    /// What `generate` sets beside, for the stones of a folder.
    #[arg(skip)]
    made: Made,
}

/// What `generate` sets, of which `import` has no options.
#[derive(Debug, Clone, Copy, Default)]
pub struct Made {
    /// Weight in carats, in place of a size.
    pub carat: Option<f64>,
    /// Paper of cutting diagrams.
    pub paper: Option<Paper>,
    /// What the stones are made of.
    pub substance: Substance,
}

/// What happened to one file.
#[derive(Debug, Clone, Default, Serialize)]
struct Row {
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

impl Args {
    /// Of everything in one folder into another.
    pub fn of_folder(folder: OsString, output: PathBuf, to: &str, size: Option<f64>, made: Made) -> Args {
        Args { files: vec![folder], output, to: Some(to.to_owned()), size, made }
    }
}

const WRITTEN: &str = "written";
const THERE: &str = "there already";
const PASSED_OVER: &str = "passed over";

/// Reads every file and writes it again.
pub fn run(args: &Args, console: &Console) -> Result<Code, Failure> {
    let to_output = replace::is_stdout(&args.output);
    let (jobs, form) = plan(args)?;
    let outputs = Outputs::beside(jobs.iter().map(|job| &job.stone), console);
    if !to_output {
        if let Some(job) = jobs.first() {
            // nothing is read for a place where nothing can be written
            place::tried(&job.target.with_file_name(".cutlab-import"))?;
        }
        outcome::goes_on();
    }
    let work = |job: &Job| import(job, args, form, &outputs, console);
    let mut results = stones::each(&jobs, console, "importing", work);
    let row = |(job, result): (&Job, &Result<Row, Failure>)| match result {
        Ok(row) => row.clone(),
        Err(failure) => {
            let error = Some(failure.message());
            Row { file: stones::shown(&job.stone), outcome: "failed", error, ..Row::default() }
        }
    };
    let rows: Vec<Row> = jobs.iter().zip(&results).map(row).collect();
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
        return Err(Failure::input(format!(
            "no designs and no meshes in {}",
            args.files.iter().map(stones::shown).collect::<Vec<_>>().join(", ")
        )));
    }
    Ok(stones::code(&results))
}

/// What is to be imported, and the format to write it in.
fn plan(args: &Args) -> Result<(Vec<Job>, Form), Failure> {
    let alone = args.files.len() == 1 && !Path::new(&args.files[0]).is_dir();
    let is_folder =
        args.output.is_dir() || (args.output.extension().is_none() && !replace::is_stream(&args.output));
    let to_file = !is_folder;
    if to_file && !alone {
        return Err(Failure::input(format!(
            "several stones do not fit into the one file {}: give a folder and --to FORMAT",
            stones::shown(&args.output)
        )));
    }
    let to = args.to.as_deref();
    let form = match to_file && !replace::is_stream(&args.output) {
        true => Form::of(&args.output, to)?,
        false => Form::for_stream(&args.output, to, "toml")?,
    };
    if to_file {
        let job =
            |stone: &OsString| Job { stone: stone.clone(), target: args.output.clone(), by_chance: false };
        return Ok((args.files.iter().map(job).collect(), form));
    }
    Ok((plan::into_folder(&args.files, &args.output, form.ending())?, form))
}

fn import(job: &Job, args: &Args, form: Form, outputs: &Outputs, console: &Console) -> Result<Row, Failure> {
    let file = stones::shown(&job.stone);
    if job.by_chance {
        return Ok(Row { file, outcome: PASSED_OVER, ..Row::default() });
    }
    let to_stream = replace::is_stream(&job.target);
    if !to_stream {
        outputs.check_inputs(&job.target)?;
        if console.force {
            place::tried(&job.target)?;
        }
    }
    let (bytes, read) = match stones::open(&job.stone) {
        Err(failure) => match failure.shape().and_then(|s| Some((s.format, s.body.as_ref()?))) {
            Some((of, body)) => {
                let scale = args.size.map(|mm| mm / body.width()).or(formats::unit_mm(of));
                let unit = if scale.is_some() { Unit::Millimetre } else { Unit::Free };
                let scale = scale.unwrap_or(1.0);
                let name = stones::shown(stones::file_stem(&job.stone));
                let (Form::Format(format), None) = (form, args.made.carat) else { return Err(failure) };
                let bytes = formats::encode_mesh(&name, &body.clone().scaled(scale), unit, format.name)?;
                let said = failure.message();
                let said = said.strip_prefix(&format!("{file}: ")).unwrap_or(&said).to_owned();
                (
                    bytes,
                    Row {
                        format: Some(of),
                        facets: Some(body.facets.len()),
                        warnings: vec![said],
                        ..Row::default()
                    },
                )
            }
            None => return Err(failure),
        },
        Ok(imported) => {
            let facets = imported.design.solid()?.faces.len();
            let Made { carat, paper, substance } = args.made;
            let substance = substance.within(&job.stone)?;
            let size = match carat {
                Some(carats) => {
                    let weight = Weight::of(&substance.of(&imported.design));
                    Some(weight::width_mm(&weight, &imported.design, carats)?)
                }
                None => args.size,
            };
            let design = stones::sized(imported.design, size)?;
            let paper = paper.unwrap_or(Paper::A4);
            let mut warnings = imported.warnings;
            let Encoded { bytes, remarks } = form.encoded(&design, substance.asked().as_ref(), paper)?;
            warnings.extend(remarks);
            (bytes, Row { format: Some(imported.format), facets: Some(facets), warnings, ..Row::default() })
        }
    };
    if to_stream || console.force {
        replace::write(&job.target, &bytes)?;
    } else if job.target.symlink_metadata().is_ok() || !replace::create(&job.target, &bytes)? {
        // an import that was interrupted, started again
        if !outputs::holds(&job.target, &bytes) {
            return Err(Failure::exists(&file, &job.target));
        }
        return Ok(Row { file, outcome: THERE, ..read });
    }
    Ok(Row { file, outcome: WRITTEN, wrote: Some(stones::shown(&job.target)), ..read })
}

/// The rows in columns, then how many had which outcome.
fn table(rows: &[Row]) -> String {
    let listed: Vec<[String; 4]> = rows
        .iter()
        .filter(|r| r.outcome != PASSED_OVER)
        .map(|r| {
            let wrote = r.wrote.as_ref().map_or_else(|| r.outcome.into(), |wrote| in_line(wrote));
            let facets = r.facets.map_or_else(String::new, |n| n.to_string());
            [in_line(&r.file), r.format.unwrap_or_default().into(), facets, wrote]
        })
        .collect();
    let heads = ["file", "format", "facets", "wrote"].map(String::from);
    let width = |c: usize| listed.iter().chain([&heads]).map(|r| r[c].chars().count()).max().unwrap_or(0);
    let (file, format, facets) = (width(0), width(1), width(2));
    let line = |r: &[String; 4]| format!("{:file$}  {:format$}  {:>facets$}  {}\n", r[0], r[1], r[2], r[3]);
    let mut text: String = [&heads].into_iter().chain(&listed).map(line).collect();
    let counts: Vec<String> = [WRITTEN, THERE, "failed", PASSED_OVER]
        .iter()
        .map(|outcome| (rows.iter().filter(|r| r.outcome == *outcome).count(), outcome))
        .filter(|(n, _)| *n > 0)
        .map(|(n, outcome)| format!("{n} {outcome}"))
        .collect();
    text += &counts.join(", ");
    text
}
