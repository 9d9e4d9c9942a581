//! The grammar of a STONE: the name of a cut or a file, parameters, and what the stone is made of.

use super::error::StoneError;
use crate::design::design_file::DocumentError;
use crate::design::families::Family;
use crate::design::{Design, families, library};
#[cfg(feature = "files")]
use crate::formats::{self, Content, FormatError, Loaded};
use crate::limits::Limits;
use crate::materials::Material;
use crate::parse::{self, display_name};
use std::collections::BTreeMap;
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

/// The STONE that is read from standard input.
pub const STANDARD_INPUT: &str = "-";

const MATERIAL: &str = "material";
const INDEX: &str = "ri";

/// A STONE taken apart: a cut or a file, and what it is made of, if it says so itself
/// (`D.asc:material=topaz`, `oval:table=57,ri=2.2`).
///
/// ```
/// use cutlab::StoneSpec;
///
/// let spec = StoneSpec::parse("oval:table=57,material=ruby")?;
/// assert_eq!((spec.base().to_str(), spec.own()), (Some("oval:table=57"), &["material=ruby".to_string()][..]));
/// # Ok::<(), cutlab::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct StoneSpec {
    base: OsString,
    /// The items that say what it is made of, as written.
    own: Vec<String>,
    material: Option<Material>,
}

impl StoneSpec {
    /// The parts of a STONE. The name of a file that is there is taken as it is, whatever it holds.
    pub fn parse(argument: impl AsRef<OsStr>) -> Result<StoneSpec, StoneError> {
        StoneSpec::parse_within(argument, Limits::default())
    }

    /// As [`StoneSpec::parse`], with a material in a file read within limits that may be raised.
    pub fn parse_within(argument: impl AsRef<OsStr>, limits: Limits) -> Result<StoneSpec, StoneError> {
        let argument = argument.as_ref();
        let mut spec = StoneSpec::split(argument)?;
        let wrong = |why: String| StoneError::Material { spec: display_name(argument), why };
        spec.material = match &spec.own[..] {
            [] => None,
            [item] => {
                let (_, value) = item.split_once('=').unwrap_or_default();
                Some(if has_key(item, MATERIAL) {
                    Material::open(value.trim(), limits).map_err(wrong)?
                } else {
                    Material::from_index(refractive_index(value.trim()).map_err(wrong)?)
                })
            }
            _ => return Err(wrong("one material or index".into())),
        };
        Ok(spec)
    }

    /// The parts of a STONE, its material not opened.
    fn split(argument: &OsStr) -> Result<StoneSpec, StoneError> {
        let mut spec = StoneSpec { base: argument.into(), own: Vec::new(), material: None };
        if Path::new(argument).symlink_metadata().is_ok() {
            return Ok(spec);
        }
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
            return Err(StoneError::Item { spec: display_name(argument), found: found.to_string(), why });
        }
        spec.own = own.iter().map(|item| item.trim().to_owned()).collect();
        spec.base = name;
        if !rest.is_empty() {
            spec.base.push(":");
            spec.base.push(rest.join(","));
        }
        Ok(spec)
    }

    /// The cut or file, without what it is made of.
    pub fn base(&self) -> &OsStr {
        &self.base
    }

    /// What it is made of, as written: `material=topaz`.
    pub fn own(&self) -> &[String] {
        &self.own
    }

    /// What it says that it is made of; none if it does not say.
    pub fn material(&self) -> Option<&Material> {
        self.material.as_ref()
    }

    /// Another file of the same material.
    pub fn applied_to(&self, mut file: OsString) -> OsString {
        if !self.own.is_empty() {
            file.push(":");
            file.push(self.own.join(","));
        }
        file
    }

    /// The file that it is read from, if it is one.
    pub fn file(&self) -> Option<PathBuf> {
        let path = PathBuf::from(&self.base);
        (self.base != STANDARD_INPUT && !is_cut(&self.base) && path.is_file()).then_some(path)
    }

    /// Reads what it names.
    ///
    /// A library name wins over a file of that name, which `./name` reaches. Errors suggest a cut whose name is
    /// near where there is neither. Checked in `tests/library/formats.rs`.
    #[cfg(feature = "files")]
    pub(super) fn load(&self, limits: Limits) -> Result<Content, StoneError> {
        if self.base == STANDARD_INPUT {
            return Ok(formats::read_content_standard_input(limits)?);
        }
        let path = Path::new(&self.base);
        if !is_cut(&self.base) && path.is_dir() {
            let spec = display_name(path);
            return match std::fs::read_dir(path) {
                Ok(_) => Err(StoneError::Folder { spec }),
                Err(cause) => Err(FormatError::Read { file: spec, cause }.into()),
            };
        }
        load(&self.base, limits, |path| formats::read_content(path, limits))
    }

    /// The cut of the library, or of a family, that it names.
    #[cfg(not(feature = "files"))]
    pub(super) fn design(&self, limits: Limits) -> Result<Design, StoneError> {
        let spec = display_name(&self.base);
        library_cut(&spec, limits)?.ok_or_else(|| not_found(&spec))
    }
}

