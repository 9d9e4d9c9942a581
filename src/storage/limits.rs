//! Limits on input: one on everything that memory or time grows with.
//!
//! Each is many times what any real stone or scene needs. One factor raises them all, for whoever has
//! such a file and the memory for it; the command line takes it from the environment.

use std::fs::File;
use std::io::{Error, ErrorKind, Read};
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

/// The environment variable that raises every limit.
pub const VARIABLE: &str = "CUTLAB_LIMIT";

/// The highest factor: what is quadratic in a limit is by then ten thousand times as slow.
const HIGHEST: u64 = 100;

static FACTOR: AtomicU64 = AtomicU64::new(1);

/// The most that a file may have of something, before it is raised.
#[derive(Debug, PartialEq, Eq)]
pub struct Limit {
    most: u64,
    /// Of what.
    pub of: &'static str,
}

/// Designs, meshes and what they include.
pub static FILE: Limit = Limit::new(32 << 20, "bytes in a design or mesh with what it includes");
/// TOML takes a hundred times its size in memory.
pub static TOML_DESIGN: Limit = Limit::new(4 << 20, "bytes in a TOML design");
/// XML takes ten times its size in memory.
pub static XML: Limit = Limit::new(16 << 20, "bytes in a Gem Cut Studio design");
/// What a file of that size holds of corners.
pub static XML_NODES: Limit = Limit::new(500_000, "XML elements and texts");
/// The time that the XML reader takes grows with the square of either.
pub static XML_ATTRIBUTES: Limit = Limit::new(100, "attributes of an XML element, or namespaces");
/// Twenty times any real stone. Half-space intersection is quadratic.
pub static FACETS: Limit = Limit::new(10_000, "facets of a stone");
/// Facets squared, for each time the stone is carved anew to place a tier: it bounds time.
pub static SOLVING: Limit = Limit::new(100_000_000, "steps to solve a design's meets");
/// A thousand times the facets of any real stone.
pub static POLYGONS: Limit = Limit::new(500_000, "faces of a mesh");
/// A closed surface has under six a face.
pub static CORNERS: Limit = Limit::new(8 * 500_000, "corners of all faces of a mesh");
/// Many times what any program writes.
pub static PLY_PARTS: Limit = Limit::new(100, "elements of a PLY file, or properties of one");
/// Ten times the facets of any stone.
pub static PLY_LIST: Limit = Limit::new(100_000, "entries of a PLY list");
/// pbrt's own scenes need two.
pub static INCLUDES: Limit = Limit::new(8, "nested levels of Include");
/// A file that is included twice counts twice.
pub static INCLUDED: Limit = Limit::new(1000, "files included");
/// Of pbrt's `AttributeBegin` and `TransformBegin`.
pub static BLOCKS: Limit = Limit::new(1000, "nested blocks of a pbrt scene");
/// Scenes are TOML too.
pub static SCENE: Limit = Limit::new(1 << 20, "bytes in a scene");
/// Stones in one scene.
pub static STONES: Limit = Limit::new(100, "stones in a scene");
/// Surfaces in one scene, each of which every ray is tried against.
pub static SURFACES: Limit = Limit::new(500, "surfaces in a scene");
/// Lights in one scene.
pub static LIGHTS: Limit = Limit::new(500, "lights in a scene");
/// Of all surfaces of one scene: a mesh that is named twice counts twice.
pub static SCENE_TRIANGLES: Limit = Limit::new(2_000_000, "triangles of all meshes in a scene");
/// Of one mesh of a scene. Among equal boxes the builder of the tree finds neighbours in a time that
/// grows with the square of them.
pub static SAME_BOX: Limit = Limit::new(1000, "triangles of a scene's mesh with the same bounds");
/// Of all lights of one scene.
pub static SCENE_PIXELS: Limit = Limit::new(1 << 26, "pixels of all panoramas in a scene");
/// Panoramas as files.
pub static PANORAMA: Limit = Limit::new(256 << 20, "bytes in a panorama");
/// 8192 × 4096: a gigabyte while it is read.
pub static PIXELS: Limit = Limit::new(1 << 25, "pixels of a panorama");
/// No compression that is read puts more pixels into a byte: so a small file cannot claim a large picture.
pub static PIXELS_PER_BYTE: Limit = Limit::new(1024, "pixels of a panorama for each byte of its file");
/// Both maps of the most photons that can be asked for.
pub static PHOTON_MAP: Limit = Limit::new(4 << 30, "bytes in a photon map");
/// Materials and illuminants, and the tables of spectra beside them: a thousand times the size of any.
pub static SPECTRUM: Limit = Limit::new(4 << 20, "bytes in a material, an illuminant or a table beside it");
/// A hundred times what a spectrometer writes from the ultraviolet to the infrared.
pub static SPECTRUM_ROWS: Limit = Limit::new(100_000, "rows in a table of a spectrum");
/// The companion of a table.
pub static COMPANION: Limit = Limit::new(1 << 20, "bytes in a .meta.json");
/// One row of a table that is read back.
pub static ROW: Limit = Limit::new(1 << 20, "bytes in a row of a table");

