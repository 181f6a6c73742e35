//! How many evaluations of integrands a thread has made: what accuracy costs, whatever machine runs it.

use std::cell::Cell;

thread_local! {
    static COUNT: Cell<u64> = const { Cell::new(0) };
}

/// Counts evaluations: nodes of a rule, lights drawn.
#[inline(always)]
pub(crate) fn add(evaluations: usize) {
    COUNT.set(COUNT.get() + evaluations as u64);
}

/// What a function returns, and the evaluations that it made on this thread; 0 where it makes none that are
/// counted.
pub fn counted<T>(f: impl FnOnce() -> T) -> (T, u64) {
    let before = COUNT.get();
    let value = f();
    (value, COUNT.get() - before)
}
