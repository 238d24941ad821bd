//! Linux's means against processes that outlive their planner: `/proc`, the adoption of orphans, a guard, control
//! groups, and a launcher with a death signal. `not_linux.rs` replaces this file elsewhere; docs/SECURITY.md lists what
//! is then missing.
//!
//! The launcher is replan itself, started under another name. Linux kills it as soon as replan ends. It joins the
//! planner's control group, limits its memory, and becomes the planner. A control group holds whatever its members
//! start, and all in it die at once.

use rustix::process::{
    Pid, Resource, Rlimit, Signal, getpid, getppid, prlimit, set_child_subreaper,
    set_parent_process_death_signal,
};
use std::convert::Infallible;
use std::env::{ArgsOs, args_os, var_os};
use std::ffi::OsStr;
use std::fs::{self, File};
use std::io::{self, Write as _};
use std::os::fd::{AsFd as _, RawFd};
use std::os::unix::process::CommandExt as _;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitCode, Stdio};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

/// The name under which replan starts itself as a launcher.
const LAUNCHER: &str = "replan-launcher";

/// The variable that keeps planners in replan's own control group if it is `off`.
const CONTROL_GROUPS: &str = "REPLAN_CONTROL_GROUPS";

/// Whether this program can be started as a launcher.
static IS_LAUNCHER: AtomicBool = AtomicBool::new(false);

/// Becomes a planner if this process was started as a launcher; returns the exit code if it cannot. `None` in any other process: its
/// planners are started through launchers from now on. To be called before anything else.
pub fn launcher() -> Option<ExitCode> {
    let mut arguments = args_os();
    if arguments.next().as_deref() != Some(OsStr::new(LAUNCHER)) {
        IS_LAUNCHER.store(true, Ordering::Relaxed);
        return None;
    }
    let Err(error) = become_planner(arguments);
    eprintln!("{LAUNCHER}: {error}");
    Some(ExitCode::from(127))
}

/// A command that launches a planner by `mark` with `out`, a file of this process, as its output. The planner's command is still to be
/// added, and an output that hears of errors. `None` in a program that is no launcher.
pub(super) fn launcher_command(mark: &str, memory_bytes: u64, out: RawFd) -> Option<Command> {
    if !IS_LAUNCHER.load(Ordering::Relaxed) {
        return None;
    }
    // Also where another file has taken the program's place meanwhile.
    let mut command = Command::new("/proc/self/exe");
    command.arg0(LAUNCHER).arg(getpid().to_string()).arg(out.to_string());
    command.arg(open_control_group(mark).unwrap_or_default()).arg(memory_bytes.to_string());
    Some(command)
}

fn become_planner(mut arguments: ArgsOs) -> io::Result<Infallible> {
    let begun = io::stdout().as_fd().try_clone_to_owned()?;
    let Err(error) = exec(&mut arguments);
    if let Some(code) = error.raw_os_error() {
        File::from(begun).write_all(code.to_string().as_bytes())?;
    }
    Err(error)
}

fn exec(arguments: &mut ArgsOs) -> io::Result<Infallible> {
    let mut next = || arguments.next()?.into_string().ok();
    let given = (|| Some(([next()?, next()?, next()?], next()?.parse().ok()?)))();
    let ([parent, out, group], memory_bytes) = given.ok_or(io::ErrorKind::InvalidInput)?;
    let mut command = Command::new(arguments.next().ok_or(io::ErrorKind::InvalidInput)?);
    command.args(arguments);
    set_parent_process_death_signal(Some(Signal::KILL))?;
    if getppid().map(|pid| pid.to_string()) != Some(parent.clone()) {
        return Err(io::Error::other("replan has ended"));
    }
    if !group.is_empty() {
        // Without it the planner is found by its parent, its process group and its mark.
        let _ = write_to(&Path::new(&group).join("cgroup.procs"), "0");
    }
    rustix::stdio::dup2_stdout(File::options().write(true).open(format!("/proc/{parent}/fd/{out}"))?)?;
    limit_memory(getpid().as_raw_nonzero().get() as u32, memory_bytes);
    Err(command.exec())
}

/// Limits the address space of a process; a lower limit of the system's own stays.
pub(super) fn limit_memory(pid: u32, bytes: u64) {
    let limit = Rlimit { current: Some(bytes), maximum: Some(bytes) };
    // A process that has ended already is noticed when it says nothing.
    let _ = prlimit(Pid::from_raw(pid as i32), Resource::As, limit);
}

/// Has orphans of planners become children of this process, where they are found, and starts a guard. Once replan ends, however it
/// does, the guard kills what is in control groups of this process and what bears `mark` with its number.
pub(super) fn start_guard(mark: &str) -> Option<Child> {
    // The guard's standard input ends with replan, which holds the other end.
    const GUARD: &str = r#"read -r _
for round in 1 2 3; do
  for group in ${2:+"$2".*}; do
    [ -w "$group/cgroup.kill" ] && { echo 1 > "$group/cgroup.kill"; rmdir "$group" || sleep 0.1; }
  done
  for file in $(grep -lzs "^$1" /proc/[0-9]*/environ); do
    pid=${file#/proc/}; pid=${pid%/environ}
    kill -9 -- "-$pid" 2>/dev/null; kill -9 "$pid" 2>/dev/null
  done
done"#;
    let _ = set_child_subreaper(Some(getpid()));
    let process = getpid().to_string();
    let groups = control_group(&process).unwrap_or_default();
    let mut command = Command::new("sh");
    command.args(["-c", GUARD, "replan-guard"]).arg(format!("{mark}={process}[.]")).arg(groups);
    command.process_group(0).stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::null());
    command.spawn().ok()
}

