//! Work on many items at once, results in the order of the items, memory bounded.

use std::collections::BTreeMap;
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::panic;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// Items a thread may be ahead of the result that is awaited.
const AHEAD: usize = 16;

/// Most threads that are given up and still at work; beyond, items are waited for however long they take,
/// so that neither memory nor processors are lost to ever more of them.
const GIVEN_UP: usize = 4;

/// How long an item may take, and what stands for its result if it takes longer.
pub struct Limit<R> {
    pub after: Duration,
    /// By the number of the item.
    pub instead: fn(usize) -> R,
}

/// What the threads share.
struct State<R> {
    /// Results not yet handed on, by number of their item.
    ready: BTreeMap<usize, R>,
    /// When the items at work were begun.
    running: BTreeMap<usize, Instant>,
    /// Threads whose item was given up, and that are still at it.
    given_up: usize,
    /// Number of items taken.
    taken: usize,
    /// Number of results handed on.
    done: usize,
    /// Whether there are no more items.
    exhausted: bool,
    /// Whether no further results are wanted.
    stop: bool,
    /// Whether a thread has panicked.
    panicked: bool,
}

/// Calls `work` for each item on several threads and `done` for each result in order, until
/// `done` breaks off; gives what it broke off with.
///
/// At most 16 items per thread are in flight. An item that takes longer than the limit is given up: its
/// thread is left to itself, until the process ends or it comes back, and another one takes its place.
pub fn ordered<T, R: Send + 'static, B>(
    items: impl Iterator<Item = T> + Send + 'static,
    threads: NonZeroUsize,
    work: impl Fn(T) -> R + Send + Sync + 'static,
    limit: Option<&Limit<R>>,
    mut done: impl FnMut(R) -> ControlFlow<B>,
) -> Option<B> {
    let start = State {
        ready: BTreeMap::new(),
        running: BTreeMap::new(),
        given_up: 0,
        taken: 0,
        done: 0,
        exhausted: false,
        stop: false,
        panicked: false,
    };
    let shared = Arc::new(Shared {
        items: Mutex::new(items),
        work,
        window: AHEAD * threads.get(),
        state: Mutex::new(start),
        changed: Condvar::new(),
    });
    let begin = || {
        let shared = Arc::clone(&shared);
        thread::spawn(move || shared.run());
    };
    (0..threads.get()).for_each(|_| begin());
    let _stop = StopOnPanic(&*shared);
    while let Some(result) = shared.next(limit, begin) {
        if let ControlFlow::Break(value) = done(result) {
            shared.change(|state| state.stop = true);
            return Some(value);
        }
    }
    None
}

/// Keeps a value for as long as the process runs, as threads that are given up may still look at it.
pub fn kept<T>(value: T) -> &'static T {
    Box::leak(Box::new(value))
}

struct Shared<I, W, R> {
    items: Mutex<I>,
    work: W,
    /// Items that may be taken ahead of the result that is awaited.
    window: usize,
    state: Mutex<State<R>>,
    changed: Condvar,
}

impl<I, W, R> Shared<I, W, R> {
    fn change<A>(&self, change: impl FnOnce(&mut State<R>) -> A) -> A {
        let answer = change(&mut lock(&self.state));
        self.changed.notify_all();
        answer
    }

    /// Waits until this holds.
    fn wait(&self, until: impl Fn(&State<R>) -> bool) -> MutexGuard<'_, State<R>> {
        self.changed
            .wait_while(lock(&self.state), |state| !until(state))
            .unwrap_or_else(PoisonError::into_inner)
    }

    /// The next result in order, or `None` after the last one; `begin` begins a thread for one that is
    /// given up.
    fn next(&self, limit: Option<&Limit<R>>, begin: impl Fn()) -> Option<R> {
        let is_there = |s: &State<R>| {
            s.stop || s.ready.contains_key(&s.done) || s.exhausted && s.done == s.taken
        };
        let mut state = match limit {
            Some(limit) => self.supervise(limit, is_there, begin),
            None => self.wait(is_there),
        };
        if state.panicked {
            drop(state);
            // What happened is told already.
            panic::resume_unwind(Box::new(()));
        }
        let number = state.done;
        let result = state.ready.remove(&number)?;
        state.done += 1;
        drop(state);
        self.changed.notify_all();
        Some(result)
    }

    /// Waits until this holds, and gives up what takes too long meanwhile.
    fn supervise(
        &self,
        limit: &Limit<R>,
        until: impl Fn(&State<R>) -> bool,
        begin: impl Fn(),
    ) -> MutexGuard<'_, State<R>> {
        let mut state = lock(&self.state);
        while !until(&state) {
            let oldest = state.running.iter().min_by_key(|(_, start)| **start);
            let oldest = oldest.map(|(number, start)| (*number, *start + limit.after));
            let now = Instant::now();
            state = match oldest.filter(|_| state.given_up < GIVEN_UP) {
                Some((number, due)) if due <= now => {
                    state.running.remove(&number);
                    state.ready.insert(number, (limit.instead)(number));
                    state.given_up += 1;
                    begin();
                    state
                }
                Some((_, due)) => {
                    let waited = self.changed.wait_timeout(state, due - now);
                    waited.unwrap_or_else(PoisonError::into_inner).0
                }
                // What is begun from now on is not due before this.
                None => {
                    let waited = self.changed.wait_timeout(state, limit.after);
                    waited.unwrap_or_else(PoisonError::into_inner).0
                }
            };
        }
        state
    }
}

