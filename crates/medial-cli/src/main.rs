//! The command `medial`: files in, axes, diagrams and verdicts out.
//!
//! It translates between people and the library, and computes nothing.

mod args;
mod commands;
mod comparison;
mod failure;
mod guard;
mod input;
mod interrupt;
mod metric;
mod output;
mod parallel;
mod progress;
mod report;
mod sizes;
mod table;
mod timings;
mod verdicts;

use args::Command;
use failure::{Failure, Status};
use std::process::ExitCode;

fn main() -> ExitCode {
    guard::install();
    interrupt::install();
    let Ok(result) = guard::caught(run) else { return Status::NoResult.into() };
    match result {
        Ok(status) => status.into(),
        Err(failure) => failure.tell(),
    }
}

fn run() -> Result<Status, Failure> {
    match args::parse()? {
        Command::Axis(args) => commands::axis::run(&args),
        Command::Prune(args) => commands::axis::prune(&args),
        Command::Branches(args) => commands::branches::run(&args),
        Command::Smooth(args) => commands::smooth::run(&args),
        Command::Reconstruct(args) => commands::reconstruct::run(&args),
        Command::Centerline(args) => commands::centerline::run(&args),
        Command::Offset(args) => commands::offset::run(&args),
        Command::Clearance(args) => commands::clearance::run(&args),
        Command::Carve(args) => commands::carve::run(&args),
        Command::Walls(args) => commands::walls::run(&args),
        Command::Voronoi(args) => commands::voronoi::run(&args),
        Command::Locate(args) => commands::locate::run(&args),
        Command::Check(args) => commands::check::run(&args),
        Command::Compare(args) => commands::compare::run(&args),
        Command::Compress(args) => commands::compress::run(&args),
    }
}