/// Every limit.
pub static ALL: &[&Limit] = &[
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
    &SPECTRUM_ROWS,
    &COMPANION,
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

    /// The most as it is now, raised or not.
    pub fn max(&self) -> u64 {
        self.most.saturating_mul(FACTOR.load(Ordering::Relaxed))
    }

    /// Refuses `n` of them, counted so far, if that is more.
    pub fn check(&self, n: impl TryInto<u64>) -> Result<(), Exceeded> {
        match n.try_into() {
            Ok(n) if n <= self.max() => Ok(()),
            _ => Err(self.exceeded()),
        }
    }

    /// Refuses `n` of them, which are all, if that is more: the error names the factor that is enough.
    pub fn check_all(&self, n: impl TryInto<u64>) -> Result<(), Exceeded> {
        match n.try_into() {
            Ok(n) if n <= self.max() => Ok(()),
            Ok(n) if n <= self.most.saturating_mul(HIGHEST) => {
                Err(Exceeded { kind: ExceededKind::Enough(n.div_ceil(self.most)), ..self.exceeded() })
            }
            _ => Err(Exceeded { kind: ExceededKind::Never, ..self.exceeded() }),
        }
    }

    /// What is said of more.
    pub fn exceeded(&self) -> Exceeded {
        let way = ExceededKind::Twice(2 * FACTOR.load(Ordering::Relaxed));
        Exceeded { most: self.max(), of: self.of, kind: way }
    }

    /// The bytes at `path`, if the operating system gives them and they are not more. It may be a pipe
    /// or a device: so only for what is named on the command line.
    pub fn read(&self, path: &Path) -> Result<Result<Vec<u8>, Exceeded>, Error> {
        self.read_from(File::open(path)?)
    }

    /// As [`Limit::read`], but only of a regular file.
    pub fn read_regular(&self, path: &Path) -> Result<Result<Vec<u8>, Exceeded>, Error> {
        self.read_from(regular(path)?)
    }

    fn read_from(&self, file: File) -> Result<Result<Vec<u8>, Exceeded>, Error> {
        // a file says how large it is; pipes and devices say 0
        if let Err(exceeded) = self.check_all(file.metadata()?.len()) {
            return Ok(Err(exceeded));
        }
        let mut bytes = Vec::new();
        file.take(self.max().saturating_add(1)).read_to_end(&mut bytes)?;
        Ok(self.check(bytes.len()).map(|()| bytes))
    }
}

/// Opens the file at `path` to be read, if it is one or a link to one: a pipe may never end, a device
/// may do anything, and whoever named it may be a stranger.
pub fn regular(path: &Path) -> Result<File, Error> {
    if !std::fs::metadata(path)?.is_file() {
        return Err(Error::new(ErrorKind::InvalidInput, "it is not a regular file"));
    }
    File::open(path)
}

/// Raises every limit for the rest of the process.
///
/// - `factor`: a whole number from 1 to 100, as text; the error says so in one line
pub fn raise(factor: &str) -> Result<(), String> {
    match factor.parse() {
        Ok(n) if (1..=HIGHEST).contains(&n) => {
            FACTOR.store(n, Ordering::Relaxed);
            Ok(())
        }
        _ => Err(format!(
            "{VARIABLE}='{factor}' in the environment: a whole number from 1 to {HIGHEST} raises every limit so many times"
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_excess_names_the_limit_and_how_to_raise_it() {
        assert_eq!(FACETS.check(10_000usize), Ok(()));
        let error = FACETS.check(10_001usize).expect_err("one too many").to_string();
        assert_eq!(
            error,
            "more than 10000 facets of a stone: the limit; CUTLAB_LIMIT=2 in the environment doubles every limit"
        );
        let said = |n: u64| FACETS.check_all(n).expect_err("too many").to_string();
        assert_eq!(FACETS.check_all(10_000u64), Ok(()));
        assert_eq!(
            said(31_616),
            "more than 10000 facets of a stone: the limit; CUTLAB_LIMIT=4 in the environment is enough"
        );
        assert!(said(10_001).ends_with("CUTLAB_LIMIT=2 in the environment is enough"));
        assert!(said(1_000_000).ends_with("CUTLAB_LIMIT=100 in the environment is enough"));
        assert!(said(1_000_001).ends_with("even CUTLAB_LIMIT=100 in the environment is not enough"));
        assert!(FACETS.check(-1i64).is_err() && FACETS.check(u128::MAX).is_err());
        for wrong in ["", "0", "101", "-1", "2.5", "many"] {
            assert!(raise(wrong).is_err_and(|e| e.contains("from 1 to 100")), "{wrong}");
        }
        let mut names: Vec<_> = ALL.iter().map(|l| l.of).collect();
        names.dedup();
        assert_eq!(names.len(), ALL.len());
    }
}
