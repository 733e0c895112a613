use super::positive;
use clap::{Args, ValueEnum};
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::time::Duration;

/// What commands on features say of a run, whatever the features come from.
#[derive(Clone, Debug, Args)]
pub struct RunOptions {
    /// Leave out features (of colour images: regions) that take longer, from reading to writing, in seconds; a
    /// colour image that takes longer to be parted is given up
    #[arg(long, value_name = "S", value_parser = positive, allow_negative_numbers = true)]
    pub max_seconds: Option<f64>,
    /// What to do about a bad feature
    #[arg(long, value_name = "WHAT", default_value = "skip")]
    pub on_error: OnError,
    /// Number of threads; by default one for each processor
    #[arg(long, value_name = "N")]
    pub threads: Option<NonZeroUsize>,
    /// Write to FILE, as JSON, what was repaired, dropped or refused, and how well samples stand for borders
    #[arg(long, value_name = "FILE")]
    pub report: Option<PathBuf>,
    /// Write to FILE, as JSON, how long each stage took
    #[arg(long, value_name = "FILE")]
    pub timings: Option<PathBuf>,
    /// Show the progress on standard error; auto: on a terminal
    #[arg(long, value_name = "WHEN", default_value = "auto")]
    pub progress: When,
    /// Print errors only, no warnings
    #[arg(short, long)]
    pub quiet: bool,
}

impl RunOptions {
    /// How long a feature may take.
    pub fn limit(&self) -> Option<Duration> {
        Duration::try_from_secs_f64(self.max_seconds?).ok()
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum OnError {
    /// Leave it out and go on.
    Skip,
    /// Stop without a result.
    Stop,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum When {
    /// If standard error is a terminal.
    Auto,
    Always,
    Never,
}
