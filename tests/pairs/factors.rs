//! What can be chosen on a command line: one factor for each option, one level for each of its values.

use crate::samples;
use clap::{Arg, Command};
use cutlab::advanced::design::families::FAMILIES;

/// An option, or the arguments without a name.
#[derive(Debug, Clone)]
pub struct Factor {
    /// The option's name in the definition of the command line.
    pub id: String,
    /// The words of each choice; the first is the resting one, nothing where the option may be left out.
    pub levels: Vec<Vec<String>>,
    /// Whether the words stand behind all options.
    pub positional: bool,
}

/// The head under which `generate` has the parameters of all families.
const OF_THE_CUT: &str = "Parameters of the cut";

/// The factors of a command, or the option that has no values to try.
pub fn of(command: &Command) -> Result<Vec<Factor>, String> {
    let name = command.get_name();
    let mut factors = Vec::new();
    for arg in command.get_arguments() {
        let id = arg.get_id().as_str();
        let of_the_cut = arg.get_help_heading() == Some(OF_THE_CUT);
        // one of two that exclude each other and of which one is needed: the other is never left out
        let is_excluded = (name, id) == ("retarget", "material");
        if ["help", "version"].contains(&id) || arg.is_hide_set() || of_the_cut || is_excluded {
            continue;
        }
        let mut levels: Vec<Vec<String>> = Vec::new();
        if !arg.is_required_set() && !samples::ALWAYS.contains(&(name, id)) {
            levels.push(Vec::new());
        }
        levels.extend(values(name, arg).ok_or_else(|| format!("{}", arg))?);
        factors.push(Factor { id: id.into(), levels, positional: arg.is_positional() });
    }
    if command.get_arguments().any(|a| a.get_help_heading() == Some(OF_THE_CUT)) {
        parameters(command, &mut factors)?;
    }
    Ok(factors)
}

/// Every way of giving the option.
fn values(command: &str, arg: &Arg) -> Option<Vec<Vec<String>>> {
    let takes_values = arg.get_action().takes_values();
    let flag = arg.get_long().map(|long| format!("--{long}"));
    if !takes_values {
        return Some(vec![vec![flag?]]);
    }
    let given = |words: &[&str]| -> Vec<String> {
        let Some(flag) = &flag else { return words.iter().map(|w| w.to_string()).collect() };
        words.iter().flat_map(|word| samples::option(flag, word, arg.is_require_equals_set())).collect()
    };
    if let Some(samples) = samples::of(command, arg) {
        return Some(samples.iter().map(|words| given(words)).collect());
    }
    let possible = arg.get_possible_values();
    let words: Vec<&str> = possible.iter().filter(|v| !v.is_hide_set()).map(|v| v.get_name()).collect();
    (!words.is_empty()).then(|| words.iter().map(|word| given(&[word])).collect())
}

/// The stone of `generate` as each family, with all of its parameters: those of different families do not go
/// together, and one by one they would have more pairs than all other options.
fn parameters(command: &Command, factors: &mut [Factor]) -> Result<(), String> {
    let Some(stone) = factors.iter_mut().find(|f| f.id == "stone") else { return Ok(()) };
    stone.positional = false;
    let flag = |key: &str| format!("--{key}");
    for family in FAMILIES {
        let own = family.parameters.iter().filter(|p| p.key != "size");
        let values = own.flat_map(|p| [flag(p.key), p.default.to_string()]);
        stone.levels.push(std::iter::once(family.name.into()).chain(values).collect());
        if !family.heights.is_empty() {
            let values = samples::HEIGHTS.iter().flat_map(|(key, value)| [flag(key), value.to_string()]);
            stone.levels.push(std::iter::once(family.name.into()).chain(values).collect());
        }
    }
    let of_the_cut = command.get_arguments().filter(|a| a.get_help_heading() == Some(OF_THE_CUT));
    let mut flags = of_the_cut.filter_map(|a| a.get_long()).map(flag);
    let untried = flags.find(|f| !stone.levels.iter().any(|words| words.contains(f)));
    untried.map_or(Ok(()), Err)
}

#[test]
fn an_option_without_values_to_try_is_named() {
    let known = Arg::new("seed").long("seed").value_name("N");
    let new = Arg::new("sparkle").long("sparkle").value_name("AMOUNT");
    let flag = Arg::new("shiny").long("shiny").action(clap::ArgAction::SetTrue);
    let built = |args: &[&Arg]| {
        let mut command = Command::new("score").args(args.iter().copied().cloned());
        command.build();
        command
    };
    let factors = of(&built(&[&known, &flag])).expect("both have values");
    assert_eq!(factors.iter().map(|f| f.levels.len()).collect::<Vec<_>>(), [2, 2]);
    assert!(of(&built(&[&known, &flag, &new])).is_err_and(|e| e.contains("--sparkle")));
}
