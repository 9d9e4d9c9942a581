//! `cutlab render`: a photon-mapped picture of a stone.

use super::console::Console;
use super::outcome::{Code, Failure};
use super::stones;
use crate::optics::dispersion::VISIBLE_UM;
use crate::photons::{self, Shots, file};
use crate::render::{self, Maps, Pass, tone};
use crate::scene::{Pose, Preset, SCENES, Scene};
use crate::store::replace;
use crate::walk::Stone;
use std::path::{Path, PathBuf};

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab render                                   the default brilliant on the table
  cutlab render octahedron --scene cornell --passes
  cutlab render stone.asc --material quartz --photon-map stone.map --frames 36 -o turn.png")]
pub struct Args {
    /// The stone; without it the scene's own (round-brilliant on the table, octahedron in the room)
    stone: Option<String>,
    /// What is around it: see `cutlab list scenes`
    #[arg(long, default_value = "table", value_parser = preset)]
    scene: &'static Preset,
    #[command(flatten)]
    substance: stones::Substance,
    /// Girdle width in millimetres; the colour depends on it
    #[arg(long, value_name = "MM", value_parser = stones::millimetres)]
    size: Option<f64>,
    /// How it stands: lying (as a loose stone comes to rest) or table-up; the scene has a default
    #[arg(long, value_parser = pose)]
    pose: Option<Pose>,
    /// Where to write the PNG; frames and passes add to the name
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Pixels across; the scene has a default
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=16384))]
    width: Option<u32>,
    /// Pixels down; the scene has a default
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=16384))]
    height: Option<u32>,
    /// Camera rays a pixel; square numbers spread best
    #[arg(long, default_value_t = 25, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    spp: u32,
    /// Seed of all random numbers
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Photons in each map
    #[arg(long, default_value_t = 100_000, value_parser = counted)]
    photons: usize,
    /// Photons that an estimate gathers
    #[arg(long, default_value_t = 500, value_parser = counted)]
    nearest: usize,
    /// Keep the photons in this file and use them again for other views
    #[arg(long, value_name = "FILE")]
    photon_map: Option<PathBuf>,
    /// Also write the direct, caustic and indirect passes, of which the picture is the sum
    #[arg(long)]
    passes: bool,
    /// Go around the stone in this many pictures, numbered from 000
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    frames: Option<u32>,
    /// Whether light keeps its polarisation from facet to facet; off takes it as unpolarised at each
    #[arg(long, value_name = "on|off", default_value = "on", value_parser = stones::on_off, action = clap::ArgAction::Set)]
    polarisation: bool,
    /// Exposure in stops
    #[arg(long, default_value_t = 0.0, allow_negative_numbers = true)]
    exposure: f32,
}

fn preset(name: &str) -> Result<&'static Preset, String> {
    Preset::named(name).ok_or_else(|| {
        let near = stones::nearest(name, SCENES.iter().map(|p| p.name));
        format!("no scene is called '{name}', the nearest is '{near}' (all: cutlab list scenes)")
    })
}

fn pose(name: &str) -> Result<Pose, String> {
    let known = Pose::ALL.iter().find(|(n, _)| *n == name).map(|(_, pose)| *pose);
    known.ok_or_else(|| format!("a stone can stand {}", Pose::ALL.map(|(n, _)| n).join(" or ")))
}

fn counted(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(n) if (1..=50_000_000).contains(&n) => Ok(n),
        _ => Err("a number from 1 to 50000000 is needed".into()),
    }
}

/// Takes the picture or pictures.
pub fn run(args: &Args, console: &Console) -> Result<Code, Failure> {
    let spec = args.stone.as_deref().unwrap_or(args.scene.default_stone);
    let output = args
        .output
        .clone()
        .unwrap_or_else(|| format!("{}-{}.png", stones::file_stem(spec), args.scene.name).into());
    check_name(&output, args)?;
    let imported = stones::open(spec)?;
    imported.warnings.iter().for_each(|w| console.note(&format!("note: {w}")));
    let material = args.substance.of(&imported.design);
    args.substance.note_range(VISIBLE_UM.0, VISIBLE_UM.1, console);
    let design = stones::sized_for_colour(imported.design, args.size, &material, console)?;
    let stone = Stone::new(design.solid()?);
    let pose = args.pose.unwrap_or(args.scene.default_pose);
    let (width, height) =
        (args.width.unwrap_or(args.scene.default_size.0), args.height.unwrap_or(args.scene.default_size.1));
    let aspect = width as f32 / height as f32;
    let mut scene = (args.scene.build)(stone, material, pose, aspect);
    scene.stone.polarised = args.polarisation;
    let maps = maps(args, &scene, console)?;

    let frames = args.frames.unwrap_or(1);
    let bar = console.progress((frames * height) as usize, "rendering");
    let mut files = Vec::new();
    for frame in 0..frames {
        let camera = scene.camera.turned(360.0 * frame as f32 / frames as f32);
        let settings = render::Settings { width, height, rays: args.spp, seed: args.seed };
        let film = render::render(&scene, &camera, &maps, &settings, &|| bar.inc(1));
        let number = args.frames.map(|_| frame);
        let passes = Pass::ALL.iter().filter(|_| args.passes).map(|(pass, name)| (Some(*pass), Some(*name)));
        for (pass, name) in passes.chain([(None, None)]) {
            let path = file_name(&output, number, name);
            let png = tone::png(&film, pass, args.exposure).map_err(|e| Failure::input(e.to_string()))?;
            replace::write(&path, &png)?;
            files.push(path);
        }
    }
    bar.finish_and_clear();
    if console.json {
        console.print_json(&files)?;
    } else if output != Path::new("-") {
        files.iter().for_each(|f| console.note(&format!("wrote {}", f.display())));
    }
    Ok(Code::Done)
}

/// A PNG is what can be written; one picture is what fits on standard output.
fn check_name(output: &Path, args: &Args) -> Result<(), Failure> {
    if output == Path::new("-") {
        return match args.passes || args.frames.is_some() {
            true => Err(Failure::input("several pictures cannot go to standard output: name a file with -o")),
            false => Ok(()),
        };
    }
    match output.extension().and_then(|e| e.to_str()) {
        Some(e) if e.eq_ignore_ascii_case("png") => Ok(()),
        _ => Err(Failure::input(format!("{}: pictures are PNG, name the file so", output.display()))),
    }
}

/// The photon maps: from the file, or shot.
fn maps(args: &Args, scene: &Scene, console: &Console) -> Result<Maps, Failure> {
    let settings = photons::Settings { photons: args.photons, nearest: args.nearest, seed: args.seed };
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
    let maps = Maps::new(scene, &shots, settings.nearest);
    sign.finish_and_clear();
    Ok(maps)
}

/// `turn.png` with frame 7 of the caustic pass: `turn-007-caustic.png`.
fn file_name(output: &Path, frame: Option<u32>, pass: Option<&str>) -> PathBuf {
    if frame.is_none() && pass.is_none() {
        return output.to_owned();
    }
    let mut name = output.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    if let Some(frame) = frame {
        name += &format!("-{frame:03}");
    }
    if let Some(pass) = pass {
        name += &format!("-{pass}");
    }
    output.with_file_name(name + ".png")
}
