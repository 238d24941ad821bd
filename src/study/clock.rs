//! The only place where time is read.

#![expect(clippy::disallowed_types, reason = "this module is where the clock lives")]

use rustix::time::{ClockId, clock_gettime};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

/// The column that holds a trial's planning time, in nanoseconds.
pub const COLUMN: &str = "plan_wall_ns";
/// What the column says.
pub const ABOUT: &str = "time of one call of the contender, nothing else between the two times";

/// Nanoseconds since the first call.
pub fn now_ns() -> u64 {
    static FIRST: OnceLock<Instant> = OnceLock::new();
    u64::try_from(FIRST.get_or_init(Instant::now).elapsed().as_nanos()).unwrap_or(u64::MAX)
}

/// How long `work` keeps its thread on a processor, in nanoseconds: other processes do not stretch it. What runs on other threads, or in
/// programs that it starts, is not counted.
pub fn spent_ns(work: impl FnOnce()) -> u64 {
    let now = || {
        let read = clock_gettime(ClockId::ThreadCPUTime);
        Duration::new(read.tv_sec as u64, read.tv_nsec as u32)
    };
    let start = now();
    work();
    u64::try_from(now().saturating_sub(start).as_nanos()).unwrap_or(u64::MAX)
}

/// How long `work` takes, in nanoseconds, and what it gives.
pub fn timed<T>(work: impl FnOnce() -> T) -> (u64, T) {
    let start = Instant::now();
    let result = work();
    let nanoseconds = start.elapsed().as_nanos();
    (u64::try_from(nanoseconds).unwrap_or(u64::MAX), result)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thread_that_waits_spends_nothing_and_one_that_works_does() {
        let wait = Duration::from_millis(200);
        assert!(spent_ns(|| std::thread::sleep(wait)) < 50_000_000, "waiting is counted");
        let work = || {
            let begun = Instant::now();
            while begun.elapsed() < wait {}
        };
        let (wall, spent) = timed(|| spent_ns(work));
        assert!(0 < spent && spent <= wall, "{spent} of {wall} ns");
    }
}
