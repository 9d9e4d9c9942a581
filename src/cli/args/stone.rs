//! STONE arguments: opened in parallel, each on its own, and the options about them.

use super::material::material;
use super::orientation;
use crate::cli::console::Console;
use crate::cli::exit_code::{CliError, ExitStatus};
use crate::design::families::Family;
use crate::design::{Design, LengthUnit, USUAL_WIDTH_MM, families, library};
use crate::formats::Loaded;
use crate::materials::Material;
use crate::parse;
use crate::stone_spec;
pub use crate::storage::text::display_name;
use rayon::prelude::*;
use std::ffi::{OsStr, OsString};
use std::path::Path;

/// The stone that every command takes when none is named.
pub const DEFAULT_STONE: &str = "round-brilliant";

/// A STONE as it is named: a cut or a file, and what it is of, if it says so itself
/// (`D.asc:material=topaz`, `oval:table=57,ri=2.2`).
#[derive(Debug, Clone)]
pub struct StoneSpec {
    base: OsString,
    /// The items that say what it is of, as written.
    own: Vec<String>,
    substance: MaterialArgs,
}

impl StoneSpec {
    /// The parts of a STONE. The name of a file that is there is taken as it is, whatever it holds.
    pub fn parse(argument: impl AsRef<OsStr>) -> Result<StoneSpec, CliError> {
        let argument = argument.as_ref();
        let mut spec =
            StoneSpec { base: argument.into(), own: Vec::new(), substance: MaterialArgs::default() };
        if Path::new(argument).symlink_metadata().is_ok() {
            return Ok(spec);
        }
        let has_key = |item: &str, name: &str| {
            item.split_once('=').is_some_and(|(key, _)| key.trim().eq_ignore_ascii_case(name))
        };
        let is_own = |item: &&str| has_key(item, MATERIAL) || has_key(item, INDEX);
        let Some((name, items)) = parted(argument) else { return Ok(spec) };
        let (own, rest): (Vec<&str>, Vec<&str>) = items.split(',').partition(is_own);
        if own.is_empty() {
            return Ok(spec);
        }
        if let (Some(found), false) = (rest.first(), is_cut(&name)) {
            if Path::new(&name).symlink_metadata().is_err() {
                return Ok(spec);
            }
            let why = match own.last().filter(|_| parse::parse_number(found, parse::NumberUnit::None).is_ok())
            {
                Some(item) => format!("write decimals with a point, as {item}.{}", found.trim()),
                None => format!("a file takes {MATERIAL}=NAME or {INDEX}=N"),
            };
            return Err(CliError::input(format!("{}, at '{found}': {why}", display_name(argument))));
        }
        for item in &own {
            let (_, value) = item.split_once('=').unwrap_or_default();
            let given_twice =
                || CliError::input(format!("{}: one material or index", display_name(argument)));
            if spec.substance.material.is_some() || spec.substance.ri.is_some() {
                return Err(given_twice());
            }
            let wrong = |why: String| CliError::input(format!("{}: {why}", display_name(argument)));
            if has_key(item, MATERIAL) {
                spec.substance.material = Some(material(value.trim()).map_err(wrong)?);
            } else {
                spec.substance.ri = Some(refractive_index(value.trim()).map_err(wrong)?);
            }
        }
        spec.own = own.iter().map(|item| item.trim().to_owned()).collect();
        spec.base = name;
        if !rest.is_empty() {
            spec.base.push(":");
            spec.base.push(rest.join(","));
        }
        Ok(spec)
    }

    /// The cut or file, without what it is of.
    pub fn base(&self) -> &OsStr {
        &self.base
    }

    /// What it is of, as written: `material=topaz`.
    pub fn own(&self) -> &[String] {
        &self.own
    }

    /// Another file of the same.
    pub fn applied_to(&self, mut file: OsString) -> OsString {
        if !self.own.is_empty() {
            file.push(":");
            file.push(self.own.join(","));
        }
        file
    }
}

const MATERIAL: &str = "material";
const INDEX: &str = "ri";

/// What stands before and after the colon of a STONE: the first of a cut's, the last of a file's.
fn parted(argument: &OsStr) -> Option<(OsString, &str)> {
    if let Some(text) = argument.to_str() {
        let at = if is_cut(text) { text.find(':') } else { text.rfind(':') }?;
        return Some((text[..at].into(), &text[at + 1..]));
    }
    #[cfg(unix)]
    {
        use std::os::unix::ffi::OsStrExt;
        let bytes = argument.as_bytes();
        let at = bytes.iter().rposition(|b| *b == b':')?;
        Some((OsStr::from_bytes(&bytes[..at]).into(), std::str::from_utf8(&bytes[at + 1..]).ok()?))
    }
    #[cfg(not(unix))]
    None
}

