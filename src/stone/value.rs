//! A stone: shape, material, size and orientation as one value.

use super::error::StoneError;
use super::grammar::{LIBRARY, StoneSpec};
use super::options::{Orientation, StoneOptions};
use crate::design::{Design, LengthUnit, USUAL_WIDTH_MM, orientation};
#[cfg(feature = "files")]
use crate::formats::{self, Content, Loaded, LoadedMesh};
use crate::geometry::facet_recovery::{Polygon, Stored, facets_of_polygons};
use crate::geometry::{ClosedMesh, Plane, Polyhedron};
use crate::materials::Material;
use crate::parse::display_name;
use glam::{DMat3, DVec3};
use std::ffi::OsStr;
#[cfg(feature = "files")]
use std::path::Path;
use std::sync::Arc;

/// The shape of a stone.
#[derive(Debug, Clone)]
enum Shape {
    /// A convex solid, which the design's facets bound.
    Convex { design: Box<Design>, solid: Polyhedron },
    /// Closed surfaces with concavities, or several, and why they are no convex stone.
    Nonconvex { mesh: Box<ClosedMesh>, problem: Arc<StoneError> },
}

/// A stone: its shape, what it is made of, how large it is, how it stands, and where it came from.
///
/// The table faces +z. Lengths are in [`Stone::unit`]: millimetres, or a file's own unit of which nobody says
/// how large it is.
///
/// ```
/// use cutlab::advanced::stone::Stone;
///
/// let stone = Stone::parse("round-brilliant:crown-angle=35,material=quartz")?.with_width(8.0)?;
/// assert_eq!(stone.facets(), 153);
/// assert_eq!(stone.material().name, "quartz");
/// # Ok::<(), cutlab::advanced::stone::StoneError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Stone {
    name: String,
    shape: Shape,
    unit: LengthUnit,
    material: Material,
    is_material_given: bool,
    format: &'static str,
    warnings: Vec<String>,
    doubt: Option<String>,
}

impl Stone {
    /// The stone that a STONE argument names: a cut of the library or a family, with parameters or not, or a
    /// file of any format, which may be a mesh with concavities; each may say its material.
    ///
    /// Errors name the part of the argument, or the file and the place in it, with what was expected and found.
    pub fn parse(spec: impl AsRef<str>) -> Result<Stone, StoneError> {
        Stone::open(spec.as_ref(), &StoneOptions::default())
    }

    /// As [`Stone::parse`], with what is asked for where the stone does not say so itself.
    ///
    /// - `spec`: may be the name of a file that is not UTF-8; `-` is standard input
    pub fn open(spec: impl AsRef<OsStr>, options: &StoneOptions) -> Result<Stone, StoneError> {
        let spec = spec.as_ref();
        let parts = StoneSpec::parse_within(spec, options.limits)?;
        let name = display_name(spec);
        #[cfg(feature = "files")]
        let stone = Stone::from_content(name, parts.load(options.limits)?)?;
        #[cfg(not(feature = "files"))]
        let stone = Stone::library_cut(name, parts.design(options.limits)?)?;
        stone.oriented(options.orientation)?.made_of(parts.material(), options)
    }

    /// The stone in the bytes of a file, of any format that is read.
    ///
    /// - `name`: shown in errors, and its stem names the stone
    /// - `folder`: where files that it refers to must lie; none refuses them
    #[cfg(feature = "files")]
    pub fn from_bytes(name: &str, bytes: &[u8], folder: Option<&Path>) -> Result<Stone, StoneError> {
        let options = StoneOptions::default();
        let content = formats::read_content_bytes(name, bytes, folder, options.limits)?;
        Stone::from_content(name.into(), content)?.oriented(options.orientation)?.made_of(None, &options)
    }

    /// The stone of a design, made of what it is drawn for, or of diamond.
    pub fn from_design(design: Design) -> Result<Stone, StoneError> {
        let (name, unit) = (design.name.clone(), design.unit);
        let stone = Stone::new(name.clone(), convex(&name, design)?, unit, "design");
        stone.oriented(Orientation::default())?.made_of(None, &StoneOptions::default())
    }

    /// The convex stone that the half-spaces behind `planes` have in common, of diamond.
    pub fn from_planes(name: &str, planes: &[Plane]) -> Result<Stone, StoneError> {
        Stone::from_design(Design::from_facets(name, planes.iter().map(|p| (String::new(), *p))))
    }

