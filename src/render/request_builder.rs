//! Methods by which a request for a picture or an animation is put together.

use super::background::Background;
use super::request::{AnimationRequest, Exposure, RenderRequest, StopRequest};
use crate::integrators::ToneCurve;
use crate::integrators::animation::Turn;
use crate::scene::Pose;
use crate::stone::{Stone, StoneOptions};
use std::path::PathBuf;
use std::time::Duration;

impl RenderRequest {
    /// With one more stone, for the scene's next place.
    pub fn stone(mut self, stone: &Stone) -> RenderRequest {
        self.opened.push(stone.clone());
        self
    }

    /// With stones as they are named, for the scene's places in order.
    pub fn stones<S: Into<String>>(mut self, names: impl IntoIterator<Item = S>) -> RenderRequest {
        self.stones = names.into_iter().map(Into::into).collect();
        self
    }

    /// With what is asked for of every stone.
    pub fn options(mut self, options: StoneOptions) -> RenderRequest {
        self.options = options;
        self
    }

    /// Whether a scene file may name files outside its own folder.
    pub fn allow_outside(mut self, allow: bool) -> RenderRequest {
        self.allow_outside = allow;
        self
    }

    /// With a panorama in place of the scene's.
    pub fn panorama(mut self, file: impl Into<PathBuf>) -> RenderRequest {
        self.panorama = Some(file.into());
        self
    }

    /// With stones that stand so in the scene.
    pub fn pose(mut self, pose: Pose) -> RenderRequest {
        self.pose = Some(pose);
        self
    }

    /// With so many pixels across and down.
    pub fn size(mut self, width: u32, height: u32) -> RenderRequest {
        (self.width, self.height) = (Some(width), Some(height));
        self
    }

    /// With so many camera rays a pixel.
    pub fn samples_per_pixel(mut self, n: u32) -> RenderRequest {
        self.samples_per_pixel = Some(n);
        self
    }

    /// With a seed of its random numbers.
    pub fn seed(mut self, seed: u64) -> RenderRequest {
        self.seed = seed;
        self
    }

    /// With so many photons in each map.
    pub fn photons(mut self, n: usize) -> RenderRequest {
        self.photons = n;
        self
    }

    /// With so many photons over whose distance each spreads its light.
    pub fn nearest(mut self, n: usize) -> RenderRequest {
        self.nearest = n;
        self
    }

    /// As a progressive picture, which ends where `stop` says.
    pub fn progressive(mut self, stop: StopRequest) -> RenderRequest {
        self.progressive = Some(stop);
        self
    }

    /// As an animation.
    pub fn animation(mut self, animation: AnimationRequest) -> RenderRequest {
        self.animation = Some(animation);
        self
    }

    /// With a background in place of the scene's surroundings.
    pub fn background(mut self, background: Background) -> RenderRequest {
        self.background = Some(background);
        self
    }

    /// With an exposure beside the scene's own.
    pub fn exposure(mut self, exposure: Exposure) -> RenderRequest {
        self.exposure = Some(exposure);
        self
    }

    /// With a tone curve.
    pub fn tone(mut self, curve: ToneCurve) -> RenderRequest {
        self.tone = Some(curve);
        self
    }

    /// With the star of an iris added to what is beyond white.
    ///
    /// - `f_number`: of the iris
    pub fn glare(mut self, f_number: f32) -> RenderRequest {
        self.glare = Some(f_number);
        self
    }

    /// With so many bits a channel of a PNG, 8 or 16.
    pub fn bits(mut self, bits: u8) -> RenderRequest {
        self.bits = Some(bits);
        self
    }

    /// Whether light keeps its polarisation from facet to facet.
    pub fn polarised(mut self, polarised: bool) -> RenderRequest {
        self.polarised = Some(polarised);
        self
    }
}

impl StopRequest {
    /// After so many rounds.
    pub fn rounds(mut self, rounds: u32) -> StopRequest {
        self.rounds = Some(rounds);
        self
    }

    /// After the round that ends past this time.
    pub fn time(mut self, time: Duration) -> StopRequest {
        self.time = Some(time);
        self
    }

    /// When 4×4 pixels are off by this share of the mean on average.
    pub fn noise(mut self, share: f64) -> StopRequest {
        self.noise = Some(share);
        self
    }
}

impl AnimationRequest {
    /// Of so many pictures, in which the camera goes all the way around.
    pub fn new(frames: u32) -> AnimationRequest {
        AnimationRequest { frames, turn: Turn::default(), rock: false, fps: None }
    }

    /// With what turns.
    pub fn turn(mut self, turn: Turn) -> AnimationRequest {
        self.turn = turn;
        self
    }

    /// Whether it is rocked to and fro instead of turned all the way around.
    pub fn rock(mut self, rock: bool) -> AnimationRequest {
        self.rock = rock;
        self
    }

    /// With so many frames a second.
    pub fn fps(mut self, fps: u32) -> AnimationRequest {
        self.fps = Some(fps);
        self
    }
}
