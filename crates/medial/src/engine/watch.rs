//! Whether an engine must stop: asked often, answered from the clock now and then.

use std::cell::Cell;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use super::{EngineError, Options};

/// Questions from one look at the clock to the next.
///
/// Between two questions at most some tens of microseconds pass, so a stop takes a few milliseconds.
const PATIENCE: u32 = 64;

/// The limits of one thread of an engine.
#[derive(Clone, Debug)]
pub(super) struct Watch<'a> {
    cancel: Option<&'a AtomicBool>,
    deadline: Option<Instant>,
    /// Set when another thread of the same engine has failed.
    stop: Option<&'a AtomicBool>,
    /// Questions left before the next look at the clock.
    left: Cell<u32>,
    /// Why the engine must stop, once it must.
    over: Cell<Option<EngineError>>,
}

impl<'a> Watch<'a> {
    pub fn new(options: &Options<'a>) -> Self {
        let Options { cancel, deadline, .. } = *options;
        Self { cancel, deadline, stop: None, left: Cell::new(0), over: Cell::new(None) }
    }

    /// The same for one of several threads, which stops when the others do.
    pub fn with(&self, stop: &'a AtomicBool) -> Self {
        Self { stop: Some(stop), ..self.clone() }
    }

    /// Whether to stop. Once it does, the answer remains the same.
    #[inline]
    pub fn is_over(&self) -> bool {
        match self.left.get().checked_sub(1) {
            Some(left) => {
                self.left.set(left);
                false
            }
            None => self.look(),
        }
    }

    /// Fails if the engine must stop.
    #[inline]
    pub fn check(&self) -> Result<(), EngineError> {
        if self.is_over() { Err(self.or(EngineError::Cancelled)) } else { Ok(()) }
    }

    /// The same with a look at the clock: between stages that take long.
    pub fn check_now(&self) -> Result<(), EngineError> {
        self.left.set(0);
        self.check()
    }

    /// Why the engine stops: a limit, or else this.
    pub fn or(&self, error: EngineError) -> EngineError {
        self.over.get().unwrap_or(error)
    }

    #[cold]
    fn look(&self) -> bool {
        let set = |flag: Option<&AtomicBool>| flag.is_some_and(|f| f.load(Ordering::Relaxed));
        if self.over.get().is_none() {
            if set(self.cancel) || set(self.stop) {
                self.over.set(Some(EngineError::Cancelled));
            } else if self.deadline.is_some_and(|deadline| Instant::now() >= deadline) {
                self.over.set(Some(EngineError::TimeLimit));
            }
        }
        let over = self.over.get().is_some();
        self.left.set(if over { 0 } else { PATIENCE });
        over
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_watch_without_limits_never_ends() {
        let watch = Watch::new(&Options::default());
        assert!((0..1000).all(|_| watch.check().is_ok()));
    }

    #[test]
    fn between_stages_the_limits_are_looked_at_each_time() {
        let cancel = AtomicBool::new(false);
        let watch = Watch::new(&Options { cancel: Some(&cancel), ..Options::default() });
        assert_eq!((watch.check_now(), watch.check_now()), (Ok(()), Ok(())));
        cancel.store(true, Ordering::Relaxed);
        assert_eq!(watch.check_now(), Err(EngineError::Cancelled));
    }

    #[test]
    fn a_cancelled_watch_ends_for_good() {
        let cancel = AtomicBool::new(false);
        let watch = Watch::new(&Options { cancel: Some(&cancel), ..Options::default() });
        assert!((0..1000).all(|_| !watch.is_over()));
        cancel.store(true, Ordering::Relaxed);
        let asked = (0..1000).position(|_| watch.is_over());
        assert!(asked.is_some_and(|n| n <= PATIENCE as usize), "{asked:?}");
        cancel.store(false, Ordering::Relaxed);
        assert!((0..1000).all(|_| watch.check() == Err(EngineError::Cancelled)));
    }
}
