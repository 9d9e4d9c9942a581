//! The `cutlab` command.

fn main() -> std::process::ExitCode {
    cutlab::advanced::cli::run()
}
