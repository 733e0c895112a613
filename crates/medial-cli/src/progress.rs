use crate::args::When;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::cell::Cell;
use std::io::{IsTerminal as _, Write as _};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Time between lines of progress where standard error is no terminal.
const PAUSE: Duration = Duration::from_secs(1);

/// The count of features done, on a terminal, and warnings beside it.
pub struct Progress {
    bar: ProgressBar,
    /// When the last line was written, where lines stand for the bar.
    lines: Option<Cell<Instant>>,
    quiet: bool,
    /// What is being done, if it is not features that are counted.
    what: Option<&'static str>,
}

/// Counts rows that are done.
pub struct Steps {
    bar: ProgressBar,
    what: &'static str,
    /// When the next line is written, where lines stand for the bar.
    next: Option<Mutex<Instant>>,
}

impl Steps {
    pub fn step(&self) {
        self.bar.inc(1);
        let Some(next) = &self.next else { return };
        let mut next = next.lock().unwrap_or_else(PoisonError::into_inner);
        if Instant::now() >= *next {
            *next = Instant::now() + PAUSE;
            let n = self.bar.length().unwrap_or_default();
            line(&format!("progress: {}, {} of {n} rows", self.what, self.bar.position()));
        }
    }
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
        Self { bar, lines, quiet, what: None }
    }

    /// That something is being done, of which so many rows are counted if any are.
    pub fn working(when: When, quiet: bool, what: &'static str, rows: Option<u32>) -> Self {
        let progress = Self::new(when, quiet, rows.map(|rows| rows as usize));
        let template = match rows {
            Some(_) => "{wide_bar} {msg}, {pos}/{len} rows, {eta} left",
            None => "{spinner} {msg}, {elapsed}",
        };
        if let Ok(style) = ProgressStyle::with_template(template) {
            progress.bar.set_style(style);
        }
        progress.bar.set_message(what);
        if progress.lines.is_some() {
            line(&format!("progress: {what}"));
        } else if !progress.bar.is_hidden() {
            progress.bar.enable_steady_tick(Duration::from_millis(100));
        }
        Self { what: Some(what), ..progress }
    }

    /// What counts the rows of [`working`](Self::working), on whatever thread.
    pub fn steps(&self) -> Steps {
        let next = self.lines.is_some().then(|| Mutex::new(Instant::now() + PAUSE));
        Steps { bar: self.bar.clone(), what: self.what.unwrap_or_default(), next }
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
        if self.lines.is_some() && self.what.is_none() {
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
