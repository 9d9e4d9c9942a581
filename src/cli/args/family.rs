//! Family arguments, the parameters of all families as flags: a family's file adds its own by being in the catalogue.

use super::values;
use crate::design::families::{FAMILIES, Parameter};
use crate::design::library;
use crate::parse::NumberUnit;
use clap::{Arg, ArgMatches, Command, FromArgMatches};
use std::collections::BTreeMap;

/// A key that every stone has, with a flag of its own.
const SIZE: &str = "size";

/// The values given by flags.
#[derive(Debug, Clone, Default)]
pub struct FamilyArgs(pub BTreeMap<String, f64>);

/// Every key once, with the families that have it.
fn keys() -> Vec<(&'static str, Vec<(&'static str, &'static Parameter)>)> {
    let mut keys: Vec<(&str, Vec<_>)> = Vec::new();
    for family in FAMILIES {
        for parameter in family.keys().filter(|p| p.key != SIZE) {
            match keys.iter_mut().find(|(key, _)| *key == parameter.key) {
                Some((_, uses)) => uses.push((family.name, parameter)),
                None => keys.push((parameter.key, vec![(family.name, parameter)])),
            }
        }
    }
    keys
}

fn help(uses: &[(&str, &Parameter)]) -> String {
    let each: Vec<String> = uses
        .iter()
        .map(|(family, p)| {
            let (from, to) = p.range;
            let family = library::plain(family).unwrap_or(family);
            let default =
                if p.default.is_nan() { String::new() } else { format!("{}{} ", p.default, p.unit) };
            format!("{family}: {default}({from} to {to}{})", p.unit)
        })
        .collect();
    let about = uses.first().map_or("", |(_, p)| p.about);
    format!("{about} [{}]", each.join(", "))
}

impl clap::Args for FamilyArgs {
    fn augment_args(command: Command) -> Command {
        keys().into_iter().fold(command, |command, (key, uses)| {
            let unit = uses.first().map_or("", |(_, p)| p.unit.trim());
            command.arg(
                Arg::new(key)
                    .long(key)
                    .value_name(match unit {
                        "%" => "PERCENT",
                        "°" => "DEGREES",
                        "mm" => "MM",
                        _ => "N",
                    })
                    .help(help(&uses))
                    .help_heading("Parameters of the cut")
                    .allow_negative_numbers(true)
                    .value_parser(values::number(NumberUnit::from_sign(unit))),
            )
        })
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for FamilyArgs {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let mut parameters = Self::default();
        parameters.update_from_arg_matches(matches)?;
        Ok(parameters)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        for (key, _) in keys() {
            if let Some(value) = matches.get_one::<f64>(key) {
                self.0.insert(key.into(), *value);
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_parameter_of_every_family_is_a_flag() {
        let command = <FamilyArgs as clap::Args>::augment_args(Command::new("test"));
        for parameter in FAMILIES.iter().flat_map(|f| f.keys()).filter(|p| p.key != SIZE) {
            assert!(
                command.get_arguments().any(|a| a.get_long() == Some(parameter.key)),
                "{}",
                parameter.key
            );
        }
    }
}
