//! Schema of scene files: the entries for camera and stones, and how each becomes a part of the scene.

use super::build_context::{BuildContext, GREATEST, SceneOverrides, stone_to_trace};
pub use super::field_error::FieldError;
pub(super) use super::field_error::{field_error, require_name};
use super::file_access::Files;
use super::named_data;
use super::{Camera, Lens, PlacedStone, Pose};
use crate::design::Design;
use crate::design::{families, library};
use crate::formats;
use crate::limits::Limits;
use crate::materials::Material;
use crate::stone::{StoneError, grammar};
use crate::trace::ConvexStone;
use glam::{DMat3, Vec3};
use serde::Deserialize;

/// A number above 0.
pub(super) fn positive(key: &'static str, value: Option<f32>) -> Result<f32, FieldError> {
    match value {
        Some(x) if x > 0.0 && x.is_finite() => Ok(x),
        Some(x) => Err(field_error(key, format!("{key} = {x} is not a number above 0"))),
        None => Err(field_error(key, format!("{key} is missing"))),
    }
}

/// Least length, in world units, of what is to have an area: squares of less leave the range of `f32`.
pub(super) const LEAST: f32 = 1e-6;

/// A length in the world that is long enough to span an area.
///
/// - `value`: in the file's unit
pub(super) fn span(key: &'static str, value: Option<f32>, place: &BuildContext) -> Result<f32, FieldError> {
    let length = place.length(positive(key, value)?);
    if length < LEAST {
        return Err(field_error(
            key,
            format!("{key} = {} is too small to have an area", length / place.unit),
        ));
    }
    Ok(length)
}

/// Turns about x, then y, then z, in degrees.
pub(super) fn turned(turn: Option<[f64; 3]>) -> DMat3 {
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
    #[serde(default)]
    colours: Colours,
}

/// How a camera sees colours.
#[derive(Debug, Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Colours {
    /// As an eye does.
    #[default]
    Eye,
    /// White, red, green, blue or black, whichever most of the light is.
    Flat,
}

/// Most stops that an exposure changes a picture by.
const MOST_STOPS: f32 = 30.0;

/// How wide the lens is: a diameter in the file's unit, or an f-number such as "f/8".
#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
enum Aperture {
    Diameter(f32),
    Number(String),
}

/// Focus: a distance along the view, or the plane across the view through a point.
#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
enum Focus {
    Distance(f32),
    Point([f32; 3]),
}

impl CameraEntry {
    /// The illuminant that it shows as white.
    pub(super) fn white(&self) -> Option<&str> {
        self.white.as_deref()
    }

    pub(super) fn camera(&self, place: &BuildContext, aspect: f32) -> Result<Camera, FieldError> {
        let lens = match (self.field, self.field_short, self.width) {
            (Some(deg), None, None) if deg > 0.0 && deg < 175.0 => Lens::Perspective(deg),
            (None, Some(deg), None) if deg > 0.0 && deg < 150.0 => {
                let half = (0.5 * deg.to_radians()).tan() * aspect.max(1.0);
                Lens::Perspective(2.0 * half.atan().to_degrees())
            }
            (None, None, width @ Some(_)) => Lens::Orthographic(place.length(positive("width", width)?)),
            (Some(_), None, None) => {
                return Err(field_error("field", "a field is an angle from 0 to 175 degrees"));
            }
            (None, Some(_), None) => {
                return Err(field_error("field-short", "a short field is an angle from 0 to 150 degrees"));
            }
            _ => {
                return Err(field_error(
                    "field",
                    "a camera has one of field (degrees), field-short or width",
                ));
            }
        };
        let position = place.point(self.at);
        let target = self.to.map_or(place.centre, |p| place.point(p));
        if position.distance(target) < 1e-6 {
            return Err(field_error("at", "the camera stands where it looks"));
        }
        let lens = self.opened(lens, place, position, target)?;
        let white = named_data::illuminant("white", self.white.as_deref(), place.files, place.limits)?;
        if self.exposure.abs() > MOST_STOPS {
            let most = format!("an exposure is a number of stops from -{MOST_STOPS} to {MOST_STOPS}");
            return Err(field_error("exposure", most));
        }
        let flat = matches!(self.colours, Colours::Flat);
        Ok(Camera { position, target, lens, aspect, stops: self.exposure, white, flat })
    }

