use crate::args::When;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::cell::Cell;
use std::io::{IsTerminal as _, Write as _};
use std::time::{Duration, Instant};

/// Time between lines of progress where standard error is no terminal.
const PAUSE: Duration = Duration::from_secs(1);

/// The count of features done, on a terminal, and warnings beside it.
pub struct Progress {
    bar: ProgressBar,
    /// When the last line was written, where lines stand for the bar.
    lines: Option<Cell<Instant>>,
    quiet: bool,
}

impl Progress {
    pub fn new(when: When, quiet: bool, len: Option<usize>) -> Self {
        let terminal = std::io::stderr().is_terminal();
        let shown = match when {
            When::Always => true,
            When::Never => false,
            When::Auto => !quiet && terminal,
        };
        let lines = (shown && !terminal).then(|| Cell::new(Instant::now()));
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
        Self { bar, lines, quiet }
    }

    /// That something is being done which is not counted.
    pub fn working(when: When, quiet: bool, what: &'static str) -> Self {
        let progress = Self::new(when, quiet, None);
        if let Ok(style) = ProgressStyle::with_template("{spinner} {msg}, {elapsed}") {
            progress.bar.set_style(style);
        }
        progress.bar.set_message(what);
        if progress.lines.is_some() {
            line(&format!("progress: {what}"));
        } else if !progress.bar.is_hidden() {
            progress.bar.enable_steady_tick(Duration::from_millis(100));
        }
        Self { lines: None, ..progress }
    }

    pub fn step(&self) {
        self.bar.inc(1);
        if let Some(last) = &self.lines
            && last.get().elapsed() >= PAUSE
        {
            last.set(Instant::now());
            self.tell();
        }
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
        if self.lines.is_some() {
            self.tell();
        }
        self.bar.finish_and_clear();
    }

    fn tell(&self) {
        let of = self.bar.length().map_or_else(String::new, |len| format!(" of {len}"));
        line(&format!("progress: {}{of} features", self.bar.position()));
    }
}

/// One line on standard error; that nobody reads it is no reason to fail.
pub fn line(text: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{text}");
}
