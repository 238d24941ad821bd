//! The clock of the benches: processor time of the thread at work, which other processes do not stretch.
//!
//! Linux tells it in nanoseconds; elsewhere it is the time on the wall. What a library computes on threads of its own is not
//! counted; nothing that is measured here has any.

use criterion::measurement::{Measurement, ValueFormatter, WallTime};
use std::time::Duration;

/// Processor time of the thread at work.
pub struct CpuTime(WallTime);

/// When a measurement began: by the processor, where it is told, and on the wall.
pub struct Begun(Option<u64>, <WallTime as Measurement>::Intermediate);

/// Nanoseconds that this thread was on a processor.
fn spent_ns() -> Option<u64> {
    std::fs::read_to_string("/proc/thread-self/schedstat").ok()?.split(' ').next()?.parse().ok()
}

impl Measurement for CpuTime {
    type Intermediate = Begun;
    type Value = Duration;

    fn start(&self) -> Begun {
        Begun(spent_ns(), self.0.start())
    }

    fn end(&self, Begun(ns, at): Begun) -> Duration {
        let spent = ns.zip(spent_ns()).map(|(from, to)| Duration::from_nanos(to - from));
        spent.filter(|spent| !spent.is_zero()).unwrap_or_else(|| self.0.end(at))
    }

    fn add(&self, a: &Duration, b: &Duration) -> Duration {
        *a + *b
    }

    fn zero(&self) -> Duration {
        Duration::ZERO
    }

    fn to_f64(&self, value: &Duration) -> f64 {
        value.as_nanos() as f64
    }

    fn formatter(&self) -> &dyn ValueFormatter {
        self.0.formatter()
    }
}

/// A criterion with that clock.
pub fn criterion() -> criterion::Criterion<CpuTime> {
    criterion::Criterion::default().with_measurement(CpuTime(WallTime))
}
