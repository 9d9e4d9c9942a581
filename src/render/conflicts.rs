//! Wishes of a request that cannot go together, or have no effect: told before any work.

use super::background::Background;
use super::picture_kind::PictureKind;
use super::request::RenderRequest;
use super::target::OutputTarget;
use crate::integrators::animation::Turn;
use crate::scene::SceneFile;
use std::path::Path;

/// Most frames of a GIF in a second: viewers slow down what is faster.
const GIF_FPS: u32 = 50;

/// The first problem, in one sentence with what to do.
///
/// - `photon_map`: the file that photons are kept in
pub fn first(
    request: &RenderRequest,
    target: &OutputTarget,
    photon_map: Option<&Path>,
    scene: &SceneFile,
) -> Option<String> {
    of_animation(request, target, photon_map)
        .or_else(|| of_kind(request, target))
        .or_else(|| of_scene(request, target, photon_map, scene))
}

fn of_animation(request: &RenderRequest, target: &OutputTarget, photon_map: Option<&Path>) -> Option<String> {
    let animation = request.animation.as_ref()?;
    let moved = match animation.turn {
        Turn::Camera => None,
        Turn::Stone => Some("--turn stone moves the stones"),
        Turn::Light => Some("--turn light moves the lights"),
        Turn::All => Some("--turn all moves the stones"),
    };
    if let (Some(moved), Some(_)) = (moved, photon_map) {
        return Some(format!(
            "--photon-map keeps the light of stones and lights that stand still, but {moved} from frame to frame: leave one of them out"
        ));
    }
    let fps = animation.fps?;
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

fn of_kind(request: &RenderRequest, target: &OutputTarget) -> Option<String> {
    let kind = target.kind();
    let name = kind.name();
    let in_vain = [
        ("--exposure", request.exposure.is_some()),
        ("--tone", request.tone.is_some()),
        ("--glare", request.glare.is_some()),
        ("--bits", request.bits.is_some()),
    ];
    if let (PictureKind::Exr, Some((option, _))) = (kind, in_vain.iter().find(|(_, given)| *given)) {
        return Some(format!("{option} has no effect on an EXR, which holds linear light: leave it out"));
    }
    if request.bits == Some(16) && !matches!(kind, PictureKind::Png | PictureKind::Numbered) {
        return Some(format!("{name} has 8 bits a channel: --bits 16 needs a PNG"));
    }
    match request.background {
        Some(Background::Colour(_)) if kind == PictureKind::Exr => {
            Some("an EXR keeps linear light with its coverage: --background transparent".into())
        }
        Some(Background::Transparent) if !kind.has_alpha() => Some(format!(
            "{name} has no transparency: name a .png, .webp, .exr or .apng, or --background white"
        )),
        _ => None,
    }
}

fn of_scene(
    request: &RenderRequest,
    target: &OutputTarget,
    photon_map: Option<&Path>,
    scene: &SceneFile,
) -> Option<String> {
    if request.panorama.is_some() && !scene.has_panorama() {
        return Some(format!(
            "--hdr has no effect: the scene '{}' is not lit by a panorama, as 'daylight' is",
            scene.name
        ));
    }
    if photon_map == Some(target.path()) {
        return Some(
            "--photon-map and -o are two outputs in one file: give the picture a name of its own".into(),
        );
    }
    let of_stones = [
        ("--material", request.options.material.is_some()),
        ("--ri", request.options.ri.is_some()),
        ("--size", request.options.size_mm.is_some()),
        ("--pose", request.pose.is_some()),
        ("--polarisation", request.polarised.is_some()),
        ("--turn stone", request.turn() == Turn::Stone),
    ];
    let (option, _) = of_stones.iter().find(|(_, given)| *given)?;
    (scene.stone_count() == 0)
        .then(|| format!("{option} has no effect: the scene '{}' has no stone", scene.name))
}