/// Opens one STONE; that of a file stands as `--up` or `--align` has it. A material or index that it names
/// itself is what its design is drawn for.
pub fn open(argument: impl AsRef<OsStr>) -> Result<Loaded, CliError> {
    let spec = StoneSpec::parse(argument)?;
    let path = Path::new(spec.base());
    if !is_cut(spec.base()) && path.is_dir() {
        let name = display_name(path);
        std::fs::read_dir(path).map_err(|cause| CliError::reading(&name, &cause))?;
        return Err(CliError::input(format!(
            "{name} is a folder, and here one stone is named: name a file in it"
        )));
    }
    let mut imported =
        orientation::orient(stone_spec::open(spec.base()).map_err(|e| orientation::stood_body(e.into()))?)?;
    if let Some(material) = spec.substance.asked() {
        imported.design.refractive_index = Some(material.index_d());
    }
    Ok(imported)
}

/// Does `work` for every stone, in parallel; results in the order of `specs`. A stone that fails
/// does not stop the rest.
pub fn open_each<S: Sync, T: Send>(
    specs: &[S],
    console: &Console,
    what: &'static str,
    work: impl Fn(&S) -> Result<T, CliError> + Sync,
) -> Vec<Result<T, CliError>> {
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
pub fn code<T>(results: &[Result<T, CliError>]) -> ExitStatus {
    let failed: Vec<ExitStatus> =
        results.iter().filter_map(|r| r.as_ref().err().map(CliError::code)).collect();
    match (failed.len(), results.len()) {
        (0, _) => ExitStatus::Done,
        (bad, all) if bad < all => ExitStatus::SomeFailed,
        _ if failed.iter().all(|c| *c == ExitStatus::Io) => ExitStatus::Io,
        _ => ExitStatus::NoGoodInput,
    }
}

/// Whether STONE names a cut of the library or a family, with parameters or not.
pub fn is_cut(spec: impl AsRef<OsStr>) -> bool {
    spec.as_ref().to_str().is_some_and(|spec| stone_spec::cut_name(spec).is_some())
}

/// The family that STONE is made by; none for a file and for a cut of fixed tiers.
pub fn family(spec: &str) -> Option<&'static Family> {
    let name = stone_spec::cut_name(spec)?;
    let family = library::document(name).and_then(Result::ok).and_then(|d| d.family);
    families::family(family.as_deref().unwrap_or(name)).ok()
}

/// Whether a size in millimetres is the stone's own parameter, to be set like others; else it scales the stone.
/// A prism of given height has its width set, one whose height nobody gave stays the same shape: a cube a cube.
///
/// - `given`: whether a parameter is given beside it
pub fn size_is_parameter(spec: &str, given: impl Fn(&str) -> bool) -> bool {
    const SIZE: &str = "size";
    let parameters = spec.split_once(':').map_or("", |(_, parameters)| parameters);
    let named = |key: &str| parameters.split(',').any(|p| p.split('=').next().map(str::trim) == Some(key));
    family(spec).is_some_and(|family| {
        let mut lengths = family.parameters.iter().filter(|p| p.unit.trim() == "mm" && p.key != SIZE);
        family.keys().any(|p| p.key == SIZE) && lengths.all(|p| named(p.key) || given(p.key))
    })
}

/// Value parser of `--size`.
pub fn millimetres(text: &str) -> Result<f64, String> {
    parse::parse_number_within(
        text,
        parse::NumberUnit::Millimetres,
        1e-3..=1e3,
        "a girdle width is a number of millimetres",
    )
}

/// Value parser of `--polarisation`.
pub fn on_off(text: &str) -> Result<bool, String> {
    match &*text.trim().to_lowercase() {
        "on" => Ok(true),
        "off" => Ok(false),
        _ => Err("polarisation is on or off".into()),
    }
}

/// Value parser of `--ri`.
pub fn refractive_index(text: &str) -> Result<f64, String> {
    parse::parse_number_within(text, parse::NumberUnit::None, 1.0..=10.0, "a refractive index is a number")
}

/// What a stone is made of, as asked for on the command line.
#[derive(Debug, Clone, Copy, Default, clap::Args)]
pub struct MaterialArgs {
    /// Material, see `cutlab list materials`, or a TOML file of your own, see `cutlab help materials` [the
    /// file's own index, or diamond]
    #[arg(long, value_name = "NAME", value_parser = material)]
    pub material: Option<&'static Material>,
    /// One refractive index, without dispersion, in place of a material
    #[arg(long, value_name = "N", value_parser = refractive_index, conflicts_with = "material")]
    pub ri: Option<f64>,
}

impl MaterialArgs {
    /// What the STONE `argument` is made of: by its own words, else as asked for here.
    pub fn within(&self, argument: impl AsRef<OsStr>) -> Result<MaterialArgs, CliError> {
        let own = StoneSpec::parse(argument)?.substance;
        Ok(if own.material.is_some() || own.ri.is_some() { own } else { *self })
    }

    /// What to say if the index of the material asked for is a guess within `from`..=`to` (nm).
    pub fn range_note(&self, from: f64, to: f64) -> Option<String> {
        Some(format!("note: {}", self.material?.extrapolated(from, to)?))
    }

