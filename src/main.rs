//! The program: parse, run one mode, print the error once, set the exit code.

use std::process::ExitCode;

use rilievo::cli::{self, Command, Refusal};
use rilievo::modes::{self, ModeError};

fn main() -> ExitCode {
    let command = match cli::parse(std::env::args_os()) {
        Ok(command) => command,
        Err(Refusal::Told(text)) => {
            print!("{text}");
            return ExitCode::SUCCESS;
        }
        Err(Refusal::Refused(sentence)) => {
            eprintln!("rilievo: {sentence}");
            return ExitCode::from(2);
        }
    };
    let verbosity = command.verbosity();
    let result = match &command {
        Command::Live(options) => modes::live::run(options),
        Command::Capture(options) => modes::capture::run(options, verbosity),
        Command::Stress(options) => modes::stress::run(options, verbosity).map(|table| print!("{table}")),
        _ => Ok(()),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("rilievo: {error}");
            ExitCode::from(if matches!(error, ModeError::Adapter(_)) { 3 } else { 1 })
        }
    }
}
