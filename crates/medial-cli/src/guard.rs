//! Panics, which are faults of ours: caught for one feature, told in one line.

use std::cell::{Cell, RefCell};
use std::panic::{self, AssertUnwindSafe, PanicHookInfo};

thread_local! {
    static GUARDED: Cell<bool> = const { Cell::new(false) };
    static LAST: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Makes panics one-line errors, or silent where [`guarded`] reports them.
pub fn install() {
    panic::set_hook(Box::new(|info| {
        let text = described(info);
        if GUARDED.get() {
            LAST.set(text);
        } else if !text.starts_with("a scoped thread panicked") {
            // The thread itself has told why.
            crate::progress::line(&format!("error: {}", asking(&text)));
        }
    }));
}

/// The result of `work`, unless it panicked, which has been told by then.
pub fn caught<T>(work: impl FnOnce() -> T) -> Result<T, ()> {
    panic::catch_unwind(AssertUnwindSafe(work)).map_err(|_| ())
}

/// The result of `work`, or what to say of its panic.
pub fn guarded<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    let outer = GUARDED.replace(true);
    let result = panic::catch_unwind(AssertUnwindSafe(work));
    GUARDED.set(outer);
    result.map_err(|_| asking(&LAST.take()))
}

fn asking(what: &str) -> String {
    format!("internal error ({what}); please report it with the input")
}

fn described(info: &PanicHookInfo) -> String {
    let payload = info.payload();
    let message = payload
        .downcast_ref::<&str>()
        .copied()
        .or_else(|| payload.downcast_ref::<String>().map(String::as_str))
        .unwrap_or("unknown cause");
    let message = message.replace('\n', " ");
    info.location().map_or_else(|| message.clone(), |at| format!("{message}, {at}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_a_message_that_asks_for_a_report() {
        install();
        let numbers: Vec<u32> = Vec::new();
        let told = guarded(|| numbers[std::hint::black_box(3)]).unwrap_err();
        assert!(told.starts_with("internal error (index out of bounds"), "{told}");
        assert!(told.contains("guard.rs:"), "{told}");
        assert!(told.ends_with("please report it with the input"), "{told}");
        assert!(!told.contains('\n'));
    }

    #[test]
    fn work_that_ends_well_gives_its_value() {
        assert_eq!(guarded(|| 2 + 2), Ok(4));
    }
}
