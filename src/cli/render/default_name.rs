//! The name of a picture that is given none.

use super::options::RenderArgs;
use crate::cli::limits::limits;
use crate::scene::SceneFile;
use crate::stone::{StoneSpec, grammar};
use std::ffi::{OsStr, OsString};

/// A name that tells the stones with their parameters, what they are made of, their size and the scene:
/// pictures of different things have different names.
pub fn default_name(args: &RenderArgs, file: &SceneFile) -> OsString {
    let first = args.stones.is_empty().then(|| file.first_cut()).flatten();
    let stones = args.stones.iter().map(OsString::as_os_str).chain(first.map(OsStr::new));
    let mut parts: Vec<OsString> = stones.map(stone_name).collect();
    parts.extend(args.stone_args.material.as_ref().map(|m| m.name.as_ref().into()));
    parts.extend(args.stone_args.ri.map(|n| format!("n{n}").into()));
    parts.extend(args.size.map(|mm| format!("{mm}mm").into()));
    parts.push(file.name.clone().into());
    let mut name = parts.join(OsStr::new("-"));
    name.push(if args.frames.is_some() { ".gif" } else { ".png" });
    name
}

/// `round-brilliant:table=60` as `round-brilliant-table60`, `D.asc:material=topaz` as `D-materialtopaz`.
fn stone_name(spec: &OsStr) -> OsString {
    let text = spec.to_str().filter(|_| grammar::is_cut(spec));
    let parameters = text.and_then(|text| text.split_once(':')).map(|(_, rest)| rest.to_owned());
    let of_file = || {
        StoneSpec::parse_within(spec, limits()).map_or_else(|_| String::new(), |spec| spec.own().join(","))
    };
    let given = parameters.unwrap_or_else(of_file);
    let fit = |c: char| c.is_alphanumeric() || c == '.' || c == '-';
    let told = given.split(',').map(|p| p.chars().filter(|c| fit(*c)).collect::<String>());
    let told = told.filter(|p| !p.is_empty()).map(OsString::from);
    std::iter::once(grammar::file_stem(spec)).chain(told).collect::<Vec<_>>().join(OsStr::new("-"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_tell_parameters() {
        assert_eq!(stone_name(OsStr::new("round-brilliant")), "round-brilliant");
        assert_eq!(
            stone_name(OsStr::new("round-brilliant:table=60, crown-angle=34.5")),
            "round-brilliant-table60-crown-angle34.5"
        );
        // a file's own name is no parameter: all of it tells
        assert_eq!(stone_name(OsStr::new("designs/my:stone=1.asc")), "my:stone=1");
    }
}
