//! `cutlab import`: any format in, any format out.

use super::console::Console;
use super::outcome::{Code, Failure};
use super::stones;
use crate::formats;
use std::path::{Path, PathBuf};

#[derive(Debug, clap::Args)]
pub struct Args {
    /// Designs and meshes; the content decides their format
    #[arg(required = true, value_name = "FILE")]
    files: Vec<String>,
    /// Where to write: a file whose ending chooses the format, or a folder
    #[arg(long, short, value_name = "OUT")]
    output: PathBuf,
    /// Format when OUT is a folder: a name or ending from `cutlab list formats`
    #[arg(long, value_name = "FORMAT")]
    to: Option<String>,
    /// Scale to this girdle width in millimetres
    #[arg(long, value_name = "MM", value_parser = stones::millimetres)]
    size: Option<f64>,
}

/// Reads every file and writes it again.
pub fn run(args: &Args, console: &Console) -> Result<Code, Failure> {
    let into_folder = args.to.is_some() || args.files.len() > 1 || args.output.is_dir();
    if into_folder && args.output.extension().is_some() && !args.output.is_dir() && args.files.len() > 1 {
        return Err(Failure::input(format!(
            "{} stones do not fit into the one file {}: give a folder and --to FORMAT",
            args.files.len(),
            args.output.display()
        )));
    }
    let target = |spec: &str| -> PathBuf {
        if args.output == Path::new("-") {
            args.output.clone()
        } else if into_folder && (args.to.is_some() || !is_file_name(&args.output)) {
            let format = args.to.as_deref().unwrap_or("toml");
            args.output.join(format!("{}.{format}", stones::file_stem(spec)))
        } else {
            args.output.clone()
        }
    };
    let results = stones::each(&args.files, console, "importing", |spec| {
        let imported = stones::open(spec)?;
        let facets = imported.design.solid()?.faces.len();
        let design = stones::sized(imported.design, args.size)?;
        let path = target(spec);
        if path == Path::new("-") {
            console.print_bytes(&formats::encode(&design, args.to.as_deref().unwrap_or("toml"))?)?;
        } else {
            formats::write(&design, &path)?;
        }
        Ok((path, imported.format, facets, imported.warnings))
    });
    for (spec, result) in args.files.iter().zip(&results) {
        match result {
            Ok((path, format, facets, warnings)) => {
                warnings.iter().for_each(|w| console.note(&format!("{spec}: note: {w}")));
                console.note(&format!("{spec}: {format}, {facets} facets, wrote {}", path.display()));
            }
            Err(failure) => console.complain(&failure.message()),
        }
    }
    Ok(stones::code(&results))
}

fn is_file_name(path: &Path) -> bool {
    path.extension().is_some() && !path.is_dir()
}