    /// The lens with its aperture, if it has one.
    fn opened(
        &self,
        lens: Lens,
        place: &BuildContext,
        position: Vec3,
        target: Vec3,
    ) -> Result<Lens, FieldError> {
        let field_deg = match (&self.aperture, &self.focus, lens) {
            (None, None, _) => return Ok(lens),
            (None, Some(_), _) => {
                return Err(field_error("focus", "without an aperture everything is in focus"));
            }
            (Some(_), _, Lens::Perspective(field_deg)) => field_deg,
            (Some(_), ..) => {
                return Err(field_error(
                    "aperture",
                    "parallel rays have no aperture: give field instead of width",
                ));
            }
        };
        let forward = (target - position).normalize();
        let focus = match self.focus {
            None => target.distance(position),
            Some(Focus::Distance(distance)) => place.length(distance),
            Some(Focus::Point(point)) => (place.point(point) - position).dot(forward),
        };
        if focus <= 1e-6 {
            return Err(field_error("focus", "what is in focus lies before the camera"));
        }
        let diameter = match &self.aperture {
            Some(Aperture::Number(text)) => {
                let number = text.strip_prefix("f/").and_then(|n| n.parse().ok());
                let number = number.filter(|n: &f32| *n > 0.0 && n.is_finite());
                let number = number.ok_or_else(|| {
                    field_error(
                        "aperture",
                        format!("aperture '{text}' is neither a diameter nor an f-number such as \"f/8\""),
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

    /// The material that it names.
    pub(super) fn material(&self) -> Option<&str> {
        self.material.as_deref()
    }

    /// The design of that STONE: of the library, or of a regular file beside the scene.
    pub(super) fn design(&self, files: &Files, limits: Limits) -> Result<Design, FieldError> {
        let cut = self.cut();
        let name = cut.split(':').next().unwrap_or_default();
        let known = library::names().any(|n| n == name) || families::family(name).is_ok();
        let opened = if known {
            grammar::load_regular(cut, limits)
        } else {
            let path = files.find("cut", cut)?;
            if path.exists() {
                formats::read_regular(&path, limits).map_err(StoneError::from)
            } else {
                Err(StoneError::NoSuchStone { spec: cut.into(), nearest: library::nearest(name) })
            }
        };
        Ok(opened.map_err(|e| field_error("cut", e.to_string()))?.design)
    }

    /// The stone and what it is made of: as the overrides say, else the entry, else the design's own index,
    /// else diamond.
    pub(super) fn stone(
        &self,
        design: Design,
        cast: &SceneOverrides,
        files: &Files,
    ) -> Result<(ConvexStone, Material), FieldError> {
        let material = match (&cast.material, &self.material, design.refractive_index) {
            (Some(material), _, _) => material.clone(),
            (None, Some(name), _) => named_data::material(name, files, cast.limits)?,
            (None, None, Some(n)) => Material::from_index(n),
            (None, None, None) => Material::diamond().clone(),
        };
        let size = cast.size_mm.or(self.size);
        if size.is_some_and(|mm| !(1e-3..=1e3).contains(&mm)) {
            return Err(field_error("size", "a size is a number of millimetres from 0.001 to 1000"));
        }
        Ok((stone_to_trace(design, size).map_err(|e| field_error("cut", e))?, material))
    }

    /// Places the stone.
    pub(super) fn place(
        &self,
        stone: ConvexStone,
        material: Material,
        unit: f32,
        pose: Option<Pose>,
    ) -> Result<PlacedStone, FieldError> {
        let pose = match (&self.pose, pose) {
            (_, Some(pose)) => pose,
            (None, None) => Pose::Lying,
            (Some(name), None) => {
                require_name("pose", Pose::by_name(name), name, &Pose::ALL.map(|(n, _)| n))?
            }
        };
        let turn = turned(self.turn) * pose.rotation(&stone.solid);
        let radius = match self.radius {
            Some(_) => {
                let radius = positive("radius", self.radius)? * unit;
                if !(LEAST..=GREATEST as f32).contains(&radius) {
                    return Err(field_error(
                        "radius",
                        format!("a radius of {radius} is too small or too large"),
                    ));
                }
                radius
            }
            None => stone.unit as f32,
        };
        let at = self.at.clone().unwrap_or_else(|| vec![0.0, 0.0]);
        match at[..] {
            [x, y] => Ok(PlacedStone::resting_on(stone, material, turn, radius, Vec3::new(x, y, 0.0) * unit)),
            [x, y, z] => {
                let placed = PlacedStone::resting_on(stone, material, turn, radius, Vec3::ZERO);
                Ok(PlacedStone { position: Vec3::new(x, y, z) * unit, ..placed })
            }
            _ => Err(field_error("at", "at is [x, y] on the floor or [x, y, z]")),
        }
    }
}
