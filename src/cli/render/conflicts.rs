//! Options of `cutlab render` that cannot go together, or have no effect: told before any work.

use super::RenderArgs;
use super::background::Background;
use super::target::{OutputTarget, PictureKind};
use crate::integrators::animation::Turn;
use crate::scene::SceneFile;

/// Most frames of a GIF in a second: viewers slow down what is faster.
const GIF_FPS: u32 = 50;

/// The first problem, in one sentence with what to do.
pub fn first(args: &RenderArgs, target: &OutputTarget, scene: &SceneFile) -> Option<String> {
    let all = [of_glare(args), of_animation(args, target), of_kind(args, target), of_scene(args, scene)];
    all.into_iter().flatten().next()
}

/// `--glare 8`: the number counts as a STONE.
fn of_glare(args: &RenderArgs) -> Option<String> {
    let number = args.stones.iter().filter_map(|s| s.to_str()).find(|s| s.parse::<f32>().is_ok())?;
    args.glare.is_some().then(|| format!("--glare takes its number after '=': --glare={number}"))
}

fn of_animation(args: &RenderArgs, target: &OutputTarget) -> Option<String> {
    let moved = match args.turn {
        Turn::Camera => None,
        Turn::Stone => Some("--turn stone moves the stones"),
        Turn::Light => Some("--turn light moves the lights"),
        Turn::All => Some("--turn all moves the stones"),
    };
    if let (Some(moved), Some(_), Some(_)) = (moved, args.frames, &args.photon_map) {
        return Some(format!(
            "--photon-map keeps the light of stones and lights that stand still, but {moved} from frame to frame: leave one of them out"
        ));
    }
    let fps = args.fps?;
    match target.kind() {
        PictureKind::Numbered => {
            Some("numbered pictures have no --fps: the program that joins them sets it".into())
        }
        PictureKind::Gif if fps > GIF_FPS => {
            Some(format!("a GIF shows at most {GIF_FPS} frames a second: --fps {GIF_FPS}, or -o name.mp4"))
        }
        _ => None,
    }
}

fn of_kind(args: &RenderArgs, target: &OutputTarget) -> Option<String> {
    let kind = target.kind();
    let name = kind.name();
    let in_vain = [
        ("--exposure", args.exposure.is_some()),
        ("--tone", args.tone.is_some()),
        ("--glare", args.glare.is_some()),
        ("--bits", args.bits.is_some()),
    ];
    if let (PictureKind::Exr, Some((option, _))) = (kind, in_vain.iter().find(|(_, given)| *given)) {
        return Some(format!("{option} has no effect on an EXR, which holds linear light: leave it out"));
    }
    let deep = args.bits.as_deref() == Some("16");
    if deep && !matches!(kind, PictureKind::Png | PictureKind::Numbered) {
        return Some(format!("{name} has 8 bits a channel: --bits 16 needs a PNG"));
    }
    match args.background {
        Some(Background::Colour(_)) if kind == PictureKind::Exr => {
            Some("an EXR keeps linear light with its coverage: --background transparent".into())
        }
        Some(Background::Transparent) if !kind.has_alpha() => Some(format!(
            "{name} has no transparency: name a .png, .webp, .exr or .apng, or --background white"
        )),
        _ => None,
    }
}

fn of_scene(args: &RenderArgs, scene: &SceneFile) -> Option<String> {
    if args.hdr.is_some() && !scene.has_panorama() {
        return Some(format!(
            "--hdr has no effect: the scene '{}' is not lit by a panorama, as 'daylight' is",
            scene.name
        ));
    }
    if args.photon_map.is_some() && args.photon_map == args.output {
        return Some(
            "--photon-map and -o are two outputs in one file: give the picture a name of its own".into(),
        );
    }
    let of_stones = [
        ("--material", args.stone_args.material.is_some()),
        ("--ri", args.stone_args.ri.is_some()),
        ("--size", args.size.is_some()),
        ("--pose", args.pose.is_some()),
        ("--polarisation", args.polarisation.is_some()),
        ("--turn stone", args.turn == Turn::Stone),
    ];
    let (option, _) = of_stones.iter().find(|(_, given)| *given)?;
    (scene.stone_count() == 0)
        .then(|| format!("{option} has no effect: the scene '{}' has no stone", scene.name))
}
