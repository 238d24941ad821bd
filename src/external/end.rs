//! Ends a planner with every process that it started, also those that made a session of their own.
//!
//! Its processes are found in `/proc`: children of children, members of its process group, and whoever inherited the mark that
//! its environment bears. A process that cleared its environment, left the group and outlived its parents is not found.

use rustix::process::{Pid, Signal, kill_process};
use std::collections::BTreeSet;
use std::fs;
use std::process::Child;
use std::thread::sleep;
use std::time::Duration;

/// The variable of the environment that marks a planner's processes.
pub(super) const MARK: &str = "REPLAN_PLANNER";

/// How long processes may take to end by themselves after SIGTERM.
const TERM_ROUNDS: u32 = 30;
/// How often what is left is killed.
const KILL_ROUNDS: u32 = 200;
const ROUND: Duration = Duration::from_millis(10);

/// A process as `/proc` has it.
struct Seen {
    pid: i32,
    parent: i32,
    group: i32,
}

/// Ends `child` and all its descendants: SIGTERM, then SIGKILL.
pub(super) fn end_all(child: &mut Child, mark: &str) {
    let root = child.id() as i32;
    for (signal, rounds) in [(Signal::TERM, TERM_ROUNDS), (Signal::KILL, KILL_ROUNDS)] {
        for round in 0..rounds {
            // The planner itself is waited for, so that it does not stay as a zombie.
            let _ = child.try_wait();
            let left = members(root, mark);
            if left.is_empty() {
                return;
            }
            if signal == Signal::KILL || round == 0 {
                for pid in left.into_iter().filter_map(Pid::from_raw) {
                    // It may have ended meanwhile.
                    let _ = kill_process(pid, signal);
                }
            }
            sleep(ROUND);
        }
    }
}

/// The living processes that belong to the planner `root`.
pub(super) fn members(root: i32, mark: &str) -> Vec<i32> {
    let all = living();
    let wanted = format!("{MARK}={mark}");
    let is_marked = |pid: i32| {
        let environment = fs::read(format!("/proc/{pid}/environ")).unwrap_or_default();
        environment.split(|byte| *byte == 0).any(|entry| entry == wanted.as_bytes())
    };
    let mut found: BTreeSet<i32> = all
        .iter()
        .filter(|seen| seen.pid == root || seen.group == root || is_marked(seen.pid))
        .map(|seen| seen.pid)
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

fn living() -> Vec<Seen> {
    let entries = fs::read_dir("/proc").into_iter().flatten().flatten();
    let pids = entries.filter_map(|entry| entry.file_name().to_str()?.parse::<i32>().ok());
    pids.filter_map(seen).collect()
}

/// `/proc/PID/stat`: the name stands in brackets and may hold anything; state, parent and group follow. Zombies are dead.
fn seen(pid: i32) -> Option<Seen> {
    let stat = fs::read_to_string(format!("/proc/{pid}/stat")).ok()?;
    let mut rest = stat.rsplit_once(')')?.1.split_whitespace();
    let state = rest.next()?;
    let parent = rest.next()?.parse().ok()?;
    let group = rest.next()?.parse().ok()?;
    (!["Z", "X"].contains(&state)).then_some(Seen { pid, parent, group })
}
