//! The `replan` command. All logic lives in the library.

fn main() -> std::process::ExitCode {
    replan::cli::run()
}
