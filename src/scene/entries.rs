//! The entries of a scene file, and how each becomes a part of the scene.

use super::file::{Cast, GREATEST, Place, walking_stone};
use super::lights::{Kind, LIGHTS};
use super::mesh::Mesh;
use super::panorama::Panorama;
use super::surface::{Finish, Plate, Shape};
use super::{Camera, Lens, Light, PlacedStone, Pose, Reflectance, Surface};
use crate::cut::Design;
use crate::formats::{scenery, stone};
use crate::optics::daylight::ClearSky;
use crate::optics::illuminants::ILLUMINANTS;
use crate::optics::materials::MATERIALS;
use crate::optics::viewers::{VIEWERS, Viewer};
use crate::optics::{Illuminant, Material, rgb};
use crate::walk::Stone;
use glam::{DMat3, Mat3, Vec3};
use serde::Deserialize;
use std::sync::Arc;

/// What is wrong with an entry, and the key it is about.
#[derive(Debug)]
pub struct Wrong {
    /// The key.
    pub key: &'static str,
    /// The problem, in one line.
    pub problem: String,
}

fn wrong(key: &'static str, problem: impl Into<String>) -> Wrong {
    Wrong { key, problem: problem.into() }
}

/// An entry of a catalogue by name; the error lists all.
fn named<T>(key: &'static str, found: Option<T>, name: &str, all: &[&str]) -> Result<T, Wrong> {
    found.ok_or_else(|| wrong(key, format!("{key} '{name}' is none of {}", all.join(", "))))
}