/// The place of the control group of the planner `mark`.
fn control_group(mark: &str) -> Option<PathBuf> {
    Some(own_control_group()?.join(format!("replan-{mark}")))
}

/// The control group of this process, of the second version; `None` where there is none or it is not wanted.
fn own_control_group() -> Option<&'static Path> {
    static OWN: OnceLock<Option<PathBuf>> = OnceLock::new();
    let find = || {
        if var_os(CONTROL_GROUPS).is_some_and(|value| value == "off") {
            return None;
        }
        let mounts = fs::read_to_string("/proc/self/mounts").ok()?;
        let root = mounts.lines().find_map(|line| match *line.split(' ').take(3).collect::<Vec<_>>() {
            [_, place, "cgroup2"] => Some(place.to_owned()),
            _ => None,
        })?;
        let groups = fs::read_to_string("/proc/self/cgroup").ok()?;
        let own = groups.lines().find_map(|line| line.strip_prefix("0::/"))?;
        let is_below = !own.split('/').any(|part| part == "..");
        is_below.then(|| Path::new(&root).join(own))
    };
    OWN.get_or_init(find).as_deref()
}

/// Makes the control group of the planner `mark`; `None` where this user may not, or the system cannot kill groups.
fn open_control_group(mark: &str) -> Option<PathBuf> {
    static IS_CLEAR: OnceLock<()> = OnceLock::new();
    let group = control_group(mark)?;
    IS_CLEAR.get_or_init(|| clear_control_groups(group.parent().unwrap_or(&group)));
    fs::create_dir(&group).ok()?;
    if group.join("cgroup.kill").exists() {
        return Some(group);
    }
    close_control_group(mark);
    None
}

/// Removes the empty groups that killed processes left.
fn clear_control_groups(own: &Path) {
    let process = getpid().to_string();
    for entry in fs::read_dir(own).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let owner = name.to_str().and_then(|name| name.strip_prefix("replan-")?.split('.').next());
        if owner.is_some_and(|owner| owner == process || !Path::new("/proc").join(owner).exists()) {
            // One in which somebody lives stays.
            let _ = fs::remove_dir(entry.path());
        }
    }
}

/// Removes the control group of the planner `mark`; one in which somebody survived stays.
pub(super) fn close_control_group(mark: &str) {
    if let Some(group) = control_group(mark) {
        let _ = fs::remove_dir(group);
    }
}

/// The processes in the control group of the planner `mark`.
pub(super) fn in_control_group(mark: &str) -> Vec<i32> {
    let processes = control_group(mark).and_then(|group| fs::read_to_string(group.join("cgroup.procs")).ok());
    // A process of another namespace has no number here.
    let numbers =
        |text: &String| text.lines().filter_map(|line| line.parse().ok()).filter(|pid| *pid > 0).collect();
    processes.as_ref().map(numbers).unwrap_or_default()
}

/// Kills everybody in the control group of the planner `mark`; nobody there can fork meanwhile.
pub(super) fn kill_control_group(mark: &str) {
    if let Some(group) = control_group(mark) {
        let _ = write_to(&group.join("cgroup.kill"), "1");
    }
}

/// Writes to a file that is there.
fn write_to(path: &Path, text: &str) -> io::Result<()> {
    File::options().write(true).open(path)?.write_all(text.as_bytes())
}

/// Each living process with its parent and its process group; `None` without `/proc`.
pub(super) fn processes() -> Option<Vec<[i32; 3]>> {
    let entries = fs::read_dir("/proc").ok()?.flatten();
    let pids = entries.filter_map(|entry| entry.file_name().to_str()?.parse().ok());
    Some(pids.filter_map(process).collect())
}

/// `/proc/PID/stat`: the name stands in brackets and may hold anything; state, parent and group follow. Zombies are dead.
fn process(pid: i32) -> Option<[i32; 3]> {
    let stat = fs::read_to_string(format!("/proc/{pid}/stat")).ok()?;
    let mut rest = stat.rsplit_once(')')?.1.split_whitespace();
    let state = rest.next()?;
    let parent = rest.next()?.parse().ok()?;
    let group = rest.next()?.parse().ok()?;
    (!["Z", "X"].contains(&state)).then_some([pid, parent, group])
}

/// Whether a process has `entry` in its environment.
pub(super) fn has_variable(pid: i32, entry: &str) -> bool {
    let environment = fs::read(format!("/proc/{pid}/environ")).unwrap_or_default();
    environment.split(|byte| *byte == 0).any(|found| found == entry.as_bytes())
}