    /// What was asked for on the command line, if anything.
    pub fn asked(&self) -> Option<Material> {
        self.material.cloned().or(self.ri.map(Material::from_index))
    }

    /// What the design is made of: the material asked for, or the bare index asked for, or the
    /// index that its file was drawn for, or diamond.
    pub fn material_of(&self, design: &Design) -> Material {
        self.drawn_for(design.refractive_index)
    }

    /// As [`MaterialArgs::material_of`], for a stone without a design.
    ///
    /// - `index`: that its file was drawn for, if any
    pub fn drawn_for(&self, index: Option<f64>) -> Material {
        self.material.cloned().unwrap_or_else(|| Material::drawn_for(self.ri.or(index)))
    }
}

/// Girdle width of a stone of which nobody says how large it is, in millimetres.
pub const USUAL_SIZE: f64 = USUAL_WIDTH_MM;

/// [`USUAL_SIZE`] for a stone without unit in a material whose colour depends on the size.
pub fn usual_size(unit: LengthUnit, material: &Material) -> Option<f64> {
    (unit == LengthUnit::Free && !material.is_clear()).then_some(USUAL_SIZE)
}

/// The stone's design as large as its colour needs to know: with `--size` applied, or as it is, or
/// 6.5 mm wide if its file has no unit and the material absorbs, which is noted.
pub fn sized_for_colour(
    design: Design,
    size: Option<f64>,
    material: &Material,
    console: &Console,
) -> Result<Design, CliError> {
    let usual = usual_size(design.unit, material).filter(|_| size.is_none());
    if let Some(mm) = usual {
        console.note(&format!(
            "note: {} has no size, which its colour depends on: taken as {mm} mm wide; --size MM sets it",
            design.name
        ));
    }
    sized(design, size.or(usual))
}

/// The stone's design, with `--size` applied.
pub fn sized(design: Design, size: Option<f64>) -> Result<Design, CliError> {
    Ok(match size {
        Some(mm) => design.sized(mm)?,
        None => design,
    })
}

/// A file name for a stone: the cut's name, or the file's without folder and extension.
pub fn file_stem(argument: impl AsRef<OsStr>) -> OsString {
    let argument = argument.as_ref();
    let base = StoneSpec::parse(argument).map_or_else(|_| argument.to_owned(), |spec| spec.base);
    let name = match base.to_str() {
        Some(text) if is_cut(text) => text.split(':').next().unwrap_or_default().into(),
        _ => base,
    };
    let stem = Path::new(&name).file_stem().unwrap_or_default();
    let none = stem.is_empty() || argument == stone_spec::STANDARD_INPUT;
    if none { "stone".into() } else { stem.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parts(argument: &str) -> (String, Option<&'static str>, Option<f64>) {
        let spec = StoneSpec::parse(argument).expect("a stone");
        (display_name(spec.base()), spec.substance.material.map(|m| m.name.as_ref()), spec.substance.ri)
    }

    #[test]
    fn a_stone_says_what_it_is_of() {
        for (argument, base, material, ri) in [
            ("D.asc:material=topaz", "D.asc", Some("topaz"), None),
            ("C:/x y/D.asc: material = topaz ", "C:/x y/D.asc", Some("topaz"), None),
            ("D.asc:ri=1.62", "D.asc", None, Some(1.62)),
            ("oval:material=ruby", "oval", Some("ruby"), None),
            ("oval:Material=Ruby", "oval", Some("ruby"), None),
            ("D.asc:RI=1.62", "D.asc", None, Some(1.62)),
            ("oval:table=57,ri=2,star=50", "oval:table=57,star=50", None, Some(2.0)),
            ("oval:table=57", "oval:table=57", None, None),
            ("D.asc:table=57", "D.asc:table=57", None, None),
            ("D.asc:table=57,material=ruby", "D.asc:table=57,material=ruby", None, None),
            ("D.asc", "D.asc", None, None),
        ] {
            assert_eq!(parts(argument), (base.into(), material, ri), "{argument}");
        }
        for wrong in ["D.asc:material=kryptonite", "D.asc:ri=0.5", "oval:material=ruby,ri=2"] {
            assert!(StoneSpec::parse(wrong).is_err_and(|e| e.message().starts_with(wrong)), "{wrong}");
        }
        assert_eq!(file_stem("x/D.v2.asc:material=topaz"), "D.v2");
        assert_eq!(file_stem("oval:table=57,material=topaz"), "oval");
    }

    #[cfg(unix)]
    #[test]
    fn names_that_are_not_utf8_stay_apart() {
        use std::os::unix::ffi::OsStrExt;
        let [a, b] = [&b"a\xff.asc:material=topaz"[..], b"a\xfe.asc:material=topaz"].map(OsStr::from_bytes);
        let spec = StoneSpec::parse(a).expect("a stone");
        assert_eq!(spec.base().as_bytes(), b"a\xff.asc");
        assert_eq!(spec.applied_to(spec.base().to_owned()), a);
        assert_eq!(display_name(a), "a\\xff.asc:material=topaz");
        assert_ne!(display_name(a), display_name(b));
    }
}
