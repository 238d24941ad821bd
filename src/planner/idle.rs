//! Memory that serves one query after another, kept while no query uses it.

use std::sync::Mutex;

/// Memories that are not at work: never more than there were queries at once.
#[derive(Debug)]
pub(super) struct Idle<T>(Mutex<Vec<T>>);

impl<T> Default for Idle<T> {
    fn default() -> Self {
        Self(Mutex::new(Vec::new()))
    }
}

impl<T> Idle<T> {
    /// A memory that `fits`, if one is idle; if none does, one that does not is given up.
    pub(super) fn take(&self, fits: impl Fn(&T) -> bool) -> Option<T> {
        let mut idle = self.0.lock().expect("no thread panics while it takes a memory");
        let at = idle.iter().position(fits);
        at.map(|at| idle.swap_remove(at)).or_else(|| {
            idle.pop();
            None
        })
    }

    /// Any memory, or a new one.
    pub(super) fn any(&self, new: impl FnOnce() -> T) -> T {
        self.take(|_| true).unwrap_or_else(new)
    }

    /// Keeps a memory for a later query.
    pub(super) fn keep(&self, memory: T) {
        self.0.lock().expect("no thread panics while it keeps a memory").push(memory);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_fits_is_given_again_and_what_does_not_makes_room() {
        let idle = Idle::default();
        assert_eq!(idle.take(|_| true), None);
        idle.keep(1);
        idle.keep(2);
        assert_eq!(idle.take(|kept| *kept == 1), Some(1));
        assert_eq!(idle.take(|kept| *kept == 3), None, "nothing fits");
        assert_eq!(idle.any(|| 4), 4, "and what was there is gone");
    }
}
