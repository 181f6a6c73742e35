//! What audits of a process have done so far: a budget that does not depend on the machine.

use std::sync::atomic::{AtomicU64, Ordering};

static INTEGRALS: AtomicU64 = AtomicU64::new(0);
static COMPARISONS: AtomicU64 = AtomicU64::new(0);

/// Points of lobes that were integrated, and values of channels that were held against a column, by all
/// audits of this process.
pub fn work() -> [u64; 2] {
    [&INTEGRALS, &COMPARISONS].map(|count| count.load(Ordering::Relaxed))
}

pub(super) fn integrated(points: usize) {
    INTEGRALS.fetch_add(points as u64, Ordering::Relaxed);
}

pub(super) fn compared(values: usize) {
    COMPARISONS.fetch_add(values as u64, Ordering::Relaxed);
}
