//! `cutlab render`: a photon-mapped picture of a stone, or an animation.

mod background;
mod choices;
mod command;
mod conflicts;
mod frames;
mod picture;
mod progressive;
mod remaining_time;
mod target;

use super::args::{scoring, stone, values};
use super::console::Console;
use super::exit_code::{CliError, ExitStatus};
use super::outputs::Outputs;
use crate::integrators::animation::Turn;
use crate::integrators::{self, Tone, ToneCurve};
use crate::parse;
use crate::photons;
use crate::scene::{self, Pose, SCENES, SceneFile, SceneOverrides};
use crate::storage::atomic_write;
use background::Background;
use choices::Exposure;
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab render                                   the default brilliant on the table
  cutlab render octahedron --scene cornell --passes
  cutlab render tolkowsky --scene my-scene.toml -o picture.exr
  cutlab render stone.asc --material quartz --photon-map stone.map --frames 36 -o turn.gif
  cutlab render --scene spot --turn stone --rock --frames 24 -o fire-%03d.png
  cutlab render --scene studio --turn all --frames 120 --fps 30 -o turn.mp4
  cutlab render --scene studio --background transparent -o stone.png
  cutlab render --scene daylight --hdr garden.hdr --exposure auto
  cutlab render --scene table --progressive --time 10min -o clean.exr
  cutlab list scenes studio > my-scene.toml       a scene to change")]
pub struct RenderArgs {
    /// The stones, for the scene's places in order; without them the scene's own
    #[arg(value_name = "STONE")]
    stones: Vec<OsString>,
    /// What is around it: a name of `cutlab list scenes`, or a TOML file
    #[arg(long, default_value = "table", value_name = "NAME|FILE")]
    scene: OsString,
    /// Let a scene file name stones, meshes and panoramas outside its own folder
    #[arg(long)]
    allow_outside: bool,
    /// The panorama (.hdr, .exr) of a scene that is lit by one, such as daylight
    #[arg(long, value_name = "FILE")]
    hdr: Option<PathBuf>,
    #[command(flatten)]
    substance: stone::MaterialArgs,
    /// Girdle width in millimetres
    #[arg(long, value_name = "MM", value_parser = stone::millimetres)]
    size: Option<f64>,
    /// How it stands: lying (as a loose stone comes to rest), table-up or table-down; the scene has a
    /// default
    #[arg(long, value_parser = choices::pose)]
    pose: Option<Pose>,
    /// Where to write: .png, .jpg, .webp, .exr (linear, with all passes); an animation to .mp4, .gif,
    /// .apng, or to numbered pictures such as turn-%03d.png
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Pixels across; the scene has a default
    #[arg(long, value_parser = values::whole_number(1..=scene::scene_file::MOST_PIXELS, "a width is a whole number of pixels"))]
    width: Option<u32>,
    /// Pixels down; the scene has a default
    #[arg(long, value_parser = values::whole_number(1..=scene::scene_file::MOST_PIXELS, "a height is a whole number of pixels"))]
    height: Option<u32>,
    /// Camera rays a pixel: 25, or 1 in each round of --progressive
    #[arg(long, value_parser = values::whole_number(1..=1_000_000, "camera rays are a whole number"))]
    spp: Option<u32>,
    /// Seed of all random numbers
    #[arg(long, default_value_t = 1, value_parser = values::seed)]
    seed: u64,
    #[command(flatten)]
    stops: progressive::StopArgs,
    /// Photons in each map
    #[arg(long, default_value_t = 100_000, value_parser = choices::counted)]
    photons: usize,
    /// Photons over whose distance each spreads its light
    #[arg(long, default_value_t = 500, value_parser = choices::counted)]
    nearest: usize,
    /// Keep the photons in this file and use them again for other views; of an animation only where the
    /// camera alone moves
    #[arg(long, value_name = "FILE")]
    photon_map: Option<PathBuf>,
    /// Also write the direct, caustic, indirect and stone passes, of which the picture is the sum
    #[arg(long)]
    passes: bool,
    /// An animation of this many pictures
    #[arg(long, value_name = "N", value_parser = values::whole_number(1..=100_000, "an animation has a whole number of pictures"))]
    frames: Option<u32>,
    /// Frames a second [so many that a turn takes 3 to 6 seconds]
    #[arg(long, value_name = "N", requires = "frames", value_parser = values::whole_number(1..=120, "frames a second are a whole number"))]
    fps: Option<u32>,
    /// What turns in an animation: camera, stone, light, or all (stones and meshes as one piece)
    #[arg(long, default_value = "camera", requires = "frames", value_parser = choices::turn)]
    turn: Turn,
    /// Rock it by 15° to and fro instead of all the way around
    #[arg(long, requires = "frames")]
    rock: bool,
    /// What is behind the stones in place of the scene's floor, walls, sky and lamps: transparent (in a
    /// .png, .webp, .exr or .apng), white, black, or a colour as '#1e90ff'. Stones mirror and refract the
    /// scene as ever
    #[arg(long, value_name = "COLOUR|transparent", value_parser = background::parse)]
    background: Option<Background>,
    /// Exposure in stops beside the scene's own, or auto [0]
    #[arg(long, allow_negative_numbers = true, value_parser = choices::exposure, value_name = "STOPS|auto")]
    exposure: Option<Exposure>,
    /// Tone curve, which acts on luminance and keeps the hue: filmic, straight up to .6, then
    /// .6 + .4 (1 - e^(-(x - .6)/.4)), or linear, which ends at white [filmic; linear for viewers]
    #[arg(long, value_parser = choices::curve)]
    tone: Option<ToneCurve>,
    /// Let what is beyond white shine out in stars, as an iris of six blades does at this f-number; an
    /// EXR and the passes stay without [16 if given without a number]
    #[arg(long, value_name = "F", num_args = 0..=1, require_equals = true, default_missing_value = "16", value_parser = choices::f_number)]
    glare: Option<f32>,
    /// Bits a channel of a PNG: 8 or 16 [8]
    #[arg(long, value_parser = ["8", "16"])]
    bits: Option<String>,
    /// Whether light keeps its polarisation from facet to facet; off takes it as unpolarised at each.
    /// On, unless the scene says
    #[arg(long, value_name = "on|off", value_parser = stone::on_off)]
    polarisation: Option<bool>,
}

