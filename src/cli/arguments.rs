//! The arguments of the process, as the parser takes them.

use std::collections::BTreeSet;
use std::ffi::OsString;

/// The arguments, with a number that follows an option joined to it where it may be taken for something else.
///
/// - after an option whose value may be left out: `--glare 8` is `--glare=8`, and in `--glare a.asc` what
///   follows is a stone
/// - below 0 with its unit: `--size -3mm` is `--size=-3mm`, for the option's reader to say what is wrong
pub fn joined(arguments: impl Iterator<Item = OsString>, command: &clap::Command) -> Vec<OsString> {
    let all = || command.get_arguments().chain(command.get_subcommands().flat_map(|sub| sub.get_arguments()));
    let named = |wanted: fn(&clap::Arg) -> bool| -> BTreeSet<OsString> {
        let long = all().filter(|arg| wanted(arg)).filter_map(clap::Arg::get_long);
        long.map(|long| format!("--{long}").into()).collect()
    };
    let optional = named(clap::Arg::is_require_equals_set);
    let valued = named(|arg| arg.get_action().takes_values());
    let mut joined: Vec<OsString> = Vec::new();
    for argument in arguments {
        let text = argument.to_str().unwrap_or_default();
        let is_number = text.parse::<f64>().is_ok();
        let is_below_0 = text
            .strip_prefix('-')
            .is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit() || c == '.'));
        match joined.last_mut() {
            Some(last) if is_number && optional.contains(last) || is_below_0 && valued.contains(last) => {
                last.push("=");
                last.push(argument);
            }
            _ => joined.push(argument),
        }
    }
    joined
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::command;

    #[test]
    fn a_number_after_an_option_that_may_stand_alone_is_its_value() {
        let said = |line: &str| joined(line.split(' ').map(OsString::from), &command());
        assert_eq!(said("cutlab render --glare 8 cube"), ["cutlab", "render", "--glare=8", "cube"]);
        assert_eq!(said("cutlab render --glare cube"), ["cutlab", "render", "--glare", "cube"]);
        assert_eq!(said("cutlab render --width 8"), ["cutlab", "render", "--width", "8"]);
        assert_eq!(said("cutlab show a --size -3mm"), ["cutlab", "show", "a", "--size=-3mm"]);
        assert_eq!(said("cutlab score -j -2 --exact -3"), ["cutlab", "score", "-j", "-2", "--exact", "-3"]);
    }
}
