//! Every pair of option values of every command, run as the real program.
//!
//! The options come from the definitions of the command line, so a new one joins by itself
//! (`factors.rs`); its values are its possible values, or those of `samples.rs`. A greedy covering
//! array holds every pair that is not refused (`covering.rs`), each case runs in a fresh folder
//! (`bench.rs`), and `oracles.rs` says what must hold of it. `cutlab` refuses some pairs: which ones is
//! found out, and each refusal is a case of its own.
//!
//! All pairs, but where a page is made, which takes up to a minute of processor time: with a page of
//! `compare` or `optimise` go the first two values of each other option, of `report` every value goes with one
//! stone, and only the first page of each command is made again. Parameters of a cut are given family by family, not
//! one by one. Values are few and small (`samples.rs`): none is tried for its size, and no three options for
//! each other.
//!
//! `cargo test --release --test pairs` runs a sample, `-- --ignored` all of it. In the environment
//! `PAIRS=score,sweep` names the commands to run, and `PAIRS_PROGRAM` another build to run them with.

mod bench;
mod case;
mod covering;
mod factors;
mod files;
mod numbers;
mod oracles;
mod outputs;
mod report;
mod samples;
mod search;
mod tables;

use report::Report;
use search::Search;
use std::cmp::Reverse;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The commands to run: those that the environment names, or all.
fn commands() -> Vec<clap::Command> {
    let asked = std::env::var("PAIRS").ok();
    let is_asked = |name: &str| asked.as_ref().is_none_or(|all| all.split(',').any(|n| n.trim() == name));
    let mut command = cutlab::advanced::cli::command();
    command.build();
    command.get_subcommands().filter(|c| c.get_name() != "help" && is_asked(c.get_name())).cloned().collect()
}

/// Runs what `keep` leaves of each command's cases and fails with every kind of failure. As many commands at a
/// time as there are cores: what is refused together is learned of one by one.
fn run(keep: impl Fn(&str, usize) -> bool + Sync) {
    let inputs = bench::Inputs::made();
    let search = |command: &clap::Command| {
        let mut report = Report::default();
        match factors::of(command) {
            Ok(factors) => Search::new(command.get_name(), factors, &inputs).run(&keep, &mut report),
            Err(without) => report.failed(command.get_name(), "no sample values", &without),
        }
        report
    };
    let (mut commands, next, all) = (commands(), AtomicUsize::new(0), Mutex::new(Report::default()));
    // those of many options first: they take longest
    commands.sort_by_key(|command| Reverse(command.get_arguments().count()));
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(2, usize::from) {
            scope.spawn(|| {
                while let Some(command) = commands.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let report = search(command);
                    all.lock().expect("no search fails").add(report);
                }
            });
        }
    });
    let report = all.into_inner().expect("no search fails");
    eprintln!("{}", report.summary());
    assert!(report.kinds.is_empty(), "{}", report.text());
}

#[test]
fn a_sample_of_all_pairs_holds() {
    // pages and validations take seconds each
    const SLOW: [&str; 3] = ["report", "validate", "compare"];
    run(|command, i| !SLOW.contains(&command) && i % 9 == 4);
}

#[test]
#[ignore = "minutes: every pair of option values of every command"]
fn all_pairs_hold() {
    run(|_, _| true);
}

/// A new option without values to try would be left out in silence.
#[test]
fn every_option_has_values_to_try() {
    for command in commands() {
        if let Err(without) = factors::of(&command) {
            panic!("{} {without}: give it values in tests/pairs/samples.rs", command.get_name());
        }
    }
}
