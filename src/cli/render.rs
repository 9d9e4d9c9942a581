//! `cutlab render`: a photon-mapped picture of a stone, or an animation.

mod command;
mod frames;
mod rounds;

use super::console::Console;
use super::outcome::{Code, Failure};
use super::stones;
use crate::photons::{self, Shots, file};
use crate::render::animation::Turn;
use crate::render::{self, Curve, Maps, Tone, tone};
use crate::scene::{self, Cast, Pose, SCENES, Scene, SceneFile};
use std::path::{Path, PathBuf};

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab render                                   the default brilliant on the table
  cutlab render octahedron --scene cornell --passes
  cutlab render tolkowsky --scene my-scene.toml -o picture.exr
  cutlab render stone.asc --material quartz --photon-map stone.map --frames 36 -o turn.gif
  cutlab render --scene spot --turn stone --rock --frames 24 -o fire-%03d.png
  cutlab render --scene table --progressive --time 10min -o clean.exr")]
pub struct Args {
    /// The stones, for the scene's places in order; without them the scene's own
    #[arg(value_name = "STONE")]
    stones: Vec<String>,
    /// What is around it: a name of `cutlab list scenes`, or a TOML file
    #[arg(long, default_value = "table", value_name = "NAME|FILE")]
    scene: String,
    #[command(flatten)]
    substance: stones::Substance,
    /// Girdle width in millimetres
    #[arg(long, value_name = "MM", value_parser = stones::millimetres)]
    size: Option<f64>,
    /// How it stands: lying (as a loose stone comes to rest), table-up or table-down; the scene has a
    /// default
    #[arg(long, value_parser = pose)]
    pose: Option<Pose>,
    /// Where to write: .png, .exr (linear, with all passes); .gif, .apng or .png with %03d for frames
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Pixels across; the scene has a default
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=16384))]
    width: Option<u32>,
    /// Pixels down; the scene has a default
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=16384))]
    height: Option<u32>,
    /// Camera rays a pixel: 25, or 1 in each round of --progressive
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    spp: Option<u32>,
    /// Seed of all random numbers
    #[arg(long, default_value_t = 1)]
    seed: u64,
    #[command(flatten)]
    stops: rounds::Stops,
    /// Photons in each map
    #[arg(long, default_value_t = 100_000, value_parser = counted)]
    photons: usize,
    /// Photons over whose distance each spreads its light
    #[arg(long, default_value_t = 500, value_parser = counted)]
    nearest: usize,
    /// Keep the photons in this file and use them again for other views
    #[arg(long, value_name = "FILE")]
    photon_map: Option<PathBuf>,
    /// Also write the direct, caustic, indirect and stone passes, of which the picture is the sum
    #[arg(long)]
    passes: bool,
    /// An animation of this many pictures
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    frames: Option<u32>,
    /// What turns in an animation: camera, stone or light
    #[arg(long, default_value = "camera", value_parser = turn)]
    turn: Turn,
    /// Rock it by 15° to and fro instead of all the way around
    #[arg(long)]
    rock: bool,
    /// Exposure in stops beside the scene's own, or auto
    #[arg(long, default_value = "0", allow_negative_numbers = true, value_parser = exposure, value_name = "STOPS|auto")]
    exposure: Exposure,
    /// Tone curve, which acts on luminance and keeps the hue: filmic, straight up to .6, then
    /// .6 + .4 (1 - e^(-(x - .6)/.4)), or linear, which ends at white
    #[arg(long, default_value = "filmic", value_parser = curve)]
    tone: Curve,
    /// Let what is beyond white shine out in stars, as an iris of six blades does at this f-number; an
    /// EXR and the passes stay without
    #[arg(long, value_name = "F", num_args = 0..=1, require_equals = true, default_missing_value = "16", value_parser = f_number)]
    glare: Option<f32>,
    /// Bits a channel of a PNG: 8 or 16
    #[arg(long, default_value = "8", value_parser = ["8", "16"])]
    bits: String,
    /// Whether light keeps its polarisation from facet to facet; off takes it as unpolarised at each.
    /// On, unless the scene says
    #[arg(long, value_name = "on|off", value_parser = stones::on_off)]
    polarisation: Option<bool>,
}

#[derive(Debug, Clone, Copy)]
enum Exposure {
    Auto,
    Stops(f32),
}

impl Args {
    fn rays(&self) -> u32 {
        self.spp.unwrap_or(if self.stops.progressive { 1 } else { 25 })
    }

    fn photons(&self) -> photons::Settings {
        photons::Settings { photons: self.photons, nearest: self.nearest, seed: self.seed }
    }
}

fn exposure(text: &str) -> Result<Exposure, String> {
    match text.parse::<f32>() {
        _ if text == "auto" => Ok(Exposure::Auto),
        Ok(stops) if stops.abs() <= 30.0 => Ok(Exposure::Stops(stops)),
        _ => Err("an exposure is a number of stops from -30 to 30, or auto".into()),
    }
}