/// Reads the cut or the regular file that another file names, as a scene does.
#[cfg(feature = "files")]
pub fn load_regular(spec: &str, limits: Limits) -> Result<Loaded, StoneError> {
    let read = |path: &Path| formats::read_regular(path, limits).map(Content::Design);
    Ok(load(spec.as_ref(), limits, read)?.into_design()?)
}

#[cfg(feature = "files")]
fn load(
    argument: &OsStr,
    limits: Limits,
    read: impl Fn(&Path) -> Result<Content, FormatError>,
) -> Result<Content, StoneError> {
    let path = Path::new(argument);
    // a name that is not UTF-8 is a file's
    let Some(spec) = argument.to_str() else { return Ok(read(path)?) };
    if let Some(design) = library_cut(spec, limits)? {
        return Ok(Content::Design(Loaded { design, format: LIBRARY, warnings: Vec::new() }));
    }
    let missing = match std::fs::symlink_metadata(path) {
        Ok(_) => false,
        // what there is no right to look at may be there
        Err(e) => spec.is_empty() || e.kind() != std::io::ErrorKind::PermissionDenied,
    };
    if missing { Err(not_found(spec)) } else { Ok(read(path)?) }
}

/// The format of what comes from the library.
pub(super) const LIBRARY: &str = "library";

/// The cut of the library, or of a family, that STONE names; none if it names none.
fn library_cut(spec: &str, limits: Limits) -> Result<Option<Design>, StoneError> {
    let Some(name) = cut_name(spec) else { return Ok(None) };
    let rest = spec.split_once(':').map(|(_, rest)| rest);
    match cut(name, &parameters(spec, rest)?, limits) {
        Ok(design) => Ok(Some(design)),
        Err(cause) => Err(StoneError::Cut { spec: spec.into(), cause }),
    }
}

/// The error of a STONE that names neither a cut nor a file.
fn not_found(spec: &str) -> StoneError {
    let name = spec.split(':').next().unwrap_or_default();
    if let Some((why, nearest)) = library::impossible(name) {
        return StoneError::Impossible { spec: spec.into(), why, nearest };
    }
    if spec.contains(['/', '\\']) || Path::new(name).extension().is_some() {
        return StoneError::NoSuchFile { spec: spec.into() };
    }
    StoneError::NoSuchStone { spec: spec.into(), nearest: library::nearest(name) }
}

/// Whether an item `KEY=VALUE` of a STONE has this key.
fn has_key(item: &str, name: &str) -> bool {
    item.split_once('=').is_some_and(|(key, _)| key.trim().eq_ignore_ascii_case(name))
}

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

/// The cut of the library or the family that a STONE names, as it is written in the catalogue; none
/// for a file.
///
/// A name in another case is that cut's too, unless there is a file of just that name.
pub fn cut_name(spec: &str) -> Option<&'static str> {
    let name = spec.split(':').next().unwrap_or_default();
    let cut = library::canonical_name(name)?;
    let is_file = cfg!(feature = "files") && std::fs::symlink_metadata(spec).is_ok();
    (cut == name || !is_file).then_some(cut)
}

/// Whether STONE names a cut of the library or a family, with parameters or not.
pub fn is_cut(spec: impl AsRef<OsStr>) -> bool {
    spec.as_ref().to_str().is_some_and(|spec| cut_name(spec).is_some())
}

/// The family that STONE is made by; none for a file and for a cut of fixed tiers.
pub fn family(spec: &str) -> Option<&'static Family> {
    let name = cut_name(spec)?;
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

/// The STONE `spec` with these parameters in place of its own.
pub fn with_parameters(spec: &str, given: &BTreeMap<String, f64>) -> String {
    if given.is_empty() {
        return spec.into();
    }
    let (name, own) = spec.split_once(':').unwrap_or((spec, ""));
    let key_of = |item: &str| item.split('=').next().unwrap_or_default().trim().to_lowercase();
    let kept = own.split(',').filter(|item| !item.trim().is_empty() && !given.contains_key(&key_of(item)));
    let given = given.iter().map(|(key, value)| format!("{key}={}", parse::format_number(*value)));
    let items: Vec<String> = kept.map(str::to_string).chain(given).collect();
    format!("{name}:{}", items.join(","))
}