fn illuminant(key: &'static str, name: Option<&str>) -> Result<&'static Illuminant, Wrong> {
    let name = name.unwrap_or(Illuminant::equal_energy().name);
    let all: Vec<&str> = ILLUMINANTS.iter().map(|i| i.name).collect();
    named(key, Illuminant::named(name), name, &all)
}

/// A number above 0.
fn positive(key: &'static str, value: Option<f32>) -> Result<f32, Wrong> {
    match value {
        Some(x) if x > 0.0 && x.is_finite() => Ok(x),
        Some(x) => Err(wrong(key, format!("{key} = {x} is not a number above 0"))),
        None => Err(wrong(key, format!("{key} is missing"))),
    }
}

/// Turns about x, then y, then z, in degrees.
fn turned(turn: Option<[f64; 3]>) -> DMat3 {
    let [x, y, z] = turn.unwrap_or_default().map(f64::to_radians);
    DMat3::from_rotation_z(z) * DMat3::from_rotation_y(y) * DMat3::from_rotation_x(x)
}

/// `[camera]`
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct CameraEntry {
    at: [f32; 3],
    to: Option<[f32; 3]>,
    field: Option<f32>,
    field_short: Option<f32>,
    width: Option<f32>,
    aperture: Option<Aperture>,
    focus: Option<Focus>,
    #[serde(default)]
    exposure: f32,
    white: Option<String>,
}

/// How wide the lens is: a diameter in the file's unit, or an f-number such as "f/8".
#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
enum Aperture {
    Diameter(f32),
    Number(String),
}

/// What is sharp: a distance along the view, or the plane across the view through a point.
#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
enum Focus {
    Distance(f32),
    Point([f32; 3]),
}

impl CameraEntry {
    pub(super) fn camera(&self, place: &Place, aspect: f32) -> Result<Camera, Wrong> {
        let lens = match (self.field, self.field_short, self.width) {
            (Some(deg), None, None) if deg > 0.0 && deg < 175.0 => Lens::Perspective(deg),
            (None, Some(deg), None) if deg > 0.0 && deg < 150.0 => {
                let half = (0.5 * deg.to_radians()).tan() * aspect.max(1.0);
                Lens::Perspective(2.0 * half.atan().to_degrees())
            }
            (None, None, width @ Some(_)) => Lens::Orthographic(place.length(positive("width", width)?)),
            _ => return Err(wrong("field", "a camera has one of field (degrees), field-short or width")),
        };
        let position = place.point(self.at);
        let target = self.to.map_or(place.centre, |p| place.point(p));
        if position.distance(target) < 1e-6 {
            return Err(wrong("at", "the camera stands where it looks"));
        }
        let lens = self.opened(lens, place, position, target)?;
        let white = illuminant("white", self.white.as_deref())?;
        Ok(Camera { position, target, lens, aspect, stops: self.exposure, white })
    }

    /// The lens with its aperture, if it has one.
    fn opened(&self, lens: Lens, place: &Place, position: Vec3, target: Vec3) -> Result<Lens, Wrong> {
        let field_deg = match (&self.aperture, &self.focus, lens) {
            (None, None, _) => return Ok(lens),
            (None, Some(_), _) => return Err(wrong("focus", "without an aperture everything is in focus")),
            (Some(_), _, Lens::Perspective(field_deg)) => field_deg,
            (Some(_), ..) => {
                return Err(wrong("aperture", "parallel rays have no aperture: give field instead of width"));
            }
        };
        let forward = (target - position).normalize();
        let focus = match self.focus {
            None => target.distance(position),
            Some(Focus::Distance(distance)) => place.length(distance),
            Some(Focus::Point(point)) => (place.point(point) - position).dot(forward),
        };
        if focus <= 1e-6 {
            return Err(wrong("focus", "what is in focus lies before the camera"));
        }
        let diameter = match &self.aperture {
            Some(Aperture::Number(text)) => {
                let number = text.strip_prefix("f/").and_then(|n| n.parse().ok());
                let number = number.filter(|n: &f32| *n > 0.0 && n.is_finite());
                let number = number.ok_or_else(|| {
                    wrong(
                        "aperture",
                        format!("aperture '{text}' is no diameter and no f-number such as \"f/8\""),
                    )
                })?;
                Lens::opening_mm(number, field_deg, focus)
            }
            Some(Aperture::Diameter(diameter)) => place.length(positive("aperture", Some(*diameter))?),
            None => 0.0,
        };
        Ok(Lens::Thin { field_deg, radius: 0.5 * diameter, focus })
    }
}

/// `[[stone]]`
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StoneEntry {
    cut: Option<String>,
    material: Option<String>,
    size: Option<f64>,
    radius: Option<f32>,
    pose: Option<String>,
    turn: Option<[f64; 3]>,
    at: Option<Vec<f32>>,
}

impl StoneEntry {
    /// The STONE.
    pub(super) fn cut(&self) -> &str {
        self.cut.as_deref().unwrap_or("round-brilliant")
    }

    /// The design of that STONE: of the library, or of a regular file.
    pub(super) fn design(&self) -> Result<Design, Wrong> {
        let opened = stone::open_regular(self.cut()).map_err(|e| wrong("cut", e.to_string()))?;
        Ok(opened.design)
    }

    /// The stone and what it is made of: as the cast says, else the entry, else the design's own
    /// index, else diamond.
    pub(super) fn stone(&self, design: Design, cast: &Cast) -> Result<(Stone, Material), Wrong> {
        let material = match (&cast.material, &self.material, design.refractive_index) {
            (Some(material), _, _) => material.clone(),
            (None, Some(name), _) => {
                let all: Vec<&str> = MATERIALS.iter().map(|m| m.name.as_ref()).collect();
                named("material", Material::named(name), name, &all)?.clone()
            }
            (None, None, Some(n)) => Material::of_index(n),
            (None, None, None) => MATERIALS[0].clone(),
        };
        let size = cast.size_mm.or(self.size);
        if size.is_some_and(|mm| !(1e-3..=1e3).contains(&mm)) {
            return Err(wrong("size", "a size is a number of millimetres from 0.001 to 1000"));
        }
        Ok((walking_stone(design, size).map_err(|e| wrong("cut", e))?, material))
    }

    /// Sets the stone down.
    pub(super) fn place(
        &self,
        stone: Stone,
        material: Material,
        unit: f32,
        pose: Option<Pose>,
    ) -> Result<PlacedStone, Wrong> {
        let pose = match (&self.pose, pose) {
            (_, Some(pose)) => pose,
            (None, None) => Pose::Lying,
            (Some(name), None) => named("pose", Pose::named(name), name, &Pose::ALL.map(|(n, _)| n))?,
        };
        let turn = turned(self.turn) * pose.rotation(&stone.solid);
        let radius = match self.radius {
            Some(_) => positive("radius", self.radius)? * unit,
            None => stone.unit as f32,
        };
        let at = self.at.clone().unwrap_or_else(|| vec![0.0, 0.0]);
        match at[..] {
            [x, y] => Ok(PlacedStone::resting(stone, material, turn, radius, Vec3::new(x, y, 0.0) * unit)),
            [x, y, z] => {
                let placed = PlacedStone::resting(stone, material, turn, radius, Vec3::ZERO);
                Ok(PlacedStone { position: Vec3::new(x, y, z) * unit, ..placed })
            }
            _ => Err(wrong("at", "at is [x, y] on the floor or [x, y, z]")),
        }
    }
}

/// A reflectance as written.
#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
enum ReflectanceEntry {
    Grey(f32),
    Rgb([f32; 3]),
    Edge { low: f32, high: f32, edge: f32 },
}

/// `[[surface]]`
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SurfaceEntry {
    corner: Option<[f32; 3]>,
    u: Option<[f32; 3]>,
    v: Option<[f32; 3]>,
    mesh: Option<String>,
    at: Option<[f32; 3]>,
    turn: Option<[f64; 3]>,
    scale: Option<f32>,
    reflectance: ReflectanceEntry,
    #[serde(default)]
    mirror: bool,
}

impl SurfaceEntry {
    pub(super) fn surface(&self, place: &Place) -> Result<Surface, Wrong> {
        let reflectance = match self.reflectance {
            ReflectanceEntry::Grey(r) => Reflectance::Grey(r),
            ReflectanceEntry::Rgb(rgb) => Reflectance::Mixture(rgb::mixture(rgb.into()).min(Vec3::ONE)),
            ReflectanceEntry::Edge { low, high, edge } => Reflectance::Edge { low, high, edge_nm: edge },
        };
        if [400.0, 550.0, 700.0].iter().any(|nm| !(0.0..=1.0).contains(&reflectance.at(*nm))) {
            return Err(wrong("reflectance", "a reflectance lies between 0 and 1"));
        }
        let finish = if self.mirror { Finish::Mirror(reflectance) } else { Finish::Diffuse(reflectance) };
        let shape = match (&self.mesh, self.corner, self.u, self.v) {
            (Some(file), None, None, None) => {
                let mesh = scenery::triangles(&place.folder.join(file));
                let mesh = mesh.map_err(|e| wrong("mesh", e.to_string()))?;
                place.count_triangles(mesh.triangles.len()).map_err(|e| wrong("mesh", e.to_string()))?;
                let scale = place.length(positive("scale", Some(self.scale.unwrap_or(1.0)))?);
                if mesh.vertices.iter().any(|v| v.length() * f64::from(scale) > GREATEST) {
                    return Err(wrong("mesh", format!("{file} has a corner beyond ±{GREATEST:e}")));
                }
                let at = place.point(self.at.unwrap_or_default()).as_dvec3();
                let mesh = Mesh::new(&mesh, turned(self.turn), scale.into(), at);
                Shape::Mesh(Arc::new(mesh.map_err(|e| wrong("mesh", e.to_string()))?))
            }
            (None, Some(corner), Some(u), Some(v)) => {
                let [corner, u, v] = [corner, u, v].map(|p| place.point(p));
                if u.cross(v).length() <= 1e-9 * u.length() * v.length() {
                    return Err(wrong("u", "u and v span no area"));
                }
                Shape::Plate(Plate { corner, u, v })
            }
            _ => return Err(wrong("corner", "a surface has corner, u and v, or a mesh")),
        };
        Ok(Surface { shape, finish })
    }
}

/// `[[light]]`
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct LightEntry {
    kind: String,
    at: Option<[f32; 3]>,
    to: Option<[f32; 3]>,
    side: Option<f32>,
    radius: Option<f32>,
    cone: Option<f32>,
    viewer: Option<String>,
    panorama: Option<String>,
    sun_elevation: Option<f32>,
    sun_azimuth: Option<f32>,
    turbidity: Option<f32>,
    turn: Option<[f64; 3]>,
    radiance: Option<f32>,
    power: Option<f32>,
    colour: Option<[f32; 3]>,
    spectrum: Option<String>,
}

impl LightEntry {
    pub(super) fn light(&self, place: &Place) -> Result<Light, Wrong> {
        let all: Vec<&str> = LIGHTS.iter().map(|k| k.name).collect();
        let kind = named("kind", Kind::named(&self.kind), &self.kind, &all)?;
        let emitter = (kind.read)(self, place)?;
        let radiance = match (self.radiance, self.power, emitter.power()) {
            (radiance, None, _) => positive("radiance", radiance)?,
            (None, power, Some(of_one)) => positive("power", power)? / of_one,
            (None, Some(_), None) => return Err(wrong("power", "a light at infinity has a radiance")),
            (Some(_), Some(_), _) => return Err(wrong("power", "a light has a radiance or a power")),
        };
        let colour = self.colour.map_or(Vec3::ONE, |c| rgb::mixture(c.into()));
        Ok(Light::new(emitter, illuminant("spectrum", self.spectrum.as_deref())?, colour * radiance))
    }

    /// Its place.
    pub(super) fn at(&self, place: &Place) -> Result<Vec3, Wrong> {
        self.at.map(|p| place.point(p)).ok_or_else(|| wrong("at", "at is missing"))
    }

    /// What it shines at, the first stone unless it says.
    pub(super) fn to(&self, place: &Place) -> Vec3 {
        self.to.map_or(place.centre, |p| place.point(p))
    }

    /// Its side, in the file's unit.
    pub(super) fn side(&self) -> Result<f32, Wrong> {
        positive("side", self.side)
    }

    /// Its radius, in the file's unit.
    pub(super) fn radius(&self) -> Result<f32, Wrong> {
        positive("radius", self.radius)
    }

    /// The full angle of its cone, degrees.
    pub(super) fn cone_deg(&self) -> Result<f32, Wrong> {
        positive("cone", self.cone)
    }

    /// The viewer it is, if any.
    pub(super) fn viewer(&self) -> Result<Option<&'static Viewer>, Wrong> {
        let all: Vec<&str> = VIEWERS.iter().map(|v| v.name).collect();
        self.viewer.as_deref().map(|name| named("viewer", Viewer::named(name), name, &all)).transpose()
    }

    /// The panorama it shows, if any.
    pub(super) fn panorama(&self, place: &Place) -> Result<Option<Panorama>, Wrong> {
        let Some(file) = &self.panorama else { return Ok(None) };
        let sky = Panorama::open(&place.folder.join(file)).map_err(|e| wrong("panorama", e))?;
        place.count_pixels(sky.pixel_count()).map_err(|e| wrong("panorama", e.to_string()))?;
        Ok(Some(sky))
    }

    /// The clear sky that it is a part of.
    pub(super) fn clear_sky(&self) -> Result<ClearSky, Wrong> {
        let within = |key: &'static str, value: Option<f32>, low: f32, high: f32| match value {
            Some(x) if (low..=high).contains(&x) => Ok(x),
            Some(x) => Err(wrong(key, format!("{key} = {x} is not from {low} to {high}"))),
            None => Err(wrong(key, format!("{key} is missing"))),
        };
        Ok(ClearSky::new(
            within("sun-elevation", self.sun_elevation, 0.0, 90.0)?,
            within("sun-azimuth", self.sun_azimuth, -360.0, 360.0)?,
            within("turbidity", Some(self.turbidity.unwrap_or(3.0)), 2.0, 10.0)?,
        ))
    }

    /// How it is turned.
    pub(super) fn turned(&self) -> Mat3 {
        turned(self.turn).as_mat3()
    }
}