fn one_of<T: Copy, const N: usize>(all: &[(&str, T); N], name: &str) -> Result<T, String> {
    let found = all.iter().find(|(n, _)| *n == name).map(|(_, value)| *value);
    found.ok_or_else(|| format!("there is {}", all.each_ref().map(|(n, _)| *n).join(", ")))
}

fn pose(name: &str) -> Result<Pose, String> {
    one_of(&Pose::ALL, name)
}

fn turn(name: &str) -> Result<Turn, String> {
    one_of(&Turn::ALL, name)
}

fn curve(name: &str) -> Result<Curve, String> {
    one_of(&Curve::ALL, name)
}

fn f_number(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(n) if (1.0..=64.0).contains(&n) => Ok(n),
        _ => Err("an f-number from 1 to 64 is needed".into()),
    }
}

fn counted(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(n) if (1..=50_000_000).contains(&n) => Ok(n),
        _ => Err("a number from 1 to 50000000 is needed".into()),
    }
}

/// Takes the picture or pictures.
pub fn run(args: &Args, console: &Console) -> Result<Code, Failure> {
    let file = scene_file(&args.scene)?;
    let first = args.stones.first().map(String::as_str).or(file.first_cut());
    let called = first.map_or(String::new(), |stone| format!("{}-", stones::file_stem(stone)));
    let ending = if args.frames.is_some() { "gif" } else { "png" };
    let output = args.output.clone().unwrap_or_else(|| format!("{called}{}.{ending}", file.name).into());
    let target = frames::Target::of(&output, args)?;
    let (width, height) = size(args, &file);
    let scene = file.build(&cast(args, console)?, width as f32 / height as f32)?;
    let tone = Tone { curve: args.tone, ..Tone::default() };
    let settings = render::Settings { width, height, rays: args.rays(), round: 0, tone, seed: args.seed };
    let files = frames::take(args, &scene, settings, &target, console)?;
    if console.json {
        console.print_json(&files)?;
    } else if output != Path::new("-") {
        files.iter().for_each(|f| console.note(&format!("wrote {}", f.display())));
    }
    Ok(Code::Done)
}

/// A scene of the catalogue, or a file.
fn scene_file(name: &str) -> Result<SceneFile, Failure> {
    if let Some(file) = scene::preset(name) {
        return Ok(file?);
    }
    let path = Path::new(name);
    if path.extension().is_some_and(|e| e == "toml") || path.exists() {
        return Ok(SceneFile::open(path)?);
    }
    let near = stones::nearest(name, SCENES.iter().map(|(n, _)| *n));
    Err(Failure::input(format!(
        "no scene is called '{name}', the nearest is '{near}' (all: cutlab list scenes), and there is no such file"
    )))
}

fn cast(args: &Args, console: &Console) -> Result<Cast, Failure> {
    let mut designs = Vec::new();
    for spec in &args.stones {
        let imported = stones::open(spec)?;
        imported.warnings.iter().for_each(|w| console.note(&format!("note: {w}")));
        let material = args.substance.of(&imported.design);
        designs.push(stones::sized_for_colour(imported.design, args.size, &material, console)?);
    }
    Ok(Cast {
        designs,
        material: args.substance.asked(),
        size_mm: args.size,
        pose: args.pose,
        polarisation: args.polarisation,
    })
}

/// Width and height; one of them alone keeps the scene's shape.
fn size(args: &Args, file: &SceneFile) -> (u32, u32) {
    let (w, h) = file.picture();
    let scaled = |side: u32, a: u32, b: u32| ((side * a).div_ceil(b)).clamp(1, 16384);
    match (args.width, args.height) {
        (Some(width), Some(height)) => (width, height),
        (Some(width), None) => (width, scaled(width, h, w)),
        (None, Some(height)) => (scaled(height, w, h), height),
        (None, None) => (w, h),
    }
}

/// The photon maps: from the file, or shot.
fn maps(args: &Args, scene: &Scene, console: &Console) -> Result<Maps, Failure> {
    let settings = args.photons();
    let sign = console.spinner("photons");
    let shots = match &args.photon_map {
        None => Shots::shoot(scene, &settings),
        Some(path) => {
            let (shots, read) = file::load_or_shoot(path, scene, &settings)?;
            let did = if read { "used" } else { "made" };
            console.note(&format!("{did} the photon map {}", path.display()));
            shots
        }
    };
    let maps = Maps::new(scene, shots, settings.nearest);
    sign.finish_and_clear();
    Ok(maps)
}

/// The exposure asked for, in stops; none if it is to be found from a picture.
fn stops(args: &Args, scene: &Scene) -> Option<f32> {
    match args.exposure {
        Exposure::Stops(stops) => Some(scene.camera.stops + stops),
        Exposure::Auto => None,
    }
}

/// The exposure found from a small picture.
fn auto_stops(scene: &Scene, maps: &Maps, settings: &render::Settings) -> f32 {
    /// Pixels across of the small picture.
    const ACROSS: u32 = 96;
    let height = (ACROSS * settings.height).div_ceil(settings.width);
    let small = render::Settings { width: ACROSS, height, rays: 4, ..*settings };
    tone::auto_stops(&render::render(scene, &scene.camera, maps, &small, &|| ()))
}
