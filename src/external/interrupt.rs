//! Planners at work, so that whoever interrupts replan can end them all.

use super::linux::start_guard;
use std::collections::BTreeMap;
use std::process::Child;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, OnceLock};

/// The variable of the environment that marks a planner's processes.
pub(super) const MARK: &str = "REPLAN_PLANNER";

static IS_INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// The process of each planner at work, by its mark; `None` while it starts.
static AT_WORK: Mutex<BTreeMap<String, Option<i32>>> = Mutex::new(BTreeMap::new());

/// Every conversation ends from now on as if its time were spent; what comes of it is no result.
pub fn interrupt() {
    IS_INTERRUPTED.store(true, Ordering::Relaxed);
}

/// Whether [`interrupt`] was called.
pub fn is_interrupted() -> bool {
    IS_INTERRUPTED.load(Ordering::Relaxed)
}

/// A process that outlives this one for a moment and kills planners that do, too.
static WATCH: OnceLock<Option<Child>> = OnceLock::new();

/// Starts the guard, once; elsewhere than on Linux, and without a shell, there is none.
pub(super) fn guard() {
    WATCH.get_or_init(|| start_guard(MARK));
}

/// Whether `pid` is the guard.
pub(super) fn is_guard(pid: i32) -> bool {
    WATCH.get().and_then(Option::as_ref).is_some_and(|guard| guard.id() as i32 == pid)
}

pub(super) fn note(mark: &str, root: Option<i32>) {
    at_work(|all| all.insert(mark.to_owned(), root));
}

pub(super) fn forget(mark: &str) {
    at_work(|all| all.remove(mark));
}

pub(super) fn planners() -> BTreeMap<String, Option<i32>> {
    at_work(|all| all.clone())
}

fn at_work<T>(work: impl FnOnce(&mut BTreeMap<String, Option<i32>>) -> T) -> T {
    work(&mut AT_WORK.lock().expect("no thread panics with the list of planners"))
}
