//! `--progressive`: rounds of a picture until a stop.

use super::Args;
use crate::cli::console::Console;
use crate::cli::outcome::Failure;
use crate::render::{Film, Progressive, Settings};
use crate::scene::Scene;
use std::time::{Duration, Instant};

/// Seconds between two writings of a picture that is still getting better.
const WRITE_EVERY: Duration = Duration::from_secs(60);

/// When a progressive picture is good enough; the first stop that is reached counts.
#[derive(Debug, Clone, clap::Args)]
pub struct Stops {
    /// Converge round by round, each with new photons and smaller estimates, to a stop: --rounds,
    /// --time or --noise; without one to 2 % of noise
    #[arg(long, conflicts_with = "photon_map")]
    pub progressive: bool,
    /// Stop after this many rounds
    #[arg(long, value_name = "N", requires = "progressive", value_parser = clap::value_parser!(u32).range(1..))]
    rounds: Option<u32>,
    /// Stop after the round that ends past this time: 60s, 5min, 1h30m
    #[arg(long, value_name = "TIME", requires = "progressive", value_parser = humantime::parse_duration)]
    time: Option<Duration>,
    /// Stop when 4×4 pixels are off by this share of the mean on average: 2% or 0.02
    #[arg(long, value_name = "SHARE", requires = "progressive", value_parser = share)]
    noise: Option<f64>,
}

fn share(text: &str) -> Result<f64, String> {
    let (number, unit) = text.strip_suffix('%').map_or((text, 1.0), |number| (number.trim_end(), 0.01));
    match number.parse::<f64>() {
        Ok(n) if n > 0.0 && n * unit < 10.0 => Ok(n * unit),
        _ => Err("a share above 0 is needed, such as 2% or 0.02".into()),
    }
}

impl Stops {
    /// Noise at which a picture is good enough if nothing is said.
    const NOISE: f64 = 0.02;

    fn reached(&self, picture: &Progressive, since: Instant) -> bool {
        let none = self.rounds.is_none() && self.time.is_none() && self.noise.is_none();
        let noise = if none { Some(Self::NOISE) } else { self.noise };
        self.rounds.is_some_and(|most| picture.rounds() >= most)
            || self.time.is_some_and(|time| since.elapsed() >= time)
            || noise.is_some_and(|noise| picture.noise() <= noise)
    }
}

/// Takes rounds until a stop. Returns the picture and their number.
///
/// - `keep`: writes the picture as it is so far, now and then
pub fn take(
    args: &Args,
    scene: &Scene,
    settings: &Settings,
    console: &Console,
    keep: &mut dyn FnMut(&Film, u32) -> Result<(), Failure>,
) -> Result<(Film, u32), Failure> {
    let since = Instant::now();
    let mut kept = since;
    let sign = console.spinner("round 1");
    let mut picture = Progressive::new(scene, &scene.camera, *settings, args.photons());
    loop {
        picture.round(&|| ());
        if args.stops.reached(&picture, since) {
            break;
        }
        sign.set_message(format!("round {}, noise {:.1} %", picture.rounds() + 1, 100.0 * picture.noise()));
        if kept.elapsed() > WRITE_EVERY {
            keep(picture.film(), picture.rounds())?;
            kept = Instant::now();
        }
    }
    sign.finish_and_clear();
    console.note(&format!("{} rounds, noise {:.1} %", picture.rounds(), 100.0 * picture.noise()));
    Ok((picture.film().clone(), picture.rounds()))
}
