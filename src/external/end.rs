//! Ends a planner with every process that it started, also those that made a session of their own.
//!
//! Its processes are the members of its control group, where it has one. Beside them, or without, they are found in `/proc`: children
//! of children, members of its process group, and whoever inherited the mark that its environment bears. One that cleared its
//! environment, left the group and outlived its parents became a child of replan, and is ended with the last planner at work. All are
//! stopped before any is killed: who is stopped does not fork. Elsewhere than on Linux the process group alone is ended.

use super::interrupt::{MARK, is_guard, planners};
use super::linux::{has_variable, in_control_group, kill_control_group, processes};
use rustix::io::Errno;
use rustix::process::{
    Pid, Signal, WaitOptions, getpgrp, getpid, kill_process, kill_process_group, test_kill_process,
    test_kill_process_group, waitpid,
};
use std::collections::BTreeSet;
use std::io::Write as _;
use std::process::Child;
use std::thread::sleep;
use std::time::Duration;

/// How long processes may take to end by themselves after SIGTERM.
const TERM_ROUNDS: u32 = 30;
/// How often what is left is killed.
const KILL_ROUNDS: u32 = 30;
/// How often it is looked who else is to be stopped.
const STOP_ROUNDS: u32 = 50;
const ROUND: Duration = Duration::from_millis(10);

/// A living process.
struct Seen {
    pid: i32,
    parent: i32,
    group: i32,
}

/// Ends `child` and all its descendants: SIGTERM, a moment, then SIGKILL; those that survive.
pub(super) fn end_all(child: &mut Child, mark: &str) -> Vec<i32> {
    let root = child.id() as i32;
    for round in 0..TERM_ROUNDS {
        // The planner itself is waited for, so that it does not stay as a zombie.
        let _ = child.try_wait();
        let left = members(root, mark);
        if left.is_empty() {
            return left;
        }
        if round == 0 {
            signal(&left, Signal::TERM);
        }
        sleep(ROUND);
    }
    let left = kill_all(root, mark);
    let _ = child.try_wait();
    left
}

/// Kills every planner at work with all that it started; the processes that survive.
pub fn end_planners() -> Vec<i32> {
    // Whoever is about to start is in no hands but those of the system, and ends with this process.
    planners().iter().filter_map(|(mark, root)| Some(kill_all((*root)?, mark))).flatten().collect()
}

/// Whether a process of this number lives.
pub fn is_living(pid: i32) -> bool {
    Pid::from_raw(pid).is_some_and(|pid| test_kill_process(pid) != Err(Errno::SRCH))
}

/// Names the processes that are `left` on standard error.
pub fn name_survivors(left: &[i32]) {
    if let Some(message) = survivors(left) {
        // A reader that closed the pipe is no reason to fail here.
        let _ = writeln!(std::io::stderr(), "{message}");
    }
}

/// That processes are `left`; nothing if none is.
fn survivors(left: &[i32]) -> Option<String> {
    let listed: Vec<String> = left.iter().map(i32::to_string).collect();
    let named = || format!("replan: processes of planners that could not be ended: {}", listed.join(", "));
    (!left.is_empty()).then(named)
}

/// Kills the planner `root` and all its descendants; those that survive.
pub(super) fn kill_all(root: i32, mark: &str) -> Vec<i32> {
    for _ in 0..KILL_ROUNDS {
        let mut stopped = BTreeSet::new();
        for _ in 0..STOP_ROUNDS {
            let new: Vec<i32> = members(root, mark).into_iter().filter(|pid| stopped.insert(*pid)).collect();
            if new.is_empty() {
                break;
            }
            signal(&new, Signal::STOP);
        }
        if stopped.is_empty() {
            return Vec::new();
        }
        // Groups are killed at once, forks at work among them.
        kill_control_group(mark);
        let _ = Pid::from_raw(root).map(|group| kill_process_group(group, Signal::KILL));
        let stopped: Vec<i32> = stopped.into_iter().collect();
        signal(&stopped, Signal::KILL);
        sleep(ROUND);
        for pid in stopped.into_iter().filter(|pid| *pid != root).filter_map(Pid::from_raw) {
            // Orphans are children of this process; nobody else waits for them.
            let _ = waitpid(Some(pid), WaitOptions::NOHANG);
        }
    }
    members(root, mark)
}

fn signal(pids: &[i32], signal: Signal) {
    for pid in pids.iter().copied().filter_map(Pid::from_raw) {
        // It may have ended meanwhile.
        let _ = kill_process(pid, signal);
    }
}

/// The living processes that belong to the planner `root`.
pub(super) fn members(root: i32, mark: &str) -> Vec<i32> {
    let all = living(root);
    let wanted = format!("{MARK}={mark}");
    let planners = planners();
    let is_last = planners.keys().all(|other| other == mark);
    let [own, own_group] = [getpid(), getpgrp()].map(Pid::as_raw_nonzero).map(i32::from);
    let is_orphan = |seen: &Seen| {
        is_last && seen.parent == own && seen.group != own_group && !is_guard(seen.pid) && seen.pid != root
    };
    let mut found: BTreeSet<i32> = all
        .iter()
        .filter(|seen| {
            seen.pid == root || seen.group == root || is_orphan(seen) || has_variable(seen.pid, &wanted)
        })
        .map(|seen| seen.pid)
        .chain(in_control_group(mark))
        .collect();
    loop {
        let before = found.len();
        found.extend(
            all.iter().filter(|seen| found.contains(&seen.parent)).map(|s| s.pid).collect::<Vec<_>>(),
        );
        if found.len() == before {
            return found.into_iter().collect();
        }
    }
}

/// All processes; where they cannot be seen, the group of `root` alone.
fn living(root: i32) -> Vec<Seen> {
    let Some(all) = processes() else { return group(root) };
    all.into_iter().map(|[pid, parent, group]| Seen { pid, parent, group }).collect()
}

/// The process group of the planner `root`, by its leader, as long as anybody is in it.
fn group(root: i32) -> Vec<Seen> {
    let Some(leader) = Pid::from_raw(root) else { return Vec::new() };
    // A leader that has ended stays in its group until it is waited for.
    let _ = waitpid(Some(leader), WaitOptions::NOHANG);
    let is_left = test_kill_process_group(leader).is_ok();
    is_left.then_some(Seen { pid: root, parent: 0, group: root }).into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::os::unix::process::CommandExt as _;
    use std::process::Command;

    #[test]
    fn survivors_are_named_by_number() {
        let message = "replan: processes of planners that could not be ended: 7, 11";
        assert_eq!(survivors(&[7, 11]).as_deref(), Some(message));
        assert_eq!(survivors(&[]), None);
    }

    #[test]
    fn without_proc_a_group_is_seen_until_its_last_process_is_killed() {
        let mut command = Command::new("sh");
        let mut child = command.args(["-c", "sleep 100 & exit 0"]).process_group(0).spawn().unwrap();
        let root = child.id() as i32;
        sleep(ROUND);
        assert_eq!(group(root).len(), 1, "its background process is in the group");
        kill_process_group(Pid::from_raw(root).unwrap(), Signal::KILL).unwrap();
        let is_over = (0..500).any(|_| {
            sleep(ROUND);
            group(root).is_empty()
        });
        assert!(is_over && !is_living(root));
        assert!(child.wait().is_err(), "it was waited for with its group");
        assert!(is_living(std::process::id() as i32));
    }
}
