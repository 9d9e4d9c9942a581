//! `cutlab generate`: a stone from its parameters.

use super::args::family::FamilyArgs;
use super::args::stone::{self, DEFAULT_STONE, StoneArgs};
use super::args::values;
use super::console::Console;
use super::diagram_output;
use super::exit_code::{CliError, ExitStatus};
use super::form::TargetFormat;
use super::import;
use super::outputs::{self, Outputs};
use super::weight;
use crate::design::families;
use crate::formats::Encoded;
use crate::materials::weight::Weight;
use crate::report::diagram::Paper;
use crate::stone::grammar;
use crate::storage::atomic_write;
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
pub struct GenerateArgs {
    /// What to make: a name from `cutlab list cuts`, with parameters or not, a file, or a folder of
    /// files, whose stones are written into the folder -o
    #[arg(default_value = DEFAULT_STONE)]
    stone: OsString,
    /// Exact total of facets; girdle flats are added or taken to meet it
    #[arg(long, value_name = "N", value_parser = values::whole_number(1..=1_000_000, "a total of facets is a whole number"))]
    facets: Option<u32>,
    /// Girdle diameter (width) in millimetres
    #[arg(long, value_name = "MM", value_parser = stone::millimetres)]
    size: Option<f64>,
    /// Weight in carats, in place of --size: the width follows from the density of the material, or of
    /// diamond
    #[arg(long, value_name = "CT", value_parser = weight::carats, conflicts_with = "size")]
    carat: Option<f64>,
    /// Where to write; the extension chooses the format, .svg, .pdf and .png the cutting diagram; may be
    /// given several times
    #[arg(long, short, value_name = "FILE")]
    output: Vec<PathBuf>,
    /// Format for `-o -` and for a folder, or where the extension of a file says none: a name or extension from
    /// `cutlab list formats`, svg, pdf or png [obj]
    #[arg(long, value_name = "FORMAT")]
    to: Option<String>,
    /// Paper of the cutting diagram
    #[arg(long, value_name = "a4|letter", default_value = "a4", value_parser = diagram_output::paper)]
    paper: Paper,
    /// What the stone is made of: the index of refraction that design files state and the material in
    /// glTF
    #[command(flatten)]
    stone_args: StoneArgs,
    #[command(flatten)]
    parameters: FamilyArgs,
}

/// What goes to standard output and into a folder unless it is said.
const USUAL_FORMAT: &str = "obj";

/// What was made, for `--json`.
#[derive(serde::Serialize)]
struct GeneratedStone {
    name: String,
    facets: usize,
    made_up_of: String,
    files: Vec<String>,
}

/// Makes the stone and writes it.
pub fn run(args: &GenerateArgs, console: &Console) -> Result<ExitStatus, CliError> {
    if Path::new(&args.stone).is_dir() {
        return folder(args, console);
    }
    // refused before the work, and before anything is said
    let usual = TargetFormat::by_name(args.to.as_deref().unwrap_or(USUAL_FORMAT))?;
    let to_stream = args.output.iter().any(|file| atomic_write::is_stream(file));
    let form = |file: &PathBuf| match atomic_write::is_stream(file) {
        true => TargetFormat::for_stream(file, args.to.as_deref(), USUAL_FORMAT),
        // beside a stream --to is the stream's
        false => TargetFormat::from_path(file, args.to.as_deref().filter(|_| !to_stream)),
    };
    let mut forms: Vec<TargetFormat> = args.output.iter().map(form).collect::<Result<_, _>>()?;
    let mut parameters = args.parameters.clone();
    if let Some(n) = args.facets {
        parameters.0.insert("facets".into(), n.into());
    }
    let is_given = |key: &str| parameters.0.contains_key(key);
    let has_size = args.stone.to_str().is_some_and(|stone| grammar::size_is_parameter(stone, is_given));
    if let (true, Some(mm)) = (has_size, args.size) {
        parameters.0.insert("size".into(), mm);
    }
    if let (false, Some(flag)) = (grammar::is_cut(&args.stone), parameters.0.keys().next())
        && Path::new(&args.stone).exists()
    {
        return Err(CliError::input(format!(
            "{} is a file with fixed facets: --{flag} needs a parametric cut (cutlab list cuts)",
            stone::display_name(&args.stone)
        )));
    }
    let stone = match args.stone.to_str() {
        Some(text) => args.stone_args.open_convex(grammar::with_parameters(text, &parameters.0))?,
        None => args.stone_args.open_convex(&args.stone)?,
    };
    let mut notes: Vec<String> = stone.warnings().iter().map(|w| format!("note: {w}")).collect();
    let mut size = args.size.filter(|_| !has_size);
    if let Some(carats) = args.carat {
        let weight = Weight::new(stone.material());
        let mm = weight::width_mm(&weight, stone.convex_design()?, carats)?;
        let name = weight.name().unwrap_or_default();
        notes.push(format!("note: {carats} ct in {name} is {mm:.3} mm wide"));
        size = Some(mm);
    }
    let stone = match size {
        Some(mm) => stone.with_width(mm)?,
        None => stone,
    };
    let design = stone.convex_design()?;
    let (made_up_of, facets) = families::facet_summary(design)?;

    let mut files = args.output.clone();
    if files.is_empty() {
        let mut name = grammar::file_stem(&args.stone);
        name.push(format!("-{facets}.{}", usual.extension()));
        files.push(name.into());
        forms.push(usual);
    }
    let mut encoded: Vec<Vec<u8>> = Vec::new();
    for form in forms {
        let Encoded { bytes, remarks } = form.encoded(design, stone.given_material(), args.paper)?;
        notes.extend(remarks.iter().map(|said| format!("note: {}: {said}", form.extension())));
        encoded.push(bytes);
    }
    let mut outputs = Outputs::reading_stones([&args.stone], console);
    for (file, bytes) in files.iter().zip(&encoded) {
        outputs.claim(file, |there| outputs::has_bytes(there, bytes))?;
    }
    notes.iter().for_each(|note| console.note(note));
    for (file, bytes) in files.iter().zip(&encoded) {
        atomic_write::write(file, bytes)?;
        if !atomic_write::is_stdout(file) {
            console.note(&format!("wrote {}", stone::display_name(file)));
        }
    }
    let summary = format!("{}: {facets} facets = {made_up_of}", design.name);
    if files.iter().any(|f| atomic_write::is_stdout(f)) {
        console.note(&summary);
    } else if console.json {
        let files = files.iter().map(stone::display_name).collect();
        console.print_json(&GeneratedStone { name: design.name.clone(), facets, made_up_of, files })?;
    } else {
        console.tell(&summary)?;
    }
    Ok(ExitStatus::Done)
}

/// Writes every stone of a folder into another.
fn folder(args: &GenerateArgs, console: &Console) -> Result<ExitStatus, CliError> {
    let stone = stone::display_name(&args.stone);
    let [output] = &args.output[..] else {
        return Err(CliError::input(format!("{stone} is a folder: -o names one folder to write into")));
    };
    if args.facets.is_some() || !args.parameters.0.is_empty() {
        return Err(CliError::input(format!("{stone} is a folder: its stones have no parameters to set")));
    }
    let made = import::GenerateSettings {
        carat: args.carat,
        paper: Some(args.paper),
        stone_args: args.stone_args.clone(),
    };
    let to = args.to.as_deref().unwrap_or(USUAL_FORMAT);
    let args = import::ImportArgs::for_folder(args.stone.clone(), output.clone(), to, args.size, made);
    import::run(&args, console)
}
