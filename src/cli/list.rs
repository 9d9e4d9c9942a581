//! `cutlab list`: what there is to choose from, straight from the catalogues.

mod catalogue_entry;
mod entries;
mod material_entry;

use super::console::Console;
use super::error::CliError;
use super::exit_code::ExitStatus;
use super::terminal_table;
use crate::manual::SCENE_GRAMMAR;
use crate::parse;
use catalogue_entry::CatalogueEntry;
use clap::ValueEnum;

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cutlab list metrics                one line each
  cutlab list metrics wlr iso        all that is known of two of them
  cutlab list materials --json       with index, dispersion, density and colour as numbers
  cutlab list cuts classic           the design itself, as a file of one's own may have it")]
pub struct ListArgs {
    /// Which catalogue
    #[arg(ignore_case = true)]
    kind: Catalogue,
    /// Entries to tell everything about
    #[arg(value_name = "NAME")]
    names: Vec<String>,
}

#[derive(Debug, Clone, Copy, clap::ValueEnum)]
enum Catalogue {
    /// Cuts of the library
    Cuts,
    /// Materials
    Materials,
    /// Lights by which colours are judged
    Illuminants,
    /// Scores
    Metrics,
    /// File formats
    Formats,
    /// Scenes for pictures
    Scenes,
    /// Every key of a scene file, by example
    SceneGrammar,
    /// Kinds of light for scene files
    Lights,
    /// How much a file may hold, CUTLAB_LIMIT in the environment counted in
    Limits,
}

/// Lists a catalogue, or entries of it.
pub fn run(args: &ListArgs, console: &Console) -> Result<ExitStatus, CliError> {
    let all = match args.kind {
        Catalogue::SceneGrammar => {
            return if console.json {
                console.print_json(&SCENE_GRAMMAR)
            } else {
                console.print(SCENE_GRAMMAR)
            }
            .map(|()| ExitStatus::Done);
        }
        Catalogue::Cuts => entries::cuts(),
        Catalogue::Materials => material_entry::materials(),
        Catalogue::Illuminants => entries::illuminants(),
        Catalogue::Metrics => entries::metrics(),
        Catalogue::Formats => entries::formats(),
        Catalogue::Scenes => entries::scenes(),
        Catalogue::Limits => entries::limits(),
        Catalogue::Lights => entries::lights(),
    };
    let kind = args.kind.to_possible_value().map_or_else(String::new, |kind| kind.get_name().into());
    let asked =
        args.names.iter().map(|name| find(&all, &kind, name)).collect::<Result<Vec<&CatalogueEntry>, _>>()?;
    if console.json {
        let chosen = if asked.is_empty() { all.iter().collect() } else { asked };
        console.print_json(&chosen.iter().map(|e| e.json()).collect::<Vec<_>>())?;
    } else if asked.is_empty() {
        let rows = all.iter().map(|e| (e.name.as_str(), e.about.clone()));
        console.print(&terminal_table::labelled(rows, 0, 0))?;
    } else {
        let texts: Vec<&str> = asked.iter().map(|e| e.text.trim_end()).collect();
        console.print(&texts.join("\n\n"))?;
    }
    Ok(ExitStatus::Done)
}

fn find<'a>(all: &'a [CatalogueEntry], kind: &str, name: &str) -> Result<&'a CatalogueEntry, CliError> {
    all.iter().find(|e| parse::is_name(&e.name, name)).ok_or_else(|| {
        let near = parse::did_you_mean(parse::nearest_name(name, all.iter().map(|e| e.name.as_str())));
        CliError::input(format!("the list of {kind} has no '{name}'{near} (all: cutlab list {kind})"))
    })
}
