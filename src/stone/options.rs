//! Stone options: what a STONE is made of, how large it is and how it stands, where it does not say so itself.

use crate::limits::Limits;
use crate::materials::Material;
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// What is asked for of every stone of a request. A stone that says it itself (`D.asc:material=topaz`) is as
/// it says.
///
/// ```
/// use cutlab::{Stone, StoneOptions};
///
/// let options = StoneOptions::default().material("topaz").size_mm(9.0);
/// let stone = Stone::open("emerald", &options)?;
/// assert!(stone.material().name == "topaz" && (stone.width() - 9.0).abs() < 1e-9);
/// # Ok::<(), cutlab::Error>(())
/// ```
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[non_exhaustive]
pub struct StoneOptions {
    /// A material of the catalogue, by name, or a file of one; none for what each design is drawn for, or diamond.
    pub material: Option<String>,
    /// One refractive index, without dispersion, in place of a material.
    pub ri: Option<f64>,
    /// Girdle width in millimetres; none for each stone's own.
    pub size_mm: Option<f64>,
    /// How the stones of files are turned.
    pub orientation: Orientation,
    /// The material in place of the one that is named, opened already.
    #[serde(skip)]
    pub opened_material: Option<Material>,
    /// Limits on the files that are read. They are no part of what is asked for: within any of them the stone is the
    /// same.
    #[serde(skip)]
    pub limits: Limits,
}

impl StoneOptions {
    /// Of a material of the catalogue, by name, or of the file of one.
    pub fn material(mut self, name: impl Into<String>) -> StoneOptions {
        self.material = Some(name.into());
        self
    }

    /// Of a material that is opened already.
    pub fn opened_material(mut self, material: Material) -> StoneOptions {
        self.opened_material = Some(material);
        self
    }

    /// With one refractive index, without dispersion, in place of a material.
    pub fn ri(mut self, index: f64) -> StoneOptions {
        self.ri = Some(index);
        self
    }

    /// With a girdle width in millimetres.
    pub fn size_mm(mut self, mm: f64) -> StoneOptions {
        self.size_mm = Some(mm);
        self
    }

    /// The same options, with each stone as wide as it is.
    pub fn without_size(&self) -> StoneOptions {
        StoneOptions { size_mm: None, ..self.clone() }
    }

    /// With the stones of files turned.
    pub fn orientation(mut self, orientation: Orientation) -> StoneOptions {
        self.orientation = orientation;
        self
    }

    /// With limits on the files that are read.
    pub fn limits(mut self, limits: Limits) -> StoneOptions {
        self.limits = limits;
        self
    }

    /// The material or bare index asked for, if any; the error says that there is no such material.
    pub fn asked_material(&self) -> Result<Option<Material>, String> {
        match (&self.opened_material, &self.material, self.ri) {
            (Some(material), ..) => Ok(Some(material.clone())),
            (None, Some(name), _) => Material::open(name, self.limits).map(Some),
            (None, None, Some(index)) => Ok(Some(Material::from_index(index))),
            (None, None, None) => Ok(None),
        }
    }
}

/// How the stones of files are turned before anything else.
///
/// ```
/// use cutlab::{Orientation, Stone, StoneOptions, UpAxis};
///
/// let options = StoneOptions::default().orientation(Orientation::default().up(UpAxis::Y));
/// // stones of files are turned, cuts of the library stand as they do
/// assert!(Stone::open("tolkowsky", &options)?.orientation_doubt().is_none());
/// # Ok::<(), cutlab::Error>(())
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[non_exhaustive]
pub struct Orientation {
    /// The axis of the file that points up, through the table; none for z.
    pub up: Option<UpAxis>,
    /// Whether a stone is stood upright by its axis of symmetry, or else by its largest facet.
    pub align: bool,
}

impl Orientation {
    /// With the axis of the file that points up, through the table.
    pub fn up(mut self, axis: UpAxis) -> Orientation {
        self.up = Some(axis);
        self
    }

    /// Whether a stone is stood upright by its axis of symmetry, or else by its largest facet.
    pub fn align(mut self, align: bool) -> Orientation {
        self.align = align;
        self
    }
}

/// An axis of a file's frame.
///
/// ```
/// use cutlab::UpAxis;
/// use cutlab::glam::DVec3;
///
/// assert_eq!((UpAxis::NegY.name(), UpAxis::NegY.direction()), ("-y", DVec3::NEG_Y));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum UpAxis {
    /// +x
    #[serde(rename = "x")]
    X,
    /// +y
    #[serde(rename = "y")]
    Y,
    /// +z
    #[serde(rename = "z")]
    Z,
    /// −x
    #[serde(rename = "-x")]
    NegX,
    /// −y
    #[serde(rename = "-y")]
    NegY,
    /// −z
    #[serde(rename = "-z")]
    NegZ,
}

impl UpAxis {
    /// Every axis with its name.
    pub const ALL: [(&str, UpAxis); 6] = [
        ("x", UpAxis::X),
        ("y", UpAxis::Y),
        ("z", UpAxis::Z),
        ("-x", UpAxis::NegX),
        ("-y", UpAxis::NegY),
        ("-z", UpAxis::NegZ),
    ];

    /// As a unit vector.
    pub fn direction(self) -> DVec3 {
        match self {
            UpAxis::X => DVec3::X,
            UpAxis::Y => DVec3::Y,
            UpAxis::Z => DVec3::Z,
            UpAxis::NegX => DVec3::NEG_X,
            UpAxis::NegY => DVec3::NEG_Y,
            UpAxis::NegZ => DVec3::NEG_Z,
        }
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        UpAxis::ALL.iter().find(|(_, axis)| *axis == self).map_or("z", |(name, _)| name)
    }
}
