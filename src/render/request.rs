//! A request for a picture or an animation: everything that it follows from, beside what files hold.

use super::background::Background;
use super::error::RenderError;
use super::picture_kind::PictureKind;
use crate::integrators::animation::Turn;
use crate::integrators::{RenderSettings, Tone, ToneCurve, mp4};
use crate::limits::Limits;
use crate::parse;
use crate::photons::PhotonSettings;
use crate::scene::scene_file::MOST_PIXELS;
use crate::scene::{self, Pose, SCENES, Scene, SceneFile, SceneOverrides};
use crate::stone::{Stone, StoneOptions};
use serde::{Deserialize, Serialize};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// A request for a picture, or for an animation.
///
/// Fields that are none are as the scene has them. As JSON every field may be left out.
///
/// ```no_run
/// use cutlab::advanced::render::RenderRequest;
/// use cutlab::advanced::stone::Stone;
///
/// let stone = Stone::parse("round-brilliant")?;
/// RenderRequest::scene("table")?.stone(&stone).run()?.save("brilliant.png")?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[non_exhaustive]
pub struct RenderRequest {
    /// The stones as they are named, for the scene's places in order; without them the scene's own.
    pub stones: Vec<String>,
    /// What they are made of, how large they are and how they stand.
    pub options: StoneOptions,
    /// A scene of the catalogue by name, or a TOML file.
    pub scene: String,
    /// Whether a scene file may name files outside its own folder.
    pub allow_outside: bool,
    /// The panorama in place of the scene's.
    pub panorama: Option<PathBuf>,
    /// How the stones stand in the scene.
    pub pose: Option<Pose>,
    /// Pixels across.
    pub width: Option<u32>,
    /// Pixels down.
    pub height: Option<u32>,
    /// Camera rays a pixel; none for 25, or for 1 in each round of a progressive picture.
    pub samples_per_pixel: Option<u32>,
    /// Seed of all random numbers.
    pub seed: u64,
    /// Photons in each map.
    pub photons: usize,
    /// Photons over whose distance each spreads its light.
    pub nearest: usize,
    /// When a progressive picture ends; none for a picture of one round.
    pub progressive: Option<StopRequest>,
    /// What moves in an animation; none for one picture.
    pub animation: Option<AnimationRequest>,
    /// What is behind the stones in place of the scene's surroundings.
    pub background: Option<Background>,
    /// Exposure beside the scene's own.
    pub exposure: Option<Exposure>,
    /// The tone curve; none for filmic, or linear in viewers.
    pub tone: Option<ToneCurve>,
    /// The f-number of the iris whose star is added to what is beyond white.
    pub glare: Option<f32>,
    /// Bits a channel of a PNG, 8 or 16; none for 8.
    pub bits: Option<u8>,
    /// Whether light keeps its polarisation from facet to facet.
    pub polarised: Option<bool>,
    /// Stones that are opened already, in place of those that are named.
    #[serde(skip)]
    pub opened: Vec<Stone>,
}

/// When a progressive picture is good enough; the first that is reached counts. Without any it ends at 2 % of noise,
/// or after 100 rounds.
///
/// ```
/// use cutlab::{RenderRequest, StopRequest};
///
/// let request = RenderRequest::default().progressive(StopRequest::default().rounds(8));
/// assert_eq!(request.progressive.unwrap().rounds, Some(8));
/// ```
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[non_exhaustive]
pub struct StopRequest {
    /// After so many rounds.
    pub rounds: Option<u32>,
    /// After the round that ends past this time.
    pub time: Option<Duration>,
    /// When 4×4 pixels are off by this share of the mean on average.
    pub noise: Option<f64>,
}

/// What moves in an animation.
///
/// ```
/// use cutlab::{AnimationRequest, RenderRequest, Turn};
///
/// let animation = AnimationRequest::new(36).turn(Turn::Stone).rock(true);
/// let request = RenderRequest::default().animation(animation);
/// assert_eq!(request.turn(), Turn::Stone);
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct AnimationRequest {
    /// Number of pictures.
    pub frames: u32,
    /// What turns.
    #[serde(default)]
    pub turn: Turn,
    /// Whether it is rocked to and fro instead of turned all the way around.
    #[serde(default)]
    pub rock: bool,
    /// Frames a second; none for so many that a turn takes 3 to 6 seconds.
    #[serde(default)]
    pub fps: Option<u32>,
}

/// Exposure of a picture.
///
/// ```
/// use cutlab::{Exposure, RenderRequest};
///
/// let brighter = RenderRequest::scene("studio")?.exposure(Exposure::Stops(1.0));
/// assert_eq!(serde_json::to_value(&brighter.exposure).unwrap()["stops"], 1.0);
/// # Ok::<(), cutlab::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Exposure {
    /// Found from the picture.
    Auto,
    /// In stops beside the scene's own.
    Stops(f32),
}

impl Default for RenderRequest {
    /// The default brilliant on the table, 25 camera rays a pixel, 100,000 photons in each map.
    fn default() -> RenderRequest {
        RenderRequest {
            stones: Vec::new(),
            options: StoneOptions::default(),
            scene: "table".into(),
            allow_outside: false,
            panorama: None,
            pose: None,
            width: None,
            height: None,
            samples_per_pixel: None,
            seed: 1,
            photons: 100_000,
            nearest: 500,
            progressive: None,
            animation: None,
            background: None,
            exposure: None,
            tone: None,
            glare: None,
            bits: None,
            polarised: None,
            opened: Vec::new(),
        }
    }
}

