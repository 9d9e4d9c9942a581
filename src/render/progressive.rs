//! Progressive pictures: rounds until a stop.

use super::error::RenderError;
use super::remaining_time::{self, Outlook, in_words};
use super::request::StopRequest;
use crate::integrators::{Film, Progressive, RenderSettings};
use crate::photons::PhotonSettings;
use crate::progress::Progress;
use crate::scene::Scene;
use crate::storage::checkpoint::Checkpoint;
use std::time::{Duration, Instant};

/// Seconds between two writings of a picture that is still getting better.
const WRITE_EVERY: Duration = Duration::from_secs(60);

impl StopRequest {
    /// Noise at which a picture is good enough if nothing is said.
    const NOISE: f64 = 0.02;
    /// Rounds after which it is taken as it is if nothing is said.
    const ROUNDS: u32 = 100;

    /// Whether no stop was asked for.
    fn none(&self) -> bool {
        self.rounds.is_none() && self.time.is_none() && self.noise.is_none()
    }

    /// Noise to stop at, if noise is to stop it.
    fn noise_to_reach(&self) -> Option<f64> {
        if self.none() { Some(Self::NOISE) } else { self.noise }
    }

    /// About how long it takes to the first stop, if that is known.
    fn left(&self, outlook: &Outlook, rounds: u32, taken: Duration) -> Option<Duration> {
        let most = if self.none() { Some(Self::ROUNDS) } else { self.rounds };
        let counted = most.map(f64::from);
        let foreseen = self.noise_to_reach().and_then(|noise| outlook.rounds_to(noise));
        let by_rounds = [counted, foreseen].into_iter().flatten();
        let by_rounds = by_rounds.filter_map(|all| remaining_time::time_to(all, rounds, taken));
        by_rounds.chain(self.time.map(|time| time.saturating_sub(taken))).min()
    }

    /// - `taken`: time that the picture has taken so far
    fn reached(&self, picture: &Progressive, taken: Duration) -> bool {
        self.rounds.is_some_and(|most| picture.rounds() >= most)
            || self.time.is_some_and(|time| taken >= time)
            || self.noise_to_reach().is_some_and(|noise| picture.is_converged(noise))
            || self.none() && picture.rounds() >= Self::ROUNDS
    }
}

/// Takes rounds until a stop, from where an earlier start of the same request was. Returns the picture
/// and the number of its rounds.
///
/// - `kept`: where its state is kept, if it can be
/// - `keep`: is given the picture as it is so far, now and then
pub fn render(
    stops: &StopRequest,
    scene: &Scene,
    settings: &RenderSettings,
    photons: PhotonSettings,
    progress: &dyn Progress,
    mut kept: Option<&mut Checkpoint>,
    keep: &mut dyn FnMut(&Film, u32) -> Result<(), RenderError>,
) -> Result<(Film, u32), RenderError> {
    let mut since = Instant::now();
    let mut written = since;
    progress.begin("round 1", 0);
    let mut outlook = Outlook::default();
    let mut picture = Progressive::new(scene, &scene.camera, *settings, photons);
    let earlier = kept.as_ref().and_then(|kept| kept.load());
    if let Some((seconds, state)) = earlier.as_ref().and_then(|state| state.split_first_chunk()) {
        let taken = Duration::try_from_secs_f64(f64::from_le_bytes(*seconds)).unwrap_or_default();
        if picture.restore(state) {
            since = since.checked_sub(taken).unwrap_or(since);
            progress.note(&format!("going on after {} rounds", picture.rounds()));
        }
    }
    while picture.rounds() == 0 || !stops.reached(&picture, since.elapsed()) {
        if progress.is_cancelled() {
            return Err(RenderError::Cancelled);
        }
        picture.round(&|| ());
        outlook.note(picture.rounds(), picture.noise());
        let left = stops.left(&outlook, picture.rounds(), since.elapsed());
        progress.say(&status_line(&picture, left));
        if let Some(kept) = &mut kept {
            kept.save(|| [&since.elapsed().as_secs_f64().to_le_bytes()[..], &picture.state()].concat())?;
        }
        if written.elapsed() > WRITE_EVERY {
            keep(picture.film(), picture.rounds())?;
            written = Instant::now();
        }
    }
    progress.end();
    let rounds = match picture.rounds() {
        1 => "1 round".to_string(),
        n => format!("{n} rounds"),
    };
    progress.note(&match picture.noise() {
        _ if picture.is_black() => format!("{rounds}: the picture is black, no light reaches the camera"),
        noise if noise.is_finite() => format!("{rounds}, noise {:.1} %", 100.0 * noise),
        _ => format!("{rounds}, too few to tell the noise"),
    });
    Ok((picture.film().clone(), picture.rounds()))
}

/// How far a picture is: the round that is taken, the noise so far, and about how long it still takes.
fn status_line(picture: &Progressive, left: Option<Duration>) -> String {
    let mut said = format!("round {}", picture.rounds() + 1);
    if picture.noise().is_finite() {
        said += &format!(", noise {:.1} %", 100.0 * picture.noise());
    }
    if let Some(left) = left {
        said += &format!(", about {} left", in_words(left));
    }
    said
}
