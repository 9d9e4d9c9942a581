//! Work on many stones at once, each on its own.

use super::console::Console;
use super::error::CliError;
use super::exit_code::ExitStatus;
use rayon::prelude::*;

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