    /// The stone of a closed mesh, of diamond; a mesh with concavities too.
    ///
    /// - `vertices`: off by no more than the rounding of `f32`
    /// - `faces`: corners of each, by their places among the vertices, wound in either sense
    /// - `unit`: of the vertices
    pub fn from_mesh(
        name: &str,
        vertices: &[DVec3],
        faces: &[Vec<usize>],
        unit: LengthUnit,
    ) -> Result<Stone, StoneError> {
        let polygon =
            |corners: &Vec<usize>| Polygon { name: "".into(), corners: corners.clone(), normal: None };
        let polygons: Vec<Polygon> = faces.iter().map(polygon).collect();
        let largest = vertices.iter().map(|v| v.abs().max_element()).fold(0.0, f64::max);
        let stored = Stored { corner: largest * 0.5 * f64::from(f32::EPSILON), ..Stored::EXACT };
        let options = StoneOptions::default();
        let wrong = |cause| StoneError::Mesh { stone: name.into(), cause };
        let mut found = facets_of_polygons(vertices, &polygons, stored, options.limits).map_err(wrong)?;
        let mesh = found.take_mesh();
        let shape = match (found.into_facets(), mesh) {
            (Ok(facets), _) => {
                let mut design = Design::from_facets(name, facets);
                design.unit = unit;
                convex(name, design)?
            }
            (Err(cause), Some(mesh)) => {
                Shape::Nonconvex { mesh: Box::new(mesh), problem: Arc::new(wrong(cause)) }
            }
            (Err(cause), None) => return Err(wrong(cause)),
        };
        Stone::new(name.into(), shape, unit, "mesh").oriented(options.orientation)?.made_of(None, &options)
    }

    fn new(name: String, shape: Shape, unit: LengthUnit, format: &'static str) -> Stone {
        let material = Material::drawn_for(None);
        let warnings = Vec::new();
        Stone { name, shape, unit, material, is_material_given: false, format, warnings, doubt: None }
    }

    #[cfg(not(feature = "files"))]
    fn library_cut(name: String, design: Design) -> Result<Stone, StoneError> {
        let unit = design.unit;
        Ok(Stone::new(name.clone(), convex(&name, design)?, unit, LIBRARY))
    }

    #[cfg(feature = "files")]
    fn from_content(name: String, content: Content) -> Result<Stone, StoneError> {
        Ok(match content {
            Content::Design(Loaded { design, format, warnings }) => {
                let unit = design.unit;
                Stone { warnings, ..Stone::new(name.clone(), convex(&name, design)?, unit, format) }
            }
            Content::Mesh(LoadedMesh { mesh, unit, format, warnings, problem }) => {
                let shape = Shape::Nonconvex { mesh, problem: Arc::new(problem.into()) };
                Stone { warnings, ..Stone::new(name, shape, unit, format) }
            }
        })
    }

    /// Stood as it is asked for; a stone of a file that nobody turned and that does not stand table up is doubted.
    fn oriented(mut self, Orientation { up, align }: Orientation) -> Result<Stone, StoneError> {
        if self.format == LIBRARY {
            return Ok(self);
        }
        let up = match (up, align, &self.shape) {
            (Some(up), ..) => up.direction(),
            (None, true, Shape::Convex { solid, .. }) => orientation::up_of(solid),
            (None, true, Shape::Nonconvex { mesh, .. }) => orientation::up_of_body(mesh),
            (None, false, shape) => {
                self.doubt = match shape {
                    Shape::Convex { solid, .. } => orientation::doubt(solid),
                    Shape::Nonconvex { mesh, .. } => orientation::doubt_of_body(mesh),
                };
                self.warnings.extend(self.doubt.clone());
                return Ok(self);
            }
        };
        if up.distance(DVec3::Z) > 1e-9 { self.turned(orientation::turned_up(up)) } else { Ok(self) }
    }

    /// Of its own material, else of what is asked for, else of what its design is drawn for, else of diamond; and
    /// as large as it is asked for.
    fn made_of(mut self, own: Option<&Material>, options: &StoneOptions) -> Result<Stone, StoneError> {
        if let (Some(own), Shape::Convex { design, .. }) = (own, &mut self.shape) {
            design.refractive_index = Some(own.index_d());
        }
        let wrong = |why| StoneError::Material { spec: self.name.clone(), why };
        let asked = match own {
            Some(own) => Some(own.clone()),
            None => options.asked_material().map_err(wrong)?,
        };
        self.is_material_given = asked.is_some();
        self.material = asked
            .unwrap_or_else(|| Material::drawn_for(self.design().and_then(|design| design.refractive_index)));
        match options.size_mm {
            Some(mm) => self.with_width(mm),
            None => Ok(self),
        }
    }

    /// The same stone of another material.
    pub fn with_material(mut self, material: Material) -> Stone {
        self.material = material;
        self.is_material_given = true;
        self
    }

    /// The same stone with another convex shape: a changed design.
    pub fn with_design(mut self, design: Design) -> Result<Stone, StoneError> {
        self.unit = design.unit;
        self.shape = convex(&self.name, design)?;
        Ok(self)
    }

    /// The same shape with a girdle width of `mm`. A width that is not above 0 is refused.
    pub fn with_width(mut self, mm: f64) -> Result<Stone, StoneError> {
        if !(mm > 0.0 && mm.is_finite()) {
            return Err(StoneError::Width { found: mm });
        }
        let k = mm / self.width();
        self.shape = match self.shape {
            Shape::Convex { design, .. } => convex(&self.name, design.scaled_to_mm(k))?,
            Shape::Nonconvex { mesh, problem } => {
                Shape::Nonconvex { mesh: Box::new(mesh.scaled(k)), problem }
            }
        };
        self.unit = LengthUnit::Millimetre;
        Ok(self)
    }

