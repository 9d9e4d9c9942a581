//! `cutlab render`: a photon-mapped picture of a stone, or an animation.

mod background;
mod choices;
mod command;
mod conflicts;
mod frames;
mod options;
mod picture;
mod progress;
mod progressive;
mod remaining_time;
mod target;

use super::args::{scoring, stone};
use super::console::Console;
use super::exit_code::{CliError, ExitStatus};
use super::outputs::Outputs;
use crate::cli::limits::limits;
use crate::integrators::{self, Tone, ToneCurve};
use crate::parse;
use crate::scene::{self, SCENES, SceneFile, SceneOverrides};
use crate::storage::atomic_write;
pub use options::RenderArgs;
use std::ffi::{OsStr, OsString};
use std::path::Path;

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
        files.iter().for_each(|f| console.note(&format!("wrote {}", stone::display_name(f))));
    }
    Ok(ExitStatus::Done)
}

/// A name that tells the stones with their parameters, what they are made of, their size and the scene:
/// pictures of different things have different names.
fn default_name(args: &RenderArgs, file: &SceneFile) -> OsString {
    let first = args.stones.is_empty().then(|| file.first_cut()).flatten();
    let stones = args.stones.iter().map(OsString::as_os_str).chain(first.map(OsStr::new));
    let mut parts: Vec<OsString> = stones.map(stone_name).collect();
    parts.extend(args.substance.material.map(|m| m.name.as_ref().into()));
    parts.extend(args.substance.ri.map(|n| format!("n{n}").into()));
    parts.extend(args.size.map(|mm| format!("{mm}mm").into()));
    parts.push(file.name.clone().into());
    let mut name = parts.join(OsStr::new("-"));
    name.push(if args.frames.is_some() { ".gif" } else { ".png" });
    name
}

/// `round-brilliant:table=60` as `round-brilliant-table60`, `D.asc:material=topaz` as `D-materialtopaz`.
fn stone_name(spec: &OsStr) -> OsString {
    let text = spec.to_str().filter(|_| stone::is_cut(spec));
    let parameters = text.and_then(|text| text.split_once(':')).map(|(_, rest)| rest.to_owned());
    let of_file =
        || stone::StoneSpec::parse(spec).map_or_else(|_| String::new(), |spec| spec.own().join(","));
    let given = parameters.unwrap_or_else(of_file);
    let fit = |c: char| c.is_alphanumeric() || c == '.' || c == '-';
    let told = given.split(',').map(|p| p.chars().filter(|c| fit(*c)).collect::<String>());
    let told = told.filter(|p| !p.is_empty()).map(OsString::from);
    std::iter::once(stone::file_stem(spec)).chain(told).collect::<Vec<_>>().join(OsStr::new("-"))
}

/// A scene of the catalogue, or a file.
fn scene_file(name: &OsStr) -> Result<SceneFile, CliError> {
    if let Some(file) = name.to_str().and_then(scene::preset) {
        return Ok(file?);
    }
    let path = Path::new(name);
    if path.extension().is_some_and(|e| e == "toml") || path.exists() {
        return Ok(SceneFile::open(path, limits())?);
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
        limits: limits(),
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
