//! The only place where time is read.

#![expect(clippy::disallowed_types, reason = "this module is where the clock lives")]

use std::sync::OnceLock;
use std::time::Instant;

/// The column that holds a trial's planning time, in nanoseconds.
pub const COLUMN: &str = "plan_wall_ns";
/// What the column says.
pub const ABOUT: &str = "time of one call of the contender, nothing else between the two times";

/// Nanoseconds since the first call.
pub fn now_ns() -> u64 {
    static FIRST: OnceLock<Instant> = OnceLock::new();
    u64::try_from(FIRST.get_or_init(Instant::now).elapsed().as_nanos()).unwrap_or(u64::MAX)
}

/// How long `work` takes, in nanoseconds, and what it gives.
pub fn timed<T>(work: impl FnOnce() -> T) -> (u64, T) {
    let start = Instant::now();
    let result = work();
    let nanoseconds = start.elapsed().as_nanos();
    (u64::try_from(nanoseconds).unwrap_or(u64::MAX), result)
}