/// A file name for a stone: the cut's name, or the file's without folder and extension.
pub fn file_stem(argument: impl AsRef<OsStr>) -> OsString {
    let argument = argument.as_ref();
    let base = StoneSpec::split(argument).map_or_else(|_| argument.to_owned(), |spec| spec.base);
    let name = match base.to_str() {
        Some(text) if is_cut(text) => text.split(':').next().unwrap_or_default().into(),
        _ => base,
    };
    let stem = Path::new(&name).file_stem().unwrap_or_default();
    let none = stem.is_empty() || argument == STANDARD_INPUT;
    if none { "stone".into() } else { stem.to_owned() }
}

fn cut(name: &str, values: &BTreeMap<String, f64>, limits: Limits) -> Result<Design, DocumentError> {
    library::design_within(name, values, limits).unwrap_or_else(|| Ok(families::build(name, values)?))
}

/// The parameters in what stands behind the colon of a STONE.
pub fn parameters_of(items: &str) -> Result<BTreeMap<String, f64>, StoneError> {
    parameters(items, Some(items))
}

/// `key=value,key=value`; nothing after the colon is no parameter.
fn parameters(spec: &str, rest: Option<&str>) -> Result<BTreeMap<String, f64>, StoneError> {
    let mut values = BTreeMap::new();
    let mut last = "";
    for part in rest.unwrap_or_default().split(',').map(str::trim).filter(|p| !p.is_empty()) {
        let wrong = |why: String| StoneError::Parameter { spec: spec.into(), found: part.into(), why };
        let Some((key, value)) = part.split_once('=') else {
            let are_digits =
                part.bytes().all(|b| b.is_ascii_digit()) && last.ends_with(|c: char| c.is_ascii_digit());
            return Err(wrong(match are_digits {
                true => format!("write decimals with a point, as {last}.{part}"),
                false => "a parameter is written as key=number".into(),
            }));
        };
        let key = key.trim().to_lowercase();
        let value =
            parse::parse_number(value, families::parameter_unit(&key)).map_err(|e| wrong(e.to_string()))?;
        if key.is_empty() {
            return Err(wrong("its key is missing".into()));
        }
        if values.insert(key.clone(), value).is_some() {
            return Err(wrong(format!("{key} is given twice")));
        }
        last = part;
    }
    Ok(values)
}

/// A refractive index, from 1 to 10.
pub fn refractive_index(text: &str) -> Result<f64, String> {
    parse::parse_number_within(text, parse::NumberUnit::None, 1.0..=10.0, "a refractive index is a number")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parts(argument: &str) -> (String, Option<String>) {
        let spec = StoneSpec::parse(argument).expect("a stone");
        (display_name(spec.base()), spec.material().map(|m| m.name.to_string()))
    }

    #[test]
    fn a_stone_says_what_it_is_made_of() {
        for (argument, base, material) in [
            ("D.asc:material=topaz", "D.asc", Some("topaz")),
            ("C:/x y/D.asc: material = topaz ", "C:/x y/D.asc", Some("topaz")),
            ("D.asc:ri=1.62", "D.asc", Some("n=1.62")),
            ("oval:material=ruby", "oval", Some("ruby")),
            ("oval:Material=Ruby", "oval", Some("ruby")),
            ("D.asc:RI=1.62", "D.asc", Some("n=1.62")),
            ("oval:table=57,ri=2,star=50", "oval:table=57,star=50", Some("n=2")),
            ("oval:table=57", "oval:table=57", None),
            ("D.asc:table=57", "D.asc:table=57", None),
            ("D.asc:table=57,material=ruby", "D.asc:table=57,material=ruby", None),
            ("D.asc", "D.asc", None),
        ] {
            assert_eq!(parts(argument), (base.into(), material.map(String::from)), "{argument}");
        }
        for wrong in ["D.asc:material=kryptonite", "D.asc:ri=0.5", "oval:material=ruby,ri=2"] {
            assert!(StoneSpec::parse(wrong).is_err_and(|e| e.to_string().starts_with(wrong)), "{wrong}");
        }
        assert_eq!(file_stem("x/D.v2.asc:material=topaz"), "D.v2");
        assert_eq!(file_stem("oval:table=57,material=topaz"), "oval");
    }

    #[test]
    fn parameters_replace_those_of_a_stone() {
        let given = BTreeMap::from([("table".to_string(), 57.5)]);
        assert_eq!(with_parameters("round-brilliant", &given), "round-brilliant:table=57.5");
        assert_eq!(with_parameters("a:table=50, star=40", &given), "a: star=40,table=57.5");
        assert_eq!(with_parameters("x.asc", &BTreeMap::new()), "x.asc");
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
