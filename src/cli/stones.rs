//! STONE arguments: opened in parallel, each on its own, and the options about them.

use super::console::Console;
use super::outcome::{Code, Failure};
use super::standing;
use crate::cut::families::Family;
use crate::cut::{Design, USUAL_WIDTH_MM, Unit, families, library};
use crate::formats::{Imported, stone};
use crate::math::typed;
use crate::optics::Material;
use crate::optics::materials::MATERIALS;
use rayon::prelude::*;

/// The stone that every command takes when none is named.
pub const DEFAULT_STONE: &str = "round-brilliant";

/// Opens one STONE; that of a file stands as `--up` or `--align` has it.
pub fn open(spec: &str) -> Result<Imported, Failure> {
    standing::stood(stone::open(spec)?)
}

/// Does `work` for every stone, in parallel; results in the order of `specs`. A stone that fails
/// does not stop the rest.
pub fn each<S: Sync, T: Send>(
    specs: &[S],
    console: &Console,
    what: &'static str,
    work: impl Fn(&S) -> Result<T, Failure> + Sync,
) -> Vec<Result<T, Failure>> {
    let bar = console.progress(specs.len(), what);
    let results = specs
        .par_iter()
        .map(|spec| {
            let result = work(spec);
            bar.inc(1);
            result
        })
        .collect();
    bar.finish_and_clear();
    results
}

/// The exit code of a batch: what went wrong with each stone is known, and how many were good.
pub fn code<T>(results: &[Result<T, Failure>]) -> Code {
    let failed: Vec<Code> = results.iter().filter_map(|r| r.as_ref().err().map(Failure::code)).collect();
    match (failed.len(), results.len()) {
        (0, _) => Code::Done,
        (bad, all) if bad < all => Code::SomeFailed,
        _ if failed.iter().all(|c| *c == Code::Io) => Code::Io,
        _ => Code::NoGoodInput,
    }
}

/// Whether STONE names a cut of the library or a family, with parameters or not.
pub fn is_cut(spec: &str) -> bool {
    stone::cut_name(spec).is_some()
}

/// The family that STONE is made by; none for a file and for a cut of fixed tiers.
pub fn family(spec: &str) -> Option<&'static Family> {
    let name = stone::cut_name(spec)?;
    let family = library::document(name).and_then(Result::ok).and_then(|d| d.family);
    families::family(family.as_deref().unwrap_or(name)).ok()
}

/// Value parser of `--size`.
pub fn millimetres(text: &str) -> Result<f64, String> {
    typed::within(text, typed::Unit::Millimetres, 1e-3..=1e3, "a girdle width is a number of millimetres")
}

/// Value parser of `--polarisation`.
pub fn on_off(text: &str) -> Result<bool, String> {
    match &*text.trim().to_lowercase() {
        "on" => Ok(true),
        "off" => Ok(false),
        _ => Err("polarisation is on or off".into()),
    }
}

/// Value parser of `--material`.
pub fn material(name: &str) -> Result<&'static Material, String> {
    Material::named(name).ok_or_else(|| {
        let near = typed::nearest(name, MATERIALS.iter().map(|m| m.name.as_ref()));
        format!("no material is called '{name}'{} (all: cutlab list materials)", typed::suggestion(near))
    })
}

/// Value parser of `--ri`.
pub fn refractive_index(text: &str) -> Result<f64, String> {
    typed::within(text, typed::Unit::None, 1.0..=10.0, "a refractive index is a number")
}

/// What a stone is made of, as asked for on the command line.
#[derive(Debug, Clone, Copy, clap::Args)]
pub struct Substance {
    /// Material, see `cutlab list materials` [the file's own index, or diamond]
    #[arg(long, value_name = "NAME", value_parser = material)]
    pub material: Option<&'static Material>,
    /// One refractive index, without dispersion, in place of a material
    #[arg(long, value_name = "N", value_parser = refractive_index, conflicts_with = "material")]
    pub ri: Option<f64>,
}

impl Substance {
    /// Says once if the index of the material asked for is a guess within `from`..=`to` (µm).
    pub fn note_range(&self, from: f64, to: f64, console: &Console) {
        if let Some(guess) = self.material.and_then(|m| m.extrapolated(from, to)) {
            console.note(&format!("note: {guess}"));
        }
    }

    /// What was asked for on the command line, if anything.
    pub fn asked(&self) -> Option<Material> {
        self.material.cloned().or(self.ri.map(Material::of_index))
    }

    /// What the design is made of: the material asked for, or the bare index asked for, or the
    /// index that its file was drawn for, or diamond.
    pub fn of(&self, design: &Design) -> Material {
        self.drawn_for(design.refractive_index)
    }

    /// As [`Substance::of`], for a stone without a design.
    ///
    /// - `index`: that its file was drawn for, if any
    pub fn drawn_for(&self, index: Option<f64>) -> Material {
        self.material.cloned().unwrap_or_else(|| Material::drawn_for(self.ri.or(index)))
    }
}

/// Girdle width of a stone of which nobody says how large it is, in millimetres.
pub const USUAL_SIZE: f64 = USUAL_WIDTH_MM;

/// [`USUAL_SIZE`] for a design without unit in a material whose colour depends on the size.
pub fn usual_size(design: &Design, material: &Material) -> Option<f64> {
    (design.unit == Unit::Free && !material.is_clear()).then_some(USUAL_SIZE)
}

/// The stone's design as large as its colour needs to know: with `--size` applied, or as it is, or
/// 6.5 mm wide if its file has no unit and the material absorbs, which is noted.
pub fn sized_for_colour(
    design: Design,
    size: Option<f64>,
    material: &Material,
    console: &Console,
) -> Result<Design, Failure> {
    let usual = usual_size(&design, material).filter(|_| size.is_none());
    if let Some(mm) = usual {
        console.note(&format!(
            "note: {} has no size, which its colour depends on: taken as {mm} mm wide; --size MM sets it",
            design.name
        ));
    }
    sized(design, size.or(usual))
}

/// The stone's design, with `--size` applied.
pub fn sized(design: Design, size: Option<f64>) -> Result<Design, Failure> {
    Ok(match size {
        Some(mm) => design.sized(mm)?,
        None => design,
    })
}

/// A file name for a stone: the cut's name, or the file's without folder and ending.
pub fn file_stem(spec: &str) -> String {
    let name = spec.split(':').next().unwrap_or(spec);
    let stem = std::path::Path::new(name).file_stem().unwrap_or_default().to_string_lossy();
    if stem.is_empty() || spec == stone::STANDARD_INPUT { "stone".into() } else { stem.into_owned() }
}
