//! The command `medial`.

mod args;
mod commands;
mod failure;
mod guard;
mod input;
mod output;
mod parallel;
mod progress;
mod report;
mod timings;
mod verdicts;

use args::Command;
use std::process::ExitCode;

fn main() -> ExitCode {
    guard::install();
    let result = args::parse().and_then(|command| match command {
        Command::Axis(args) => commands::axis::run(&args),
        Command::Check(args) => commands::check::run(&args),
    });
    match result {
        Ok(status) => status.into(),
        Err(failure) => failure.tell(),
    }
}