impl RenderArgs {
    fn rays(&self) -> u32 {
        self.spp.unwrap_or(if self.stops.progressive { 1 } else { 25 })
    }

    fn photons(&self) -> photons::PhotonSettings {
        photons::PhotonSettings { photons: self.photons, nearest: self.nearest, seed: self.seed }
    }
}

/// Takes the picture or pictures.
pub fn run(args: &RenderArgs, console: &Console) -> Result<ExitStatus, CliError> {
    let file = scene_file(&args.scene)?;
    let output = args.output.clone().unwrap_or_else(|| default_name(args, &file).into());
    let target = target::OutputTarget::new(&output, args)?;
    if let Some(problem) = conflicts::first(args, &target, &file) {
        return Err(CliError::input(problem));
    }
    let (width, height) = target.size(args, &file)?;
    let mut outputs = Outputs::reading_stones(&args.stones, console);
    outputs.reads(Path::new(&args.scene));
    file.files().iter().chain(&args.hdr).for_each(|read| outputs.reads(read));
    target.claim(args, &mut outputs)?;
    let scene = file.build(&scene_overrides(args, console)?, width as f32 / height as f32)?;
    let curve = args.tone.unwrap_or(if scene.camera.flat { ToneCurve::Linear } else { ToneCurve::Filmic });
    let tone = Tone { curve, ..Tone::default() };
    let settings = integrators::RenderSettings {
        width,
        height,
        samples_per_pixel: args.rays(),
        round: 0,
        tone,
        seed: args.seed,
    };
    let files = frames::render(args, &scene, settings, &target, console)?;
    if atomic_write::is_stdout(&output) {
        return Ok(ExitStatus::Done); // the picture is the whole of what standard output gets
    }
    if console.json {
        console.print_json(&files.iter().map(stone::display_name).collect::<Vec<_>>())?;
    } else {
        files.iter().for_each(|f| console.note(&format!("wrote {}", stone::display_name(&f))));
    }
    Ok(ExitStatus::Done)
}

