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
use parallel::kept;
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
        Command::Axis(args) => commands::axis::run(kept(args)),
        Command::Prune(args) => commands::axis::prune(kept(args)),
        Command::Branches(args) => commands::branches::run(kept(args)),
        Command::Smooth(args) => commands::smooth::run(kept(args)),
        Command::Reconstruct(args) => commands::reconstruct::run(kept(args)),
        Command::Centerline(args) => commands::centerline::run(kept(args)),
        Command::Offset(args) => commands::offset::run(kept(args)),
        Command::Clearance(args) => commands::clearance::run(kept(args)),
        Command::Carve(args) => commands::carve::run(kept(args)),
        Command::Walls(args) => commands::walls::run(kept(args)),
        Command::Voronoi(args) => commands::voronoi::run(kept(args)),
        Command::Locate(args) => commands::locate::run(kept(args)),
        Command::Check(args) => commands::check::run(kept(args)),
        Command::Compare(args) => commands::compare::run(kept(args)),
        Command::Compress(args) => commands::compress::run(kept(args)),
        Command::Segment(args) => commands::segment::run(kept(args)),
        Command::Image(args) => commands::image::run(Box::leak(args)),
    }
}
