//! Options of `cutlab render`.

use super::super::args::{stone, values};
use super::choices;
use crate::integrators::ToneCurve;
use crate::integrators::animation::Turn;
use crate::parse;
use crate::parse::{NumberError, NumberUnit};
use crate::render::{AnimationRequest, Background, Exposure, RenderRequest, StopRequest, background};
use crate::scene::{self, Pose};
use std::ffi::OsString;
use std::path::PathBuf;
use std::time::Duration;

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
    pub stones: Vec<OsString>,
    /// What is around it: a name of `cutlab list scenes`, or a TOML file
    #[arg(long, default_value = "table", value_name = "NAME|FILE")]
    pub scene: OsString,
    /// Let a scene file name stones, meshes and panoramas outside its own folder
    #[arg(long)]
    pub allow_outside: bool,
    /// The panorama (.hdr, .exr) of a scene that is lit by one, such as daylight
    #[arg(long, value_name = "FILE")]
    pub hdr: Option<PathBuf>,
    #[command(flatten)]
    pub stone_args: stone::StoneArgs,
    /// Girdle width in millimetres
    #[arg(long, value_name = "MM", value_parser = stone::millimetres)]
    pub size: Option<f64>,
    /// How it stands: lying (as a loose stone comes to rest), table-up or table-down; the scene has a
    /// default
    #[arg(long, value_parser = choices::pose)]
    pub pose: Option<Pose>,
    /// Where to write: .png, .jpg, .webp, .exr (linear, with all passes); an animation to .mp4, .gif,
    /// .apng, or to numbered pictures such as turn-%03d.png
    #[arg(long, short, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Pixels across; the scene has a default
    #[arg(long, value_parser = values::whole_number(1..=scene::scene_file::MOST_PIXELS, "a width is a whole number of pixels"))]
    pub width: Option<u32>,
    /// Pixels down; the scene has a default
    #[arg(long, value_parser = values::whole_number(1..=scene::scene_file::MOST_PIXELS, "a height is a whole number of pixels"))]
    pub height: Option<u32>,
    /// Camera rays a pixel: 25, or 1 in each round of --progressive
    #[arg(long, value_parser = values::whole_number(1..=1_000_000, "camera rays are a whole number"))]
    pub spp: Option<u32>,
    /// Seed of all random numbers
    #[arg(long, default_value_t = 1, value_parser = values::seed)]
    pub seed: u64,
    #[command(flatten)]
    pub stops: StopArgs,
    /// Photons in each map
    #[arg(long, default_value_t = 100_000, value_parser = choices::counted)]
    pub photons: usize,
    /// Photons over whose distance each spreads its light
    #[arg(long, default_value_t = 500, value_parser = choices::counted)]
    pub nearest: usize,
    /// Keep the photons in this file and use them again for other views; of an animation only where the
    /// camera alone moves
    #[arg(long, value_name = "FILE")]
    pub photon_map: Option<PathBuf>,
    /// Also write the direct, caustic, indirect and stone passes, of which the picture is the sum
    #[arg(long)]
    pub passes: bool,
    /// An animation of this many pictures
    #[arg(long, value_name = "N", value_parser = values::whole_number(1..=100_000, "an animation has a whole number of pictures"))]
    pub frames: Option<u32>,
    /// Frames a second [so many that a turn takes 3 to 6 seconds]
    #[arg(long, value_name = "N", requires = "frames", value_parser = values::whole_number(1..=120, "frames a second are a whole number"))]
    pub fps: Option<u32>,
    /// What turns in an animation: camera, stone, light, or all (stones and meshes as one piece)
    #[arg(long, default_value = "camera", requires = "frames", value_parser = choices::turn)]
    pub turn: Turn,
    /// Rock it by 15° to and fro instead of all the way around
    #[arg(long, requires = "frames")]
    pub rock: bool,
    /// What is behind the stones in place of the scene's floor, walls, sky and lamps: transparent (in a
    /// .png, .webp, .exr or .apng), white, black, or a colour as '#1e90ff'. Stones mirror and refract the
    /// scene as ever
    #[arg(long, value_name = "COLOUR|transparent", value_parser = background::parse)]
    pub background: Option<Background>,
    /// Exposure in stops beside the scene's own, or auto [0]
    #[arg(long, allow_negative_numbers = true, value_parser = choices::exposure, value_name = "STOPS|auto")]
    pub exposure: Option<Exposure>,
    /// Tone curve, which acts on luminance and keeps the hue: filmic, straight up to .6, then
    /// .6 + .4 (1 - e^(-(x - .6)/.4)), or linear, which ends at white [filmic; linear for viewers]
    #[arg(long, value_parser = choices::curve)]
    pub tone: Option<ToneCurve>,
    /// Let what is beyond white shine out in stars, as an iris of six blades does at this f-number; an
    /// EXR and the passes stay without [16 if given without a number]
    #[arg(long, value_name = "F", num_args = 0..=1, require_equals = true, default_missing_value = "16", value_parser = choices::f_number)]
    pub glare: Option<f32>,
    /// Bits a channel of a PNG: 8 or 16 [8]
    #[arg(long, value_parser = ["8", "16"])]
    pub bits: Option<String>,
    /// Whether light keeps its polarisation from facet to facet; off takes it as unpolarised at each.
    /// On, unless the scene says
    #[arg(long, value_name = "on|off", value_parser = stone::on_off)]
    pub polarisation: Option<bool>,
}

