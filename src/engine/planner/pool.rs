//! A pool of search memory, which later queries use again instead of allocating.

use std::sync::Mutex;

/// Memory that no query uses now: at most one piece for each query that ever ran at the same time.
#[derive(Debug)]
pub(super) struct Pool<T>(Mutex<Vec<T>>);

impl<T> Default for Pool<T> {
    fn default() -> Self {
        Self(Mutex::new(Vec::new()))
    }
}

impl<T> Pool<T> {
    /// A free memory that `fits`, if there is one; if none fits, one of the others is dropped.
    pub(super) fn take(&self, fits: impl Fn(&T) -> bool) -> Option<T> {
        let mut free = self.0.lock().expect("no thread panics while it takes a memory");
        let at = free.iter().position(fits);
        at.map(|at| free.swap_remove(at)).or_else(|| {
            free.pop();
            None
        })
    }

    /// A free memory, or a new one if none is free.
    pub(super) fn any(&self, new: impl FnOnce() -> T) -> T {
        self.take(|_| true).unwrap_or_else(new)
    }

    /// Returns a memory to the pool.
    pub(super) fn keep(&self, memory: T) {
        self.0.lock().expect("no thread panics while it keeps a memory").push(memory);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_fits_is_given_again_and_what_does_not_makes_room() {
        let pool = Pool::default();
        assert_eq!(pool.take(|_| true), None);
        pool.keep(1);
        pool.keep(2);
        assert_eq!(pool.take(|kept| *kept == 1), Some(1));
        assert_eq!(pool.take(|kept| *kept == 3), None, "nothing fits");
        assert_eq!(pool.any(|| 4), 4, "and what was there is gone");
    }
}
