//! Limits on input: one on everything that memory or time grows with.
//!
//! Each is many times what any real stone or scene needs. One factor raises them all, for whoever has
//! such a file and the memory for it. It is part of a value, [`Limits`], that whoever reads is given; the
//! command line makes one from the environment.

use std::str::FromStr;

/// The environment variable that raises every limit.
pub const VARIABLE: &str = "CUTLAB_LIMIT";

/// The highest factor: what is quadratic in a limit is by then ten thousand times as slow.
const HIGHEST: u64 = 100;

/// The most that a file may have of something, before it is raised.
#[derive(Debug, PartialEq, Eq)]
pub struct Limit {
    most: u64,
    /// Of what.
    pub of: &'static str,
}

/// Designs, meshes and what they include.
pub const FILE: Limit = Limit::new(32 << 20, "bytes in a design or mesh with what it includes");
/// TOML takes a hundred times its size in memory.
pub const TOML_DESIGN: Limit = Limit::new(4 << 20, "bytes in a TOML design");
/// XML takes ten times its size in memory.
pub const XML: Limit = Limit::new(16 << 20, "bytes in a Gem Cut Studio design");
/// What a file of that size holds of corners.
pub const XML_NODES: Limit = Limit::new(500_000, "XML elements and texts");
/// The time that the XML reader takes grows with the square of either.
pub const XML_ATTRIBUTES: Limit = Limit::new(100, "attributes of an XML element, or namespaces");
/// Twenty times any real stone. Half-space intersection is quadratic.
pub const FACETS: Limit = Limit::new(10_000, "facets of a stone");
/// Facets squared, for each time the stone is carved anew to place a tier: it bounds time.
pub const SOLVING: Limit = Limit::new(100_000_000, "steps to solve a design's meets");
/// A thousand times the facets of any real stone.
pub const POLYGONS: Limit = Limit::new(500_000, "faces of a mesh");
/// A closed surface has under six a face.
pub const CORNERS: Limit = Limit::new(8 * 500_000, "corners of all faces of a mesh");
/// Many times what any program writes.
pub const PLY_PARTS: Limit = Limit::new(100, "elements of a PLY file, or properties of one");
/// Ten times the facets of any stone.
pub const PLY_LIST: Limit = Limit::new(100_000, "entries of a PLY list");
/// pbrt's own scenes need two.
pub const INCLUDES: Limit = Limit::new(8, "nested levels of Include");
/// A file that is included twice counts twice.
pub const INCLUDED: Limit = Limit::new(1000, "files included");
/// Of pbrt's `AttributeBegin` and `TransformBegin`.
pub const BLOCKS: Limit = Limit::new(1000, "nested blocks of a pbrt scene");
/// Scenes are TOML too.
pub const SCENE: Limit = Limit::new(1 << 20, "bytes in a scene");
/// Stones in one scene.
pub const STONES: Limit = Limit::new(100, "stones in a scene");
/// Surfaces in one scene, each of which every ray is tried against.
pub const SURFACES: Limit = Limit::new(500, "surfaces in a scene");
/// Lights in one scene.
pub const LIGHTS: Limit = Limit::new(500, "lights in a scene");
/// Of all surfaces of one scene: a mesh that is named twice counts twice.
pub const SCENE_TRIANGLES: Limit = Limit::new(2_000_000, "triangles of all meshes in a scene");
/// Of one mesh of a scene. Among equal boxes the builder of the tree finds neighbours in a time that
/// grows with the square of them.
pub const SAME_BOX: Limit = Limit::new(1000, "triangles of a scene's mesh with the same bounds");
/// Of all lights of one scene.
pub const SCENE_PIXELS: Limit = Limit::new(1 << 26, "pixels of all panoramas in a scene");
/// Panoramas as files.
pub const PANORAMA: Limit = Limit::new(256 << 20, "bytes in a panorama");
/// 8192 × 4096: a gigabyte while it is read.
pub const PIXELS: Limit = Limit::new(1 << 25, "pixels of a panorama");
/// No compression that is read puts more pixels into a byte: so a small file cannot claim a large picture.
pub const PIXELS_PER_BYTE: Limit = Limit::new(1024, "pixels of a panorama for each byte of its file");
/// Both maps of the most photons that can be asked for.
pub const PHOTON_MAP: Limit = Limit::new(4 << 30, "bytes in a photon map");
/// Materials and illuminants, and the tables of spectra beside them: a thousand times the size of any.
pub const SPECTRUM: Limit = Limit::new(4 << 20, "bytes in a material, an illuminant or a table beside it");
/// The sidecar of a table.
pub const SIDECAR: Limit = Limit::new(1 << 20, "bytes in a .meta.json");
/// One row of a table that is read back.
pub const ROW: Limit = Limit::new(1 << 20, "bytes in a row of a table");

/// Every limit.
pub const ALL: &[&Limit] = &[
    &FILE,
    &TOML_DESIGN,
    &XML,
    &XML_NODES,
    &XML_ATTRIBUTES,
    &FACETS,
    &SOLVING,
    &POLYGONS,
    &CORNERS,
    &PLY_PARTS,
    &PLY_LIST,
    &INCLUDES,
    &INCLUDED,
    &BLOCKS,
    &SCENE,
    &STONES,
    &SURFACES,
    &LIGHTS,
    &SCENE_TRIANGLES,
    &SAME_BOX,
    &SCENE_PIXELS,
    &PANORAMA,
    &PIXELS,
    &PIXELS_PER_BYTE,
    &PHOTON_MAP,
    &SPECTRUM,
    &SIDECAR,
    &ROW,
];

