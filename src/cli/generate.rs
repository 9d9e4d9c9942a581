//! `cutlab generate`: a stone from its parameters.

use super::console::Console;
use super::drawing::Drawing;
use super::import;
use super::outcome::{Code, Failure};
use super::outputs::{self, Outputs};
use super::parameters::Parameters;
use super::stones::{self, DEFAULT_STONE};
use crate::cut::families;
use crate::formats;
use crate::store::replace;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab generate --facets 153                    round-brilliant-153.obj in this folder
  cutlab generate --table 57 --crown-angle 35 -o stone.obj -o stone.toml
  cutlab generate prism --sides 6 --height 5      also bipyramid, octahedron
  cutlab generate classic -o classic.svg          the cutting diagram, one page; also .png
  cutlab generate designs/ --to svg -o sheets     the diagrams of a whole folder, into another")]
pub struct Args {
    /// What to make: a name from `cutlab list cuts`, with parameters or not, a file, or a folder of
    /// files, whose stones are written into the folder -o
    #[arg(default_value = DEFAULT_STONE)]
    stone: OsString,
    /// Exact total of facets; girdle flats are added or taken to meet it
    #[arg(long, value_name = "N")]
    facets: Option<u32>,
    /// Girdle diameter (width) in millimetres
    #[arg(long, value_name = "MM", value_parser = stones::millimetres)]
    size: Option<f64>,
    /// Where to write; the ending chooses the format, .svg and .png the cutting diagram; may be given
    /// several times
    #[arg(long, short, value_name = "FILE")]
    output: Vec<PathBuf>,
    /// Format for `-o -` and for a folder: a name or ending from `cutlab list formats`, svg or png
    #[arg(long, value_name = "FORMAT", default_value = "obj")]
    to: String,
    #[command(flatten)]
    parameters: Parameters,
}

/// What was made, for `--json`.
#[derive(serde::Serialize)]
struct Made {
    name: String,
    facets: usize,
    made_up_of: String,
    files: Vec<PathBuf>,
}

/// Makes the stone and writes it.
pub fn run(args: &Args, console: &Console) -> Result<Code, Failure> {
    if Path::new(&args.stone).is_dir() {
        return folder(args, console);
    }
    let mut parameters = args.parameters.clone();
    if let Some(n) = args.facets {
        parameters.0.insert("facets".into(), n.into());
    }
    let has_size = args
        .stone
        .to_str()
        .and_then(stones::family)
        .is_some_and(|f| f.parameters.iter().any(|p| p.key == "size"));
    if let (true, Some(mm)) = (has_size, args.size) {
        parameters.0.insert("size".into(), mm);
    }
    if let (false, Some(flag)) = (stones::is_cut(&args.stone), parameters.0.keys().next())
        && Path::new(&args.stone).exists()
    {
        return Err(Failure::input(format!(
            "{} is a file with fixed facets: --{flag} needs a parametric cut (cutlab list cuts)",
            stones::shown(&args.stone)
        )));
    }
    let imported = match args.stone.to_str() {
        Some(text) => stones::open(parameters.applied_to(text))?,
        None => stones::open(&args.stone)?,
    };
    imported.warnings.iter().for_each(|w| console.note(&format!("note: {w}")));
    let design = stones::sized(imported.design, args.size.filter(|_| !has_size))?;
    let (made_up_of, facets) = families::made_up_of(&design)?;

    let mut files = args.output.clone();
    if files.is_empty() {
        files.push(format!("{}-{facets}.obj", stones::file_stem(&args.stone).display()).into());
    }
    let encoded = |file: &PathBuf| {
        let drawing = if replace::is_stream(file) { Drawing::named(&args.to) } else { Drawing::of(file) };
        Ok(match drawing {
            Some(drawing) => drawing.bytes(&design, design.refractive_index)?,
            None if replace::is_stream(file) => formats::encode(&design, &args.to)?,
            None => formats::encode(&design, formats::written_to(file)?.name)?,
        })
    };
    let encoded: Vec<Vec<u8>> = files.iter().map(encoded).collect::<Result<_, Failure>>()?;
    let mut outputs = Outputs::beside([&args.stone], console);
    for (file, bytes) in files.iter().zip(&encoded) {
        outputs.claim(file, |there| outputs::holds(there, bytes))?;
    }
    for (file, bytes) in files.iter().zip(&encoded) {
        replace::write(file, bytes)?;
        if !replace::is_stdout(file) {
            console.note(&format!("wrote {}", file.display()));
        }
    }
    let summary = format!("{}: {facets} facets = {made_up_of}", design.name);
    if files.iter().any(|f| replace::is_stdout(f)) {
        console.note(&summary);
    } else if console.json {
        console.print_json(&Made { name: design.name, facets, made_up_of, files })?;
    } else {
        console.print(&summary)?;
    }
    Ok(Code::Done)
}

/// Writes every stone of a folder into another.
fn folder(args: &Args, console: &Console) -> Result<Code, Failure> {
    let stone = stones::shown(&args.stone);
    let [output] = &args.output[..] else {
        return Err(Failure::input(format!("{stone} is a folder: -o names one folder to write into")));
    };
    if args.facets.is_some() || !args.parameters.0.is_empty() {
        return Err(Failure::input(format!("{stone} is a folder: its stones have no parameters to set")));
    }
    import::run(&import::Args::of_folder(args.stone.clone(), output.clone(), &args.to, args.size), console)
}
