//! The stone that `cutlab generate` makes.

use super::options::GenerateArgs;
use crate::cli::args::stone;
use crate::cli::error::CliError;
use crate::cli::weight;
use crate::materials::weight::Weight;
use crate::stone::{Stone, grammar};
use std::path::Path;

/// Makes the stone; with notes about it.
pub fn stone(args: &GenerateArgs) -> Result<(Stone, Vec<String>), CliError> {
    let mut parameters = args.parameters.clone();
    if let Some(n) = args.facets {
        parameters.0.insert("facets".into(), n.into());
    }
    let is_given = |key: &str| parameters.0.contains_key(key);
    let has_size = args.stone.to_str().is_some_and(|stone| grammar::size_is_parameter(stone, is_given));
    if let (true, Some(mm)) = (has_size, args.size) {
        parameters.0.insert("size".into(), mm);
    }
    if let (false, Some(flag)) = (grammar::is_cut(&args.stone), parameters.0.keys().next())
        && Path::new(&args.stone).exists()
    {
        return Err(CliError::input(format!(
            "{} is a file with fixed facets: --{flag} needs a parametric cut (cutlab list cuts)",
            stone::display_name(&args.stone)
        )));
    }
    let stone = match args.stone.to_str() {
        Some(text) => args.stone_args.open_convex(grammar::with_parameters(text, &parameters.0))?,
        None => args.stone_args.open_convex(&args.stone)?,
    };
    let mut notes: Vec<String> = stone.warnings().iter().map(|w| format!("note: {w}")).collect();
    let mut size = args.size.filter(|_| !has_size);
    if let Some(carats) = args.carat {
        let weight = Weight::new(stone.material());
        let mm = weight::width_mm(&weight, stone.convex_design()?, carats)?;
        let name = weight.name().unwrap_or_default();
        notes.push(format!("note: {carats} ct in {name} is {mm:.3} mm wide"));
        size = Some(mm);
    }
    let stone = match size {
        Some(mm) => stone.with_width(mm)?,
        None => stone,
    };
    Ok((stone, notes))
}