impl RenderArgs {
    /// The request that these options make, its stones by name.
    pub fn request(&self) -> RenderRequest {
        let StopArgs { progressive, rounds, time, noise } = self.stops;
        let animation = |frames| AnimationRequest { frames, turn: self.turn, rock: self.rock, fps: self.fps };
        RenderRequest {
            stones: self.stones.iter().map(stone::display_name).collect(),
            options: self.stone_args.options(self.size),
            scene: stone::display_name(&self.scene),
            allow_outside: self.allow_outside,
            panorama: self.hdr.clone(),
            pose: self.pose,
            width: self.width,
            height: self.height,
            samples_per_pixel: self.spp,
            seed: self.seed,
            photons: self.photons,
            nearest: self.nearest,
            progressive: progressive.then_some(StopRequest { rounds, time, noise }),
            animation: self.frames.map(animation),
            background: self.background,
            exposure: self.exposure,
            tone: self.tone,
            glare: self.glare,
            bits: self.bits.as_deref().map(|bits| if bits == "16" { 16 } else { 8 }),
            polarised: self.polarisation,
            opened: Vec::new(),
        }
    }
}

/// When a progressive picture is good enough; the first stop that is reached counts.
#[derive(Debug, Clone, clap::Args)]
pub struct StopArgs {
    /// Converge round by round, each with new photons and smaller estimates, to a stop: --rounds,
    /// --time or --noise; without one to 2 % of noise, or 100 rounds
    #[arg(long, conflicts_with = "photon_map")]
    pub progressive: bool,
    /// Stop after this many rounds
    #[arg(long, value_name = "N", requires = "progressive", value_parser = values::whole_number(1..=u32::MAX, "rounds are a whole number"))]
    pub rounds: Option<u32>,
    /// Stop after the round that ends past this time: 60s, 5min, 1h30m
    #[arg(long, value_name = "TIME", requires = "progressive", value_parser = values::duration)]
    pub time: Option<Duration>,
    /// Stop when 4×4 pixels are off by this share of the mean on average, 2% or 0.02; after eight rounds at
    /// the earliest, for fewer cannot tell
    #[arg(long, value_name = "SHARE", requires = "progressive", value_parser = share)]
    pub noise: Option<f64>,
}

fn share(text: &str) -> Result<f64, String> {
    let unit = if text.trim().ends_with('%') { 0.01 } else { 1.0 };
    match parse::parse_number(text, NumberUnit::Percent) {
        Ok(n) if n > 0.0 && n * unit < 10.0 => Ok(n * unit),
        Ok(_) | Err(NumberError::NotANumber | NumberError::Infinite) => {
            Err("a share above 0 is needed, such as 2% or 0.02".into())
        }
        Err(error) => Err(error.to_string()),
    }
}
