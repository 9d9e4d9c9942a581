//! Light inside a convex stone that refracts doubly, in `f64`, one ray at a time.
//!
//! Inside, a ray is a wave of one mode: its wave vector obeys the laws of facets, its ray is where its energy goes. At a facet it
//! leaves what is transmitted, in one direction, and goes on as two waves. The tree follows both; the walk follows
//! one, chosen by power, which carries the sum of both. Modes are added by power: over the path in a stone and the width of
//! any real light the phase between them takes every value.

use super::reference::next_facet;
use crate::geometry::Plane;
use crate::optics::crystal::facet::{Crystal, Entry, InternalMeeting};
use crate::optics::crystal::wave::Wave;
use glam::{DMat3, DVec3};

/// What a stone is made of at one wavelength.
#[derive(Debug, Clone, Copy)]
pub struct CrystalOptics {
    /// How it refracts, in the stone's frame.
    pub crystal: Crystal,
    /// The sum of n α a aᵀ over the principal axes a: α the absorption coefficient of light whose field lies along a,
    /// natural logarithm, per unit of the stone's frame, and n its index. Zero for a clear stone.
    pub absorption: DMat3,
}

/// A ray of one mode inside a stone.
#[derive(Debug, Clone, Copy)]
pub struct CrystalRay {
    /// Position, in the frame of the planes.
    pub point: DVec3,
    /// Its wave; only directions and shapes of its fields count.
    pub wave: Wave,
    /// The mode, 0 or 1: ordinary and extraordinary, or fast and slow.
    pub mode: usize,
    /// Power.
    pub power: f64,
}

/// What becomes of a ray at a facet.
#[derive(Debug, Clone, Copy)]
pub struct CrystalInteraction {
    /// The facet's number.
    pub facet: usize,
    /// Point of the facet, in the frame of the planes.
    pub point: DVec3,
    /// Unit direction outside; the zero vector at total reflection.
    pub direction: DVec3,
    /// Power that left; 0 at total reflection.
    pub power: f64,
    /// Power absorbed on the way there.
    pub absorbed: f64,
    /// What goes on, one ray of each mode; a wave that dies away has no power.
    pub reflected: [CrystalRay; 2],
}

impl CrystalOptics {
    /// What enters of unpolarised light of power 1 that meets a facet from outside: one ray of each mode.
    ///
    /// - `point`: of the facet; `direction`: unit, into the stone; `normal`: unit, out of it
    pub fn enter(&self, point: DVec3, direction: DVec3, normal: DVec3) -> [CrystalRay; 2] {
        let entry = Entry::new(&self.crystal, direction, normal, 1.0);
        let powers = entry.unpolarised();
        [0, 1].map(|mode| CrystalRay { point, wave: entry.waves[mode], mode, power: powers[mode] })
    }

    /// The absorption coefficient of a wave along its ray, natural logarithm, per unit of the stone's frame: what it loses over
    /// what it carries.
    pub fn absorption_of(&self, wave: &Wave) -> f64 {
        let loss = wave.e.re.dot(self.absorption * wave.e.re) + wave.e.im.dot(self.absorption * wave.e.im);
        loss / wave.e.cross(wave.h.conj()).re.length()
    }

    /// Follows a ray to its next facet; none for a direction that is not a number.
    pub fn interact(&self, planes: &[Plane], ray: &CrystalRay) -> Option<CrystalInteraction> {
        let (facet, distance) = next_facet(planes, ray.point, ray.wave.ray)?;
        let normal = planes[facet].normal;
        let mut point = ray.point + ray.wave.ray * distance;
        point -= normal * planes[facet].signed_distance(point);
        let left = if self.absorption == DMat3::ZERO {
            1.0
        } else {
            (-self.absorption_of(&ray.wave) * distance).exp()
        };
        let power = left * ray.power;
        let incident = Wave::new(ray.wave.k, ray.wave.e, normal);
        let meeting = InternalMeeting::new(&self.crystal, &incident, normal, 1.0);
        // both shares, and what leaves is the rest: near grazing rounding would not let them add up to 1
        let shares = meeting.reflected.map(|channel| channel.power());
        let kept = shares[0] + shares[1];
        let (shares, direction) = if meeting.outside.travels() {
            let most = kept.max(1.0);
            (shares.map(|share| share / most), meeting.outside.direction())
        } else {
            (shares.map(|share| share / kept), DVec3::ZERO)
        };
        let reflected = [0, 1].map(|mode| CrystalRay {
            point,
            wave: meeting.reflected[mode].wave,
            mode,
            power: power * shares[mode],
        });
        Some(CrystalInteraction {
            facet,
            point,
            direction,
            power: (power * (1.0 - shares[0] - shares[1])).max(0.0),
            absorbed: ray.power - power,
            reflected,
        })
    }

    /// Traces rays and all that they become until each holds less than `stop_power`; returns the power given up.
    pub fn trace_tree(
        &self,
        planes: &[Plane],
        rays: impl IntoIterator<Item = CrystalRay>,
        stop_power: f64,
        mut visit: impl FnMut(&CrystalInteraction),
    ) -> f64 {
        let mut lost = 0.0;
        let mut waiting: Vec<CrystalRay> = rays.into_iter().collect();
        while let Some(ray) = waiting.pop() {
            let followed = ray.power > stop_power && ray.wave.travels();
            let Some(interaction) = followed.then(|| self.interact(planes, &ray)).flatten() else {
                lost += ray.power;
                continue;
            };
            visit(&interaction);
            waiting.extend(interaction.reflected);
        }
        lost
    }

    /// Traces one ray that is of either mode by chance, until it holds less than `stop_power`; returns the power given up.
    ///
    /// - `rays`: one of each mode, as they enter
    /// - `choice`: in 0..1, uniform; it serves all choices, stretched after each
    pub fn trace_walk(
        &self,
        planes: &[Plane],
        rays: [CrystalRay; 2],
        mut choice: f64,
        stop_power: f64,
        mut visit: impl FnMut(&CrystalInteraction),
    ) -> f64 {
        let mut ray = chosen(rays, &mut choice);
        for _ in 0..super::MAX_BOUNCES {
            if ray.power < stop_power || !ray.wave.travels() {
                break;
            }
            let Some(interaction) = self.interact(planes, &ray) else { break };
            visit(&interaction);
            ray = chosen(interaction.reflected, &mut choice);
        }
        ray.power
    }
}

/// One of two rays in proportion to their power, with the power of both.
fn chosen([first, second]: [CrystalRay; 2], choice: &mut f64) -> CrystalRay {
    let power = first.power + second.power;
    let share = if power > 0.0 { first.power / power } else { 1.0 };
    let ray = if *choice < share {
        *choice /= share;
        first
    } else {
        *choice = (*choice - share) / (1.0 - share);
        second
    };
    *choice = choice.clamp(0.0, 1.0);
    CrystalRay { power, ..ray }
}
