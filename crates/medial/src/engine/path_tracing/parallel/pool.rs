//! Tasks that threads hand to one another.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;

use crate::engine::EngineError;

/// Tasks that belong to no thread yet; who has none of his own waits here.
pub(super) struct Pool<T> {
    state: Mutex<State<T>>,
    changed: Condvar,
    /// Threads that wait and have nothing to take.
    hungry: AtomicUsize,
    /// Set when the work is to stop before it is done.
    pub stop: AtomicBool,
}

struct State<T> {
    tasks: Vec<T>,
    /// Threads at work, and those of them that wait.
    threads: usize,
    waiting: usize,
    /// Why the work has stopped.
    error: Option<EngineError>,
}

impl<T> Pool<T> {
    /// A pool of tasks for that many threads; the last one is taken first.
    pub fn new(tasks: Vec<T>, threads: usize) -> Self {
        Self {
            state: Mutex::new(State { tasks, threads, waiting: 0, error: None }),
            changed: Condvar::new(),
            hungry: AtomicUsize::new(0),
            stop: AtomicBool::new(false),
        }
    }

    fn lock(&self) -> MutexGuard<'_, State<T>> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The next task, waited for as long as any thread may still give one.
    pub fn take(&self) -> Option<T> {
        let mut state = self.lock();
        state.waiting += 1;
        loop {
            if self.stop.load(Ordering::Relaxed) {
                return None;
            }
            if let Some(task) = state.tasks.pop() {
                state.waiting -= 1;
                self.count_hungry(&state);
                return Some(task);
            }
            if state.waiting == state.threads {
                // Nobody is left who could give any.
                self.changed.notify_all();
                return None;
            }
            self.count_hungry(&state);
            state = self.changed.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
    }

    fn count_hungry(&self, state: &State<T>) {
        self.hungry.store(state.waiting.saturating_sub(state.tasks.len()), Ordering::Relaxed);
    }

    /// Whether any thread waits for a task.
    #[inline]
    pub fn is_hungry(&self) -> bool {
        self.hungry.load(Ordering::Relaxed) > 0
    }

    /// Adds tasks for those who wait.
    pub fn give(&self, tasks: impl Iterator<Item = T>) {
        let mut state = self.lock();
        state.tasks.extend(tasks);
        self.count_hungry(&state);
        drop(state);
        self.changed.notify_all();
    }

    /// One thread fewer than expected.
    pub fn leave(&self) {
        let mut state = self.lock();
        state.threads -= 1;
        drop(state);
        self.changed.notify_all();
    }

    /// Stops the work of all; the first reason counts.
    pub fn fail(&self, error: EngineError) {
        let mut state = self.lock();
        state.error.get_or_insert(error);
        self.end(state);
    }

    fn end(&self, state: MutexGuard<'_, State<T>>) {
        // Those who wait look at it with the lock held.
        self.stop.store(true, Ordering::Relaxed);
        drop(state);
        self.changed.notify_all();
    }

    /// Why the work has stopped, if not because all is done.
    pub fn error(&self) -> Option<EngineError> {
        self.lock().error
    }
}

/// Lets all threads end when one of them panics.
pub(super) struct StopOnPanic<'p, T>(pub &'p Pool<T>);

impl<T> Drop for StopOnPanic<'_, T> {
    fn drop(&mut self) {
        if thread::panicking() {
            self.0.end(self.0.lock());
        }
    }
}