    /// As wide as a stone usually is, [`USUAL_WIDTH_MM`], if nobody says how wide it is.
    pub fn with_usual_width(self) -> Result<Stone, StoneError> {
        if self.unit == LengthUnit::Free { self.with_width(USUAL_WIDTH_MM) } else { Ok(self) }
    }

    /// As wide as a stone usually is, if its colour depends on a size that nobody says ([`Stone::lacks_size`]).
    pub fn with_width_for_colour(self) -> Result<Stone, StoneError> {
        if self.lacks_size() { self.with_usual_width() } else { Ok(self) }
    }

    /// The stone for what needs a convex one of a size: as [`Stone::with_usual_width`].
    pub fn convex_in_mm(self) -> Result<Stone, StoneError> {
        let stone = self.with_usual_width()?;
        stone.convex_design()?;
        Ok(stone)
    }

    /// The same stone turned by `rotation` about the origin; its indices and angles no longer hold and go.
    pub fn turned(mut self, rotation: DMat3) -> Result<Stone, StoneError> {
        self.shape = match self.shape {
            Shape::Convex { design, .. } => convex(&self.name, design.turned(rotation))?,
            Shape::Nonconvex { mesh, problem } => {
                Shape::Nonconvex { mesh: Box::new(mesh.turned(rotation)), problem }
            }
        };
        Ok(self)
    }

    /// The STONE that it was opened by, or its file's or design's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its tiers, names and texts; none for a mesh that is no convex stone.
    pub fn design(&self) -> Option<&Design> {
        if let Shape::Convex { design, .. } = &self.shape { Some(design) } else { None }
    }

    /// The solid that its facets bound; none for a mesh that is no convex stone.
    pub fn solid(&self) -> Option<&Polyhedron> {
        if let Shape::Convex { solid, .. } = &self.shape { Some(solid) } else { None }
    }

    /// The surface of a mesh that is no convex stone; none for one that is.
    pub fn mesh(&self) -> Option<&ClosedMesh> {
        if let Shape::Nonconvex { mesh, .. } = &self.shape { Some(mesh) } else { None }
    }

    /// The design of a convex stone; for a mesh that is none the error says why.
    pub fn convex_design(&self) -> Result<&Design, StoneError> {
        match &self.shape {
            Shape::Convex { design, .. } => Ok(design),
            Shape::Nonconvex { problem, .. } => Err(StoneError::NotConvex(problem.clone())),
        }
    }

    /// As [`Stone::convex_design`], of which nothing else is needed.
    pub fn into_design(self) -> Result<Design, StoneError> {
        match self.shape {
            Shape::Convex { design, .. } => Ok(*design),
            Shape::Nonconvex { problem, .. } => Err(StoneError::NotConvex(problem)),
        }
    }

    /// Why it is no convex stone; none if it is one.
    pub fn why_not_convex(&self) -> Option<&StoneError> {
        if let Shape::Nonconvex { problem, .. } = &self.shape { Some(problem) } else { None }
    }

    /// Number of its facets.
    pub fn facets(&self) -> usize {
        match &self.shape {
            Shape::Convex { solid, .. } => solid.faces.len(),
            Shape::Nonconvex { mesh, .. } => mesh.facets.len(),
        }
    }

    /// Girdle width, in [`Stone::unit`].
    pub fn width(&self) -> f64 {
        match &self.shape {
            Shape::Convex { solid, .. } => solid.width(),
            Shape::Nonconvex { mesh, .. } => mesh.width(),
        }
    }

    /// The unit of its lengths.
    pub fn unit(&self) -> LengthUnit {
        self.unit
    }

    /// What it is made of.
    pub fn material(&self) -> &Material {
        &self.material
    }

    /// What somebody said that it is made of; none if nobody did: it is then of what its design is drawn for, or of
    /// diamond.
    pub fn given_material(&self) -> Option<&Material> {
        self.is_material_given.then_some(&self.material)
    }

    /// Whether its colour depends on a size that nobody says.
    pub fn lacks_size(&self) -> bool {
        self.unit == LengthUnit::Free && !self.material.is_clear()
    }

    /// Name of the format that it came in, or `library`.
    pub fn format(&self) -> &'static str {
        self.format
    }

    /// What had to be overlooked or may surprise, one line each.
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// Why it seems not to stand table up; none if it does, if nothing tells, or if it was turned.
    pub fn orientation_doubt(&self) -> Option<&str> {
        self.doubt.as_deref()
    }
}

/// The shape of a design that another was made into.
fn convex(stone: &str, design: Design) -> Result<Shape, StoneError> {
    let solid = design.solid().map_err(|cause| StoneError::Solid { stone: stone.into(), cause })?;
    Ok(Shape::Convex { design: Box::new(design), solid })
}