/// More than a limit allows. One line that says how to raise it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("more than {most} {of}: the limit; {}", .kind.describe())]
pub struct Exceeded {
    most: u64,
    of: &'static str,
    kind: ExceededKind,
}

/// How a limit is raised far enough.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ExceededKind {
    /// By this factor.
    Enough(u64),
    /// By none.
    Never,
    /// Nobody has counted: by this factor all are twice what they are now.
    Twice(u64),
}

impl ExceededKind {
    fn describe(self) -> String {
        match self {
            ExceededKind::Enough(factor) => format!("{VARIABLE}={factor} in the environment is enough"),
            ExceededKind::Never => format!("even {VARIABLE}={HIGHEST} in the environment is not enough"),
            ExceededKind::Twice(factor) => {
                format!("{VARIABLE}={factor} in the environment doubles every limit")
            }
        }
    }
}

impl Limit {
    const fn new(most: u64, of: &'static str) -> Limit {
        Limit { most, of }
    }
}

/// The limits that a reader keeps to: every [`Limit`], so many times as high.
///
/// ```
/// use cutlab::{Limits, Stone, StoneOptions};
///
/// let limits: Limits = "4".parse().unwrap(); // four times as much of everything is read
/// let options = StoneOptions::default().limits(limits);
/// assert!(Stone::open("tolkowsky", &options).is_ok());
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// At least 1.
    factor: u64,
}

impl Default for Limits {
    /// As they are.
    fn default() -> Limits {
        Limits { factor: 1 }
    }
}

/// A factor that raises no limits. One line.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "{VARIABLE}='{0}' in the environment: a whole number from 1 to {HIGHEST} raises every limit so many times"
)]
pub struct FactorError(String);

impl FromStr for Limits {
    type Err = FactorError;

    fn from_str(factor: &str) -> Result<Limits, FactorError> {
        factor.parse().map_err(|_| FactorError(factor.into())).and_then(Limits::raised)
    }
}

impl Limits {
    /// Every limit, raised `factor` times: from 1 to 100.
    pub fn raised(factor: u64) -> Result<Limits, FactorError> {
        match factor {
            1..=HIGHEST => Ok(Limits { factor }),
            _ => Err(FactorError(factor.to_string())),
        }
    }

    /// The most that there may be.
    pub fn max(self, limit: &Limit) -> u64 {
        limit.most.saturating_mul(self.factor)
    }

    /// Refuses `n` of them, counted so far, if that is more.
    pub fn check(self, limit: &Limit, n: impl TryInto<u64>) -> Result<(), Exceeded> {
        match n.try_into() {
            Ok(n) if n <= self.max(limit) => Ok(()),
            _ => Err(self.exceeded(limit)),
        }
    }

    /// Refuses `n` of them, which are all, if that is more: the error names the factor that is enough.
    pub fn check_all(self, limit: &Limit, n: impl TryInto<u64>) -> Result<(), Exceeded> {
        let exceeded = |kind| Exceeded { kind, ..self.exceeded(limit) };
        match n.try_into() {
            Ok(n) if n <= self.max(limit) => Ok(()),
            Ok(n) if n <= limit.most.saturating_mul(HIGHEST) => {
                Err(exceeded(ExceededKind::Enough(n.div_ceil(limit.most))))
            }
            _ => Err(exceeded(ExceededKind::Never)),
        }
    }

    /// What is said of more.
    pub fn exceeded(self, limit: &Limit) -> Exceeded {
        Exceeded { most: self.max(limit), of: limit.of, kind: ExceededKind::Twice(2 * self.factor) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_excess_names_the_limit_and_how_to_raise_it() {
        let limits = Limits::default();
        assert_eq!(limits.check(&FACETS, 10_000usize), Ok(()));
        let error = limits.check(&FACETS, 10_001usize).expect_err("one too many").to_string();
        assert_eq!(
            error,
            "more than 10000 facets of a stone: the limit; CUTLAB_LIMIT=2 in the environment doubles every limit"
        );
        let said = |n: u64| limits.check_all(&FACETS, n).expect_err("too many").to_string();
        assert_eq!(limits.check_all(&FACETS, 10_000u64), Ok(()));
        assert_eq!(
            said(31_616),
            "more than 10000 facets of a stone: the limit; CUTLAB_LIMIT=4 in the environment is enough"
        );
        assert!(said(10_001).ends_with("CUTLAB_LIMIT=2 in the environment is enough"));
        assert!(said(1_000_000).ends_with("CUTLAB_LIMIT=100 in the environment is enough"));
        assert!(said(1_000_001).ends_with("even CUTLAB_LIMIT=100 in the environment is not enough"));
        assert!(limits.check(&FACETS, -1i64).is_err() && limits.check(&FACETS, u128::MAX).is_err());
        for wrong in ["", "0", "101", "-1", "2.5", "many"] {
            let error = wrong.parse::<Limits>().expect_err(wrong).to_string();
            assert!(error.contains("from 1 to 100") && error.contains(&format!("'{wrong}'")), "{error}");
        }
        let three = Limits::raised(3).expect("a factor");
        assert_eq!((three.max(&FACETS), "3".parse()), (30_000, Ok(three)));
        assert_eq!(three.check(&FACETS, 30_000u64), Ok(()));
        assert!(
            three
                .exceeded(&FACETS)
                .to_string()
                .ends_with("CUTLAB_LIMIT=6 in the environment doubles every limit")
        );
        let mut names: Vec<_> = ALL.iter().map(|l| l.of).collect();
        names.dedup();
        assert_eq!(names.len(), ALL.len());
    }
}