impl<T, I: Iterator<Item = T>, W: Fn(T) -> R, R> Shared<I, W, R> {
    /// Works until there is nothing left to do, or another thread has taken the place of this one.
    fn run(&self) {
        let _stop = StopOnPanic(self);
        while let Some((number, item)) = self.take() {
            let result = (self.work)(item);
            let is_wanted = self.change(|state| {
                let is_wanted = state.running.remove(&number).is_some();
                if is_wanted {
                    state.ready.insert(number, result);
                } else {
                    state.given_up -= 1;
                }
                is_wanted
            });
            if !is_wanted {
                return;
            }
        }
    }

    /// The next item with its number, as soon as the results are near enough.
    fn take(&self) -> Option<(usize, T)> {
        // Held while waiting: nobody else may take an item before this one is taken either.
        let mut items = lock(&self.items);
        let state = self.wait(|s| s.stop || s.exhausted || s.taken < s.done + self.window);
        if state.stop || state.exhausted {
            return None;
        }
        drop(state);
        let item = items.next();
        let mut number = 0;
        self.change(|state| {
            number = state.taken;
            match item {
                Some(_) => {
                    state.taken += 1;
                    state.running.insert(number, Instant::now());
                }
                None => state.exhausted = true,
            }
        });
        Some((number, item?))
    }
}

/// Lets all threads end when one of them panics.
struct StopOnPanic<'a, I, W, R>(&'a Shared<I, W, R>);

impl<I, W, R> Drop for StopOnPanic<'_, I, W, R> {
    fn drop(&mut self) {
        if thread::panicking() {
            self.0.change(|state| (state.stop, state.panicked) = (true, true));
        }
    }
}

/// What a mutex guards, also if a thread has panicked.
pub fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
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
        let broke: Option<()> = ordered(0..500, FOUR, work, None, |square| {
            seen.push(square);
            ControlFlow::Continue(())
        });
        assert_eq!(broke, None);
        assert_eq!(seen, (0..500).map(|k| k * k).collect::<Vec<_>>());
    }

    #[test]
    fn breaking_off_ends_the_work() {
        let worked = Arc::new(AtomicUsize::new(0));
        let count = Arc::clone(&worked);
        let work = move |k: u32| {
            count.fetch_add(1, Ordering::Relaxed);
            k
        };
        let broke = ordered(0.., FOUR, work, None, |k| {
            if k == 10 { ControlFlow::Break(k) } else { ControlFlow::Continue(()) }
        });
        assert_eq!(broke, Some(10));
        assert!(worked.load(Ordering::Relaxed) <= 11 + AHEAD * 4 + 4);
    }

    #[test]
    fn a_slow_item_holds_the_others_back() {
        let counts = Arc::new((AtomicUsize::new(0), AtomicUsize::new(0)));
        let shared = Arc::clone(&counts);
        let (worked, most) = (&counts.0, &counts.1);
        let work = move |k: usize| {
            let (worked, most) = (&shared.0, &shared.1);
            worked.fetch_add(1, Ordering::SeqCst);
            if k == 0 {
                thread::sleep(Duration::from_millis(100));
                most.store(worked.load(Ordering::SeqCst), Ordering::SeqCst);
            }
        };
        let broke: Option<()> =
            ordered(0..10_000, FOUR, work, None, |()| ControlFlow::Continue(()));
        assert_eq!(broke, None);
        assert_eq!(worked.load(Ordering::SeqCst), 10_000);
        assert!(most.load(Ordering::SeqCst) <= AHEAD * 4);
    }

    #[test]
    fn nothing_gives_nothing() {
        let broke: Option<()> =
            ordered(std::iter::empty::<u8>(), FOUR, |k| k, None, |_| ControlFlow::Break(()));
        assert_eq!(broke, None);
    }

    #[test]
    fn what_does_not_come_back_is_given_up_in_its_place() {
        let stuck = Arc::new((Mutex::new(true), Condvar::new()));
        let shared = Arc::clone(&stuck);
        let work = move |k: usize| {
            if k % 3 == 1 {
                let is_stuck = lock(&shared.0);
                drop(shared.1.wait_while(is_stuck, |is_stuck| *is_stuck));
            }
            Some(k)
        };
        let limit = Limit { after: Duration::from_millis(50), instead: |_| None };
        let mut seen = Vec::new();
        let one = NonZeroUsize::MIN;
        let broke: Option<()> = ordered(0..7, one, work, Some(&limit), |found| {
            seen.push(found);
            ControlFlow::Continue(())
        });
        *lock(&stuck.0) = false;
        stuck.1.notify_all();
        assert_eq!(broke, None);
        assert_eq!(seen, [Some(0), None, Some(2), Some(3), None, Some(5), Some(6)]);
    }

    #[test]
    fn a_panic_of_a_thread_reaches_the_caller() {
        crate::guard::install();
        let work = |k: u32| assert!(k < 3, "three is too much");
        let all = || {
            let none: Option<()> = ordered(0..9, FOUR, work, None, |()| ControlFlow::Continue(()));
            none
        };
        assert!(crate::guard::caught(all).is_err());
    }
}
