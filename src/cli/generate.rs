//! `cutlab generate`: a stone from its parameters.

use super::console::Console;
use super::drawing;
use super::form::Form;
use super::import;
use super::outcome::{Code, Failure};
use super::outputs::{self, Outputs};
use super::parameters::Parameters;
use super::stones::{self, DEFAULT_STONE};
use super::values;
use super::weight;
use crate::cut::families;
use crate::formats::Encoded;
use crate::optics::weight::Weight;
use crate::report::diagram::Paper;
use crate::store::replace;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab generate --facets 153                    round-brilliant-153.obj in this folder; or --to stl
  cutlab generate --table 57 --crown-angle 35 -o stone.obj -o stone.toml
  cutlab generate prism --sides 6 --height 5      also bipyramid, octahedron
  cutlab generate round-brilliant:depth=61.5,crown-height=15,pavilion-depth=43 --carat 1 -o stone.glb
  cutlab generate classic -o classic.svg          the cutting diagram, one page; also .pdf, .png
  cutlab generate designs/ --to svg -o sheets     the diagrams of a whole folder, into another")]
pub struct Args {
    /// What to make: a name from `cutlab list cuts`, with parameters or not, a file, or a folder of
    /// files, whose stones are written into the folder -o
    #[arg(default_value = DEFAULT_STONE)]
    stone: OsString,
    /// Exact total of facets; girdle flats are added or taken to meet it
    #[arg(long, value_name = "N", value_parser = values::whole(1..=1_000_000, "a total of facets is a whole number"))]
    facets: Option<u32>,
    /// Girdle diameter (width) in millimetres
    #[arg(long, value_name = "MM", value_parser = stones::millimetres)]
    size: Option<f64>,
    /// Weight in carats, in place of --size: the width follows from the density of the material, or of
    /// diamond
    #[arg(long, value_name = "CT", value_parser = weight::carats, conflicts_with = "size")]
    carat: Option<f64>,
    /// Where to write; the ending chooses the format, .svg, .pdf and .png the cutting diagram; may be
    /// given several times
    #[arg(long, short, value_name = "FILE")]
    output: Vec<PathBuf>,
    /// Format for `-o -` and for a folder, or where the ending of a file says none: a name or ending from
    /// `cutlab list formats`, svg, pdf or png [obj]
    #[arg(long, value_name = "FORMAT")]
    to: Option<String>,
    /// Paper of the cutting diagram
    #[arg(long, value_name = "a4|letter", default_value = "a4", value_parser = drawing::paper)]
    paper: Paper,
    /// What the stone is made of: the index of refraction that design files state and the material in
    /// glTF
    #[command(flatten)]
    substance: stones::Substance,
    #[command(flatten)]
    parameters: Parameters,
}

/// What goes to standard output and into a folder unless it is said.
const USUAL_FORMAT: &str = "obj";

/// What was made, for `--json`.
#[derive(serde::Serialize)]
struct Made {
    name: String,
    facets: usize,
    made_up_of: String,
    files: Vec<String>,
}

/// Makes the stone and writes it.
pub fn run(args: &Args, console: &Console) -> Result<Code, Failure> {
    if Path::new(&args.stone).is_dir() {
        return folder(args, console);
    }
    // refused before the work, and before anything is said
    let usual = Form::named(args.to.as_deref().unwrap_or(USUAL_FORMAT))?;
    let to_stream = args.output.iter().any(|file| replace::is_stream(file));
    let form = |file: &PathBuf| match replace::is_stream(file) {
        true => Form::for_stream(file, args.to.as_deref(), USUAL_FORMAT),
        // beside a stream --to is the stream's
        false => Form::of(file, args.to.as_deref().filter(|_| !to_stream)),
    };
    let mut forms: Vec<Form> = args.output.iter().map(form).collect::<Result<_, _>>()?;
    let mut parameters = args.parameters.clone();
    if let Some(n) = args.facets {
        parameters.0.insert("facets".into(), n.into());
    }
    let is_given = |key: &str| parameters.0.contains_key(key);
    let has_size = args.stone.to_str().is_some_and(|stone| stones::size_is_parameter(stone, is_given));
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
    let mut notes: Vec<String> = imported.warnings.iter().map(|w| format!("note: {w}")).collect();
    let mut size = args.size.filter(|_| !has_size);
    let substance = args.substance.within(&args.stone)?;
    if let Some(carats) = args.carat {
        let weight = Weight::of(&substance.of(&imported.design));
        let mm = weight::width_mm(&weight, &imported.design, carats)?;
        let name = weight.name().unwrap_or_default();
        notes.push(format!("note: {carats} ct in {name} is {mm:.3} mm wide"));
        size = Some(mm);
    }
    let design = stones::sized(imported.design, size)?;
    let (made_up_of, facets) = families::made_up_of(&design)?;

    let asked = substance.asked();
    let mut files = args.output.clone();
    if files.is_empty() {
        let mut name = stones::file_stem(&args.stone);
        name.push(format!("-{facets}.{}", usual.ending()));
        files.push(name.into());
        forms.push(usual);
    }
    let mut encoded: Vec<Vec<u8>> = Vec::new();
    for form in forms {
        let Encoded { bytes, remarks } = form.encoded(&design, asked.as_ref(), args.paper)?;
        notes.extend(remarks.iter().map(|said| format!("note: {}: {said}", form.ending())));
        encoded.push(bytes);
    }
    let mut outputs = Outputs::beside([&args.stone], console);
    for (file, bytes) in files.iter().zip(&encoded) {
        outputs.claim(file, |there| outputs::holds(there, bytes))?;
    }
    notes.iter().for_each(|note| console.note(note));
    for (file, bytes) in files.iter().zip(&encoded) {
        replace::write(file, bytes)?;
        if !replace::is_stdout(file) {
            console.note(&format!("wrote {}", stones::shown(&file)));
        }
    }
    let summary = format!("{}: {facets} facets = {made_up_of}", design.name);
    if files.iter().any(|f| replace::is_stdout(f)) {
        console.note(&summary);
    } else if console.json {
        let files = files.iter().map(stones::shown).collect();
        console.print_json(&Made { name: design.name, facets, made_up_of, files })?;
    } else {
        console.tell(&summary)?;
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
    let made = import::Made { carat: args.carat, paper: Some(args.paper), substance: args.substance };
    let to = args.to.as_deref().unwrap_or(USUAL_FORMAT);
    let args = import::Args::of_folder(args.stone.clone(), output.clone(), to, args.size, made);
    import::run(&args, console)
}
