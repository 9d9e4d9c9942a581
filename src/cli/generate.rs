//! `cutlab generate`: a stone from its parameters.

use super::console::Console;
use super::drawing::{self, Drawing};
use super::import;
use super::outcome::{Code, Failure};
use super::outputs::{self, Outputs};
use super::parameters::Parameters;
use super::stones::{self, DEFAULT_STONE};
use super::values;
use super::weight;
use crate::cut::{Design, families};
use crate::formats::{self, FormatError};
use crate::optics::Material;
use crate::optics::weight::Weight;
use crate::report::diagram::Paper;
use crate::store::replace;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab generate --facets 153                    round-brilliant-153.obj in this folder
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
    /// Format for `-o -` and for a folder: a name or ending from `cutlab list formats`, svg, pdf or png
    #[arg(long, value_name = "FORMAT", default_value = "obj")]
    to: String,
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
    imported.warnings.iter().for_each(|w| console.note(&format!("note: {w}")));
    let mut size = args.size.filter(|_| !has_size);
    if let Some(carats) = args.carat {
        let weight = Weight::of(&args.substance.of(&imported.design));
        let mm = weight::width_mm(&weight, &imported.design, carats)?;
        console
            .note(&format!("note: {carats} ct in {} is {mm:.3} mm wide", weight.name().unwrap_or_default()));
        size = Some(mm);
    }
    let design = stones::sized(imported.design, size)?;
    let (made_up_of, facets) = families::made_up_of(&design)?;

    let asked = args.substance.asked();
    let index = asked.as_ref().map(Material::index_d).or(design.refractive_index);

    let mut files = args.output.clone();
    if files.is_empty() {
        let mut name = stones::file_stem(&args.stone);
        name.push(format!("-{facets}.obj"));
        files.push(name.into());
    }
    let encode = |file: &PathBuf| {
        // the name of a pipe may have an ending that tells, that of a device has none
        let is_nameless = replace::is_stream(file) && formats::written_to(file).is_err();
        let drawing = Drawing::of(file).or_else(|| Drawing::named(&args.to).filter(|_| is_nameless));
        if let Some(drawing) = drawing {
            return drawing.bytes(&design, index, args.paper);
        }
        let format = if is_nameless { formats::written_as(&args.to) } else { formats::written_to(file) };
        encoded(&design, asked.as_ref(), format.map_err(with_drawings)?.name, console)
    };
    let encoded: Vec<Vec<u8>> = files.iter().map(encode).collect::<Result<_, Failure>>()?;
    let mut outputs = Outputs::beside([&args.stone], console);
    for (file, bytes) in files.iter().zip(&encoded) {
        outputs.claim(file, |there| outputs::holds(there, bytes))?;
    }
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

/// The bytes of a file of the stone; what had no room in it is noted.
fn encoded(
    design: &Design,
    material: Option<&Material>,
    format: &str,
    console: &Console,
) -> Result<Vec<u8>, Failure> {
    let encoded = formats::encode_as(design, material, format)?;
    encoded.remarks.iter().for_each(|said| console.note(&format!("note: {format}: {said}")));
    Ok(encoded.bytes)
}

/// The same error with the endings of diagrams among those that are written.
fn with_drawings(error: FormatError) -> FormatError {
    match error {
        FormatError::NoWriter { asked, mut known } => {
            known.extend(drawing::ENDINGS);
            FormatError::NoWriter { asked, known }
        }
        error => error,
    }
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
