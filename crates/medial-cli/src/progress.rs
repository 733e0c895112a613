use crate::args::When;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{IsTerminal as _, Write as _};

/// The count of features done, on a terminal, and warnings beside it.
pub struct Progress {
    bar: ProgressBar,
    quiet: bool,
}

impl Progress {
    pub fn new(when: When, quiet: bool, len: Option<usize>) -> Self {
        let shown = match when {
            When::Always => true,
            When::Never => false,
            When::Auto => !quiet && std::io::stderr().is_terminal(),
        };
        let target =
            if shown { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        let bar = ProgressBar::with_draw_target(len.map(|n| n as u64), target);
        let template = match len {
            Some(_) => "{wide_bar} {pos}/{len} features, {eta} left",
            None => "{spinner} {pos} features, {elapsed}",
        };
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        Self { bar, quiet }
    }

    pub fn step(&self) {
        self.bar.inc(1);
    }

    pub fn error(&self, text: &str) {
        self.bar.suspend(|| line(&format!("error: {text}")));
    }

    pub fn warning(&self, text: &str) {
        if !self.quiet {
            self.bar.suspend(|| line(&format!("warning: {text}")));
        }
    }

    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

/// One line on standard error; that nobody reads it is no reason to fail.
pub fn line(text: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{text}");
}
