//! Work on many items at once, results in the order of the items, memory bounded.

use std::collections::BTreeMap;
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;

/// Items a thread may be ahead of the result that is awaited.
const AHEAD: usize = 16;

/// What the threads share.
struct State<R> {
    /// Results not yet handed on, by number of their item.
    ready: BTreeMap<usize, R>,
    /// Number of items taken.
    taken: usize,
    /// Number of results handed on.
    done: usize,
    /// Whether there are no more items.
    exhausted: bool,
    /// Whether no further results are wanted.
    stop: bool,
}

/// Calls `work` for each item on several threads and `done` for each result in order, until
/// `done` breaks off; gives what it broke off with.
///
/// At most 16 items per thread are in flight.
pub fn ordered<T, R: Send, B>(
    items: impl Iterator<Item = T> + Send,
    threads: NonZeroUsize,
    work: impl Fn(T) -> R + Sync,
    mut done: impl FnMut(R) -> ControlFlow<B>,
) -> Option<B> {
    let start = State { ready: BTreeMap::new(), taken: 0, done: 0, exhausted: false, stop: false };
    let shared =
        Shared { items: Mutex::new(items), state: Mutex::new(start), changed: Condvar::new() };
    let window = AHEAD * threads.get();
    thread::scope(|scope| {
        for _ in 0..threads.get() {
            scope.spawn(|| {
                let _stop = StopOnPanic(&shared);
                while let Some((number, item)) = shared.take(window) {
                    let result = work(item);
                    shared.change(|state| {
                        state.ready.insert(number, result);
                    });
                }
            });
        }
        let _stop = StopOnPanic(&shared);
        while let Some(result) = shared.next() {
            if let ControlFlow::Break(value) = done(result) {
                shared.change(|state| state.stop = true);
                return Some(value);
            }
        }
        None
    })
}

struct Shared<I, R> {
    items: Mutex<I>,
    state: Mutex<State<R>>,
    changed: Condvar,
}

impl<I, R> Shared<I, R> {
    fn change(&self, change: impl FnOnce(&mut State<R>)) {
        change(&mut lock(&self.state));
        self.changed.notify_all();
    }

    /// Waits until this holds.
    fn wait(&self, until: impl Fn(&State<R>) -> bool) -> MutexGuard<'_, State<R>> {
        self.changed
            .wait_while(lock(&self.state), |state| !until(state))
            .unwrap_or_else(PoisonError::into_inner)
    }

    /// The next result in order, or `None` after the last one.
    fn next(&self) -> Option<R> {
        let mut state = self
            .wait(|s| s.stop || s.ready.contains_key(&s.done) || s.exhausted && s.done == s.taken);
        let number = state.done;
        let result = state.ready.remove(&number)?;
        state.done += 1;
        drop(state);
        self.changed.notify_all();
        Some(result)
    }
}

impl<T, I: Iterator<Item = T>, R> Shared<I, R> {
    /// The next item with its number, as soon as the results are near enough.
    fn take(&self, window: usize) -> Option<(usize, T)> {
        // Held while waiting: nobody else may take an item before this one is taken either.
        let mut items = lock(&self.items);
        let state = self.wait(|s| s.stop || s.exhausted || s.taken < s.done + window);
        if state.stop || state.exhausted {
            return None;
        }
        drop(state);
        let item = items.next();
        let mut number = 0;
        self.change(|state| {
            number = state.taken;
            match item {
                Some(_) => state.taken += 1,
                None => state.exhausted = true,
            }
        });
        Some((number, item?))
    }
}

/// Lets all threads end when one of them panics.
struct StopOnPanic<'a, I, R>(&'a Shared<I, R>);

impl<I, R> Drop for StopOnPanic<'_, I, R> {
    fn drop(&mut self) {
        if thread::panicking() {
            self.0.change(|state| state.stop = true);
        }
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::time::Duration;

    const FOUR: NonZeroUsize = NonZeroUsize::new(4).unwrap();

    #[test]
    fn results_come_in_the_order_of_the_items() {
        let mut seen = Vec::new();
        let work = |k: u64| {
            thread::sleep(Duration::from_micros(k * 37 % 101));
            k * k
        };
        let broke: Option<()> = ordered(0..500, FOUR, work, |square| {
            seen.push(square);
            ControlFlow::Continue(())
        });
        assert_eq!(broke, None);
        assert_eq!(seen, (0..500).map(|k| k * k).collect::<Vec<_>>());
    }

    #[test]
    fn breaking_off_ends_the_work() {
        let worked = AtomicUsize::new(0);
        let work = |k: u32| {
            worked.fetch_add(1, Ordering::Relaxed);
            k
        };
        let broke = ordered(0.., FOUR, work, |k| {
            if k == 10 { ControlFlow::Break(k) } else { ControlFlow::Continue(()) }
        });
        assert_eq!(broke, Some(10));
        assert!(worked.load(Ordering::Relaxed) <= 11 + AHEAD * 4 + 4);
    }

    #[test]
    fn a_slow_item_holds_the_others_back() {
        let worked = AtomicUsize::new(0);
        let most = AtomicUsize::new(0);
        let work = |k: usize| {
            worked.fetch_add(1, Ordering::SeqCst);
            if k == 0 {
                thread::sleep(Duration::from_millis(100));
                most.store(worked.load(Ordering::SeqCst), Ordering::SeqCst);
            }
        };
        let broke: Option<()> = ordered(0..10_000, FOUR, work, |()| ControlFlow::Continue(()));
        assert_eq!(broke, None);
        assert_eq!(worked.load(Ordering::SeqCst), 10_000);
        assert!(most.load(Ordering::SeqCst) <= AHEAD * 4);
    }

    #[test]
    fn nothing_gives_nothing() {
        let broke: Option<()> =
            ordered(std::iter::empty::<u8>(), FOUR, |k| k, |_| ControlFlow::Break(()));
        assert_eq!(broke, None);
    }
}
