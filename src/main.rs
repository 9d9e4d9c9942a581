//! The `cutlab` command.

fn main() -> std::process::ExitCode {
    cutlab::cli::run()
}
