//! What Linux alone offers against processes that outlive their planner. Elsewhere these do nothing, and a planner's process group is
//! all that is ended: docs/SECURITY.md says what that leaves.

/// Limits the address space of the process.
#[cfg(target_os = "linux")]
pub(super) fn limit_memory(pid: u32, bytes: u64) {
    use rustix::process::{Pid, Resource, Rlimit, prlimit};
    let limit = Rlimit { current: Some(bytes), maximum: Some(bytes) };
    // A process that has ended already is noticed when it says nothing.
    let _ = prlimit(Pid::from_raw(pid as i32), Resource::As, limit);
}

/// Has orphans of planners become children of this process, where they are found.
#[cfg(target_os = "linux")]
pub(super) fn adopt_orphans() {
    let _ = rustix::process::set_child_subreaper(Some(rustix::process::getpid()));
}

#[cfg(not(target_os = "linux"))]
pub(super) fn limit_memory(_pid: u32, _bytes: u64) {}

#[cfg(not(target_os = "linux"))]
pub(super) fn adopt_orphans() {}

/// Kills what bears the mark of planners of this process once its standard input ends: replan holds the other end, however replan ends.
pub(super) const GUARD: &str = r#"read -r _
for round in 1 2 3; do
  for file in $(grep -lzs "^$1" /proc/[0-9]*/environ); do
    pid=${file#/proc/}; pid=${pid%/environ}
    kill -9 -- "-$pid" 2>/dev/null; kill -9 "$pid" 2>/dev/null
  done
done"#;
