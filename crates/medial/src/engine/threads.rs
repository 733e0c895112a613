//! Tasks that do not depend on one another, shared out to threads.

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

use super::watch::Watch;
use super::{EngineError, Options};

/// Threads beyond this number would only wait for one another.
const MOST: usize = 64;

/// How many threads are to be used: one, if the library was built without them.
pub(super) fn number(options: &Options<'_>) -> usize {
    let threads = if cfg!(feature = "parallel") { options.threads } else { NonZeroUsize::MIN };
    threads.get().min(MOST)
}

/// What a task comes to, in the order of the tasks.
///
/// # Errors
/// That of the first task that fails by itself; the others are stopped then.
pub(super) fn each<T: Send, R: Send>(
    options: &Options<'_>,
    watch: &Watch<'_>,
    tasks: Vec<T>,
    work: impl Fn(T, &Watch<'_>) -> Result<R, EngineError> + Sync,
) -> Result<Vec<R>, EngineError> {
    let n = tasks.len();
    let stop = AtomicBool::new(false);
    let queue = Mutex::new(tasks.into_iter().enumerate());
    let results = Mutex::new(Vec::with_capacity(n));
    let run = |watch: Watch<'_>| {
        loop {
            let next = queue.lock().unwrap_or_else(PoisonError::into_inner).next();
            let Some((k, task)) = next else { break };
            let result = if stop.load(Ordering::Relaxed) {
                Err(EngineError::Cancelled)
            } else {
                work(task, &watch)
            };
            stop.fetch_or(result.is_err(), Ordering::Relaxed);
            results.lock().unwrap_or_else(PoisonError::into_inner).push((k, result));
        }
    };
    thread::scope(|scope| {
        for _ in 1..number(options).min(n) {
            let watch = watch.with(&stop);
            // Without it the others do its work.
            let _ = thread::Builder::new().spawn_scoped(scope, || run(watch));
        }
        run(watch.with(&stop));
    });
    let mut results = results.into_inner().unwrap_or_else(PoisonError::into_inner);
    results.sort_unstable_by_key(|&(k, _)| k);
    let by_itself = |error: &EngineError| *error != EngineError::Cancelled;
    let error =
        results.iter().filter_map(|(_, result)| result.as_ref().err()).find(|e| by_itself(e));
    if let Some(&error) = error {
        return Err(watch.or(error));
    }
    results.into_iter().map(|(_, result)| result).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;

    fn four() -> Options<'static> {
        Options { threads: NonZeroUsize::MIN.saturating_add(3), ..Options::default() }
    }

    #[test]
    fn results_come_in_the_order_of_the_tasks() {
        let watch = Watch::new(&four());
        let squares = each(&four(), &watch, (0..1000).collect(), |k: u64, _| Ok(k * k));
        assert!(squares.is_ok_and(|all| all.iter().zip(0..1000).all(|(&s, k)| s == k * k)));
    }

    #[test]
    fn the_task_that_fails_says_why_and_stops_the_others() {
        let watch = Watch::new(&four());
        let error = EngineError::Internal { stage: "testing", place: Point::default() };
        let fails = |k: u32, watch: &Watch<'_>| {
            if k == 10 {
                return Err(error);
            }
            if k < 10 {
                return Ok(k);
            }
            // Nobody ends this but the one that fails.
            loop {
                watch.check()?;
            }
        };
        assert_eq!(each(&four(), &watch, (0..100).collect(), fails), Err(error));
    }

    #[test]
    fn limits_reach_every_thread() {
        let cancel = AtomicBool::new(true);
        let options = Options { cancel: Some(&cancel), ..four() };
        let watch = Watch::new(&options);
        let waits = |_: u32, watch: &Watch<'_>| -> Result<(), EngineError> {
            loop {
                watch.check()?;
            }
        };
        assert_eq!(each(&options, &watch, vec![1, 2, 3, 4], waits), Err(EngineError::Cancelled));
    }
}
