//! `cutlab generate` of a whole folder: what an import does.

use super::options::{GenerateArgs, USUAL_FORMAT};
use crate::cli::args::stone;
use crate::cli::console::Console;
use crate::cli::error::CliError;
use crate::cli::exit_code::ExitStatus;
use crate::cli::import::{self, GenerateSettings, ImportArgs};

/// Writes every stone of a folder into another.
pub fn run(args: &GenerateArgs, console: &Console) -> Result<ExitStatus, CliError> {
    let stone = stone::display_name(&args.stone);
    let [output] = &args.output[..] else {
        return Err(CliError::input(format!("{stone} is a folder: -o names one folder to write into")));
    };
    if args.facets.is_some() || !args.parameters.0.is_empty() {
        return Err(CliError::input(format!("{stone} is a folder: its stones have no parameters to set")));
    }
    let made =
        GenerateSettings { carat: args.carat, paper: Some(args.paper), stone_args: args.stone_args.clone() };
    let to = args.to.as_deref().unwrap_or(USUAL_FORMAT);
    let args = ImportArgs::for_folder(args.stone.clone(), output.clone(), to, args.size, made);
    import::run(&args, console)
}
