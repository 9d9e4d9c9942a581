//! A packet: sixteen rays traced together, and what they leave at an interaction with a facet.

use super::crystal_lanes::{CrystalLanes, LoadedWave};
use super::lanes::{LANES, Lanes};
use glam::Vec3;

/// Rays inside a stone, one a lane, in the stone's frame (see [`super::ConvexStone`]).
#[derive(Debug, Clone)]
#[repr(C, align(64))]
pub struct Packet {
    /// Positions.
    pub x: Lanes,
    /// Positions.
    pub y: Lanes,
    /// Positions.
    pub z: Lanes,
    /// Unit directions.
    pub dx: Lanes,
    /// Unit directions.
    pub dy: Lanes,
    /// Unit directions.
    pub dz: Lanes,
    /// Power still inside; 0 for an idle lane.
    pub power: Lanes,
    /// Index of refraction of the stone at the lane's wavelength.
    pub index: Lanes,
    /// Path length since entry, in units of the stone's frame.
    pub path: Lanes,
    /// Whether the stone absorbs; if not, `absorption` counts for nothing.
    pub absorbing: bool,
    /// Absorption coefficient of the stone at the lane's wavelength, natural logarithm, per unit of
    /// the stone's frame.
    pub absorption: Lanes,
    /// Whether the tracer follows polarisation; if not, light is taken as unpolarised at every facet.
    pub polarised: bool,
    /// Stokes vector besides the power, about the axis (see [`crate::optics::stokes`]).
    pub q: Lanes,
    /// Stokes vector.
    pub u: Lanes,
    /// Stokes vector.
    pub v: Lanes,
    /// Axis of the Stokes vector: unit, across the ray.
    pub ax: Lanes,
    /// Axis of the Stokes vector.
    pub ay: Lanes,
    /// Axis of the Stokes vector.
    pub az: Lanes,
    /// The waves of a stone that refracts doubly; none in one that does not. Its rays follow no Stokes vector.
    pub waves: Option<Box<CrystalLanes>>,
}

/// Refraction of a ray into the stone.
#[derive(Debug, Clone, Copy)]
pub struct Refraction {
    /// Unit direction inside.
    pub direction: Vec3,
    /// Share of the power reflected at the facet.
    pub reflectance: f32,
    /// Cosine of incidence outside.
    pub cos_outside: f32,
    /// Cosine of refraction inside.
    pub cos_inside: f32,
    /// Q of what enters of unpolarised light of power 1.
    pub polarisation: f32,
    /// Axis of Q: unit, across the plane of incidence.
    pub axis: Vec3,
}

impl Default for Packet {
    fn default() -> Self {
        let zero = [0.0; LANES];
        Self {
            x: zero,
            y: zero,
            z: zero,
            dx: zero,
            dy: zero,
            dz: [1.0; LANES],
            power: zero,
            index: [1.5; LANES],
            path: zero,
            absorbing: false,
            absorption: zero,
            polarised: false,
            q: zero,
            u: zero,
            v: zero,
            ax: [1.0; LANES],
            ay: zero,
            az: zero,
            waves: None,
        }
    }
}

impl Packet {
    /// An empty packet that follows polarisation, or not.
    pub fn new(polarised: bool) -> Packet {
        Packet { polarised, ..Packet::default() }
    }

    /// Loads a lane with what enters of unpolarised light of power 1.
    ///
    /// - `point`: in the stone's frame; `entry`: its refraction there; `index`: of the stone at the lane's
    ///   wavelength.
    pub fn load_refracted(&mut self, lane: usize, point: Vec3, entry: &Refraction, index: f32) {
        self.load(lane, point, entry.direction, 1.0 - entry.reflectance, index);
        self.q[lane] = entry.polarisation;
        (self.ax[lane], self.ay[lane], self.az[lane]) = entry.axis.into();
    }

    /// Loads a lane, without absorption: set its `absorption` afterwards.
    ///
    /// - `point`, `direction` (unit): in the stone's frame, just inside
    /// - `power`: any unit; `index`: of the stone at the lane's wavelength
    pub fn load(&mut self, lane: usize, point: Vec3, direction: Vec3, power: f32, index: f32) {
        (self.x[lane], self.y[lane], self.z[lane]) = point.into();
        (self.dx[lane], self.dy[lane], self.dz[lane]) = direction.into();
        self.power[lane] = power;
        self.index[lane] = index;
        self.absorption[lane] = 0.0;
        self.path[lane] = 0.0;
        (self.q[lane], self.u[lane], self.v[lane]) = (0.0, 0.0, 0.0);
        (self.ax[lane], self.ay[lane], self.az[lane]) = direction.any_orthonormal_vector().into();
    }