impl RenderRequest {
    /// Of a scene of the catalogue by name, or of a TOML file; an error if there is none.
    pub fn scene(name: impl Into<String>) -> Result<RenderRequest, RenderError> {
        let request = RenderRequest { scene: name.into(), ..RenderRequest::default() };
        request.scene_file().map(|_| request)
    }

    /// The scene, read but not built.
    pub fn scene_file(&self) -> Result<SceneFile, RenderError> {
        open_scene(OsStr::new(&self.scene), self.options.limits)
    }

    /// The stones, opened.
    pub fn open_stones(&self) -> Result<Vec<Stone>, RenderError> {
        if !self.opened.is_empty() {
            return Ok(self.opened.clone());
        }
        let open = |spec: &String| Ok(Stone::open(spec, &self.options)?.with_width_for_colour()?);
        self.stones.iter().map(open).collect()
    }

    /// The scene with its stones, for a picture of a shape.
    pub fn build(&self, file: &SceneFile, (width, height): (u32, u32)) -> Result<Scene, RenderError> {
        let stones = self.open_stones()?;
        let designs = stones.iter().map(|s| s.convex_design().cloned()).collect::<Result<_, _>>()?;
        let overrides = SceneOverrides {
            designs,
            materials: stones.iter().map(|s| s.given_material().cloned()).collect(),
            material: self.options.asked_material().map_err(RenderError::Request)?,
            size_mm: self.options.size_mm,
            pose: self.pose,
            polarisation: self.polarised,
            panorama: self.panorama.clone(),
            allow_outside: self.allow_outside,
            cut_out: self.background.is_some(),
            limits: self.options.limits,
        };
        Ok(file.build(&overrides, width as f32 / height as f32)?)
    }

    /// Width and height; one of them alone keeps the scene's shape. Those of an MP4 are even.
    pub fn picture_size(&self, file: &SceneFile, kind: PictureKind) -> Result<(u32, u32), RenderError> {
        let (w, h) = file.picture();
        let scaled = |side: u32, a: u32, b: u32| {
            (u64::from(side) * u64::from(a)).div_ceil(u64::from(b)).clamp(1, u64::from(MOST_PIXELS)) as u32
        };
        let (width, height) = match (self.width, self.height) {
            (Some(width), Some(height)) => (width, height),
            (Some(width), None) => (width, scaled(width, h, w)),
            (None, Some(height)) => (scaled(height, w, h), height),
            (None, None) => (w, h),
        };
        let sides = 1..=MOST_PIXELS;
        if !sides.contains(&width) || !sides.contains(&height) {
            return Err(RenderError::Request(format!(
                "a picture has from 1 to {MOST_PIXELS} pixels on each side, not {width}×{height}"
            )));
        }
        if kind != PictureKind::Mp4 {
            return Ok((width, height));
        }
        for (option, given) in [("--width", self.width), ("--height", self.height)] {
            if let Some(odd) = given.filter(|n| n % 2 == 1) {
                let even = odd + 1;
                return Err(RenderError::Request(format!("an MP4 has even sides: {option} {even}")));
            }
        }
        let (width, height) = (width.next_multiple_of(2), height.next_multiple_of(2));
        let fits = mp4::SIDES.contains(&width) && mp4::SIDES.contains(&height);
        if !fits || width.min(height) > mp4::SHORTER_SIDE {
            return Err(RenderError::Request(format!(
                "an MP4 is from {0}×{0} to {1}×{2} pixels, not {width}×{height}: --width and --height set it",
                mp4::SIDES.start(),
                mp4::SIDES.end(),
                mp4::SHORTER_SIDE
            )));
        }
        Ok((width, height))
    }

    /// Settings of the integrators, with the tone curve but before exposure.
    pub fn settings(&self, scene: &Scene, (width, height): (u32, u32)) -> RenderSettings {
        let flat = scene.camera.flat;
        let curve = self.tone.unwrap_or(if flat { ToneCurve::Linear } else { ToneCurve::Filmic });
        let usual = if self.progressive.is_some() { 1 } else { 25 };
        RenderSettings {
            width,
            height,
            samples_per_pixel: self.samples_per_pixel.unwrap_or(usual),
            round: 0,
            tone: Tone { curve, ..Tone::default() },
            seed: self.seed,
        }
    }

    /// Settings of the photon maps.
    pub fn photon_settings(&self) -> PhotonSettings {
        PhotonSettings { photons: self.photons, nearest: self.nearest, seed: self.seed }
    }

    /// Whether the picture is transparent where the background is.
    pub fn is_transparent(&self) -> bool {
        self.background == Some(Background::Transparent)
    }

    /// What turns, if it is an animation.
    pub fn turn(&self) -> Turn {
        self.animation.as_ref().map_or(Turn::default(), |animation| animation.turn)
    }
}

/// A scene of the catalogue, or a file.
pub fn open_scene(name: &OsStr, limits: Limits) -> Result<SceneFile, RenderError> {
    if let Some(file) = name.to_str().and_then(scene::preset) {
        return Ok(file?);
    }
    let path = Path::new(name);
    if path.extension().is_some_and(|e| e == "toml") || path.exists() {
        return Ok(SceneFile::open(path, limits)?);
    }
    let name = crate::storage::text::display_name(name);
    let near = parse::did_you_mean(parse::nearest_name(&name, SCENES.iter().map(|(n, _)| *n)));
    Err(RenderError::Request(format!(
        "no scene and no file is called '{name}'{near} (all scenes: cutlab list scenes)"
    )))
}