/// A name that tells the stones with their parameters, what they are made of, their size and the scene:
/// pictures of different things have different names.
fn default_name(args: &RenderArgs, file: &SceneFile) -> String {
    let first = args.stones.is_empty().then(|| file.first_cut()).flatten();
    let stones = args.stones.iter().map(OsString::as_os_str).chain(first.map(OsStr::new));
    let mut parts: Vec<String> = stones.map(stone_name).collect();
    parts.extend(args.substance.material.map(|m| m.name.to_string()));
    parts.extend(args.substance.ri.map(|n| format!("n{n}")));
    parts.extend(args.size.map(|mm| format!("{mm}mm")));
    parts.push(file.name.clone());
    parts.push(if args.frames.is_some() { "gif" } else { "png" }.into());
    let extension = parts.pop().unwrap_or_default();
    format!("{}.{extension}", parts.join("-"))
}

/// `round-brilliant:table=60` as `round-brilliant-table60`.
fn stone_name(spec: &OsStr) -> String {
    let text = spec.to_str().filter(|_| stone::is_cut(spec));
    let parameters = text.and_then(|text| text.split_once(':')).map(|(_, rest)| rest);
    let given = parameters.unwrap_or_default().split(',').map(str::trim).filter(|p| !p.is_empty());
    let fit = |c: char| if c.is_alphanumeric() || c == '.' || c == '-' { Some(c) } else { None };
    let told = given.map(|p| p.chars().filter_map(fit).collect::<String>());
    std::iter::once(stone::display_name(stone::file_stem(spec))).chain(told).collect::<Vec<_>>().join("-")
}

/// A scene of the catalogue, or a file.
fn scene_file(name: &OsStr) -> Result<SceneFile, CliError> {
    if let Some(file) = name.to_str().and_then(scene::preset) {
        return Ok(file?);
    }
    let path = Path::new(name);
    if path.extension().is_some_and(|e| e == "toml") || path.exists() {
        return Ok(SceneFile::open(path)?);
    }
    let name = stone::display_name(name);
    let near = parse::did_you_mean(parse::nearest_name(&name, SCENES.iter().map(|(n, _)| *n)));
    Err(CliError::input(format!(
        "no scene and no file is called '{name}'{near} (all scenes: cutlab list scenes)"
    )))
}

fn scene_overrides(args: &RenderArgs, console: &Console) -> Result<SceneOverrides, CliError> {
    let (mut designs, mut materials) = (Vec::new(), Vec::new());
    for spec in &args.stones {
        let imported = stone::open(spec)?;
        imported.warnings.iter().for_each(|w| console.note(&format!("note: {w}")));
        let substance = args.substance.within(spec)?;
        let material = substance.material_of(&imported.design);
        if substance.asked().is_none() && material.bare_index().is_some() {
            let why = material.no_dispersion();
            scoring::once(
                &format!("{}: a picture without fire and colour, for {why}", stone::display_name(spec)),
                &why,
                console,
            );
        }
        materials.push(substance.asked());
        designs.push(stone::sized_for_colour(imported.design, args.size, &material, console)?);
    }
    Ok(SceneOverrides {
        designs,
        materials,
        material: args.substance.asked(),
        size_mm: args.size,
        pose: args.pose,
        polarisation: args.polarisation,
        panorama: args.hdr.clone(),
        allow_outside: args.allow_outside,
        cut_out: args.background.is_some(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_tell_parameters() {
        assert_eq!(stone_name(OsStr::new("round-brilliant")), "round-brilliant");
        assert_eq!(
            stone_name(OsStr::new("round-brilliant:table=60, crown-angle=34.5")),
            "round-brilliant-table60-crown-angle34.5"
        );
        // a file's own name is no parameter: all of it tells
        assert_eq!(stone_name(OsStr::new("designs/my:stone=1.asc")), "my:stone=1");
    }
}