    /// Loads a lane of a uniaxial stone with a wave, without absorption: set that of both modes, and of the lane's wave, afterwards.
    ///
    /// - `point`: in the stone's frame, just inside; `ray`: unit, where the wave's energy goes; `power`: any unit
    ///
    /// Does nothing to a packet without [`Packet::waves`].
    pub fn load_wave(&mut self, lane: usize, point: Vec3, ray: Vec3, power: f32, wave: &LoadedWave) {
        self.load(lane, point, ray, power, wave.indices[0]);
        let Some(waves) = &mut self.waves else { return };
        (waves.kx[lane], waves.ky[lane], waves.kz[lane]) = wave.wave_vector.into();
        waves.extraordinary[lane] = wave.indices[1];
        waves.mode[lane] = if wave.is_extraordinary { 1.0 } else { 0.0 };
        waves.choice[lane] = wave.choice;
        (waves.absorption[0][lane], waves.absorption[1][lane]) = (0.0, 0.0);
        waves.other[lane] = 0.0;
    }

    /// Puts another wave of the same light into a lane; its power and path are to be set.
    pub(super) fn resume(&mut self, lane: usize, point: Vec3, wave_vector: Vec3, is_extraordinary: bool) {
        let Some(waves) = &mut self.waves else { return };
        (waves.kx[lane], waves.ky[lane], waves.kz[lane]) = wave_vector.into();
        waves.mode[lane] = if is_extraordinary { 1.0 } else { 0.0 };
        let (ray, absorption) = waves.ray_of(lane, self.index[lane], wave_vector, is_extraordinary);
        (self.x[lane], self.y[lane], self.z[lane]) = point.into();
        (self.dx[lane], self.dy[lane], self.dz[lane]) = ray.into();
        self.absorption[lane] = absorption;
    }

    /// Position of a lane: the point of its last interaction.
    pub fn point(&self, lane: usize) -> Vec3 {
        Vec3::new(self.x[lane], self.y[lane], self.z[lane])
    }

    /// Direction of a lane.
    pub fn direction(&self, lane: usize) -> Vec3 {
        Vec3::new(self.dx[lane], self.dy[lane], self.dz[lane])
    }

    /// Stops lanes below `power` and returns the power they held.
    pub(super) fn stop_below(&mut self, power: f32) -> f32 {
        let mut lost = 0.0;
        for p in &mut self.power {
            let stops = *p < power;
            lost += if stops { *p } else { 0.0 };
            *p = if stops { 0.0 } else { *p };
        }
        lost
    }

    /// Whether every lane is idle.
    pub(super) fn is_spent(&self) -> bool {
        self.power.iter().all(|p| *p <= 0.0)
    }
}

/// The facet number of a lane that meets none: its direction is not a number.
pub const NO_FACET: u32 = u32::MAX;

/// What a packet meets next, one a lane (see [`super::ConvexStone::next_facets`]).
#[derive(Debug, Clone)]
#[repr(C, align(64))]
pub struct NextFacets {
    /// The facet, or [`NO_FACET`].
    pub facet: [u32; LANES],
    /// The distance to it, in units of the stone's frame; undefined if there is none.
    pub distance: Lanes,
}

impl Default for NextFacets {
    fn default() -> Self {
        Self { facet: [NO_FACET; LANES], distance: [0.0; LANES] }
    }
}

/// Where a ray from outside first meets the stone (see [`super::ConvexStone::intersect`]).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FacetHit {
    /// The facet.
    pub facet: usize,
    /// Distance along the ray, in trace units.
    pub distance: f32,
}

/// What a packet leaves at one interaction with facets, one a lane.
#[derive(Debug, Clone)]
#[repr(C, align(64))]
pub struct Interaction {
    /// The facet that each lane met.
    pub facet: [u32; LANES],
    /// Power that left the stone there; 0 at total reflection.
    pub power: Lanes,
    /// Power absorbed on the way there; 0 in a packet that is not absorbing.
    pub absorbed: Lanes,
    /// Unit direction outside.
    pub dx: Lanes,
    /// Unit direction outside.
    pub dy: Lanes,
    /// Unit direction outside.
    pub dz: Lanes,
    /// Cosine inside, between ray and facet normal.
    pub cos_inside: Lanes,
    /// Cosine outside; 0 at total reflection.
    pub cos_outside: Lanes,
    /// Power of lanes that met no facet at all (a direction that is not a number).
    pub lost: f32,
}

impl Default for Interaction {
    fn default() -> Self {
        let zero = [0.0; LANES];
        Self {
            facet: [0; LANES],
            power: zero,
            absorbed: zero,
            dx: zero,
            dy: zero,
            dz: zero,
            cos_inside: zero,
            cos_outside: zero,
            lost: 0.0,
        }
    }
}

/// Light that leaves the stone.
#[derive(Debug, Clone, Copy)]
pub struct RayExit {
    /// Facet through which it leaves.
    pub facet: u32,
    /// Point of the facet, in the stone's frame.
    pub point: Vec3,
    /// Unit direction outside.
    pub direction: Vec3,
    /// Its power.
    pub power: f32,
}

impl Interaction {
    /// Unit direction outside of what a lane leaves.
    pub fn direction(&self, lane: usize) -> Vec3 {
        Vec3::new(self.dx[lane], self.dy[lane], self.dz[lane])
    }

    /// What a lane left outside; none at total reflection or for an idle lane.
    pub fn exit(&self, packet: &Packet, lane: usize) -> Option<RayExit> {
        (self.power[lane] > 0.0).then(|| RayExit {
            facet: self.facet[lane],
            point: packet.point(lane),
            direction: self.direction(lane),
            power: self.power[lane],
        })
    }
}
