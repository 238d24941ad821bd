//! Planners at work, so that whoever interrupts replan can end them all.

use super::end::kill_all;
use std::collections::BTreeMap;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

static IS_INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// The process of each planner at work, by its mark.
static AT_WORK: Mutex<BTreeMap<String, i32>> = Mutex::new(BTreeMap::new());

/// Every conversation ends from now on as if its time were spent; what comes of it is no result.
pub fn interrupt() {
    IS_INTERRUPTED.store(true, Ordering::Relaxed);
}

/// Whether [`interrupt`] was called.
pub fn is_interrupted() -> bool {
    IS_INTERRUPTED.load(Ordering::Relaxed)
}

/// Kills every planner at work with all that it started; the processes that survive.
pub fn end_planners() -> Vec<i32> {
    let planners: Vec<(String, i32)> = planners().into_iter().collect();
    planners.iter().flat_map(|(mark, root)| kill_all(*root, mark)).collect()
}

pub(super) fn note(mark: &str, root: i32) {
    at_work(|all| all.insert(mark.to_owned(), root));
}

pub(super) fn forget(mark: &str) {
    at_work(|all| all.remove(mark));
}

pub(super) fn planners() -> BTreeMap<String, i32> {
    at_work(|all| all.clone())
}

fn at_work<T>(work: impl FnOnce(&mut BTreeMap<String, i32>) -> T) -> T {
    work(&mut AT_WORK.lock().expect("no thread panics with the list of planners"))
}
