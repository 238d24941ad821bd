//! However replan ends, its planners end with it; and an interrupt ends replan, whatever a planner does.

use super::scripts::Case;
use super::{alive, bench, soon, soon_within};
use crate::paper::Bench;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use study::clock::now_ns;

const RUN: [&str; 3] = ["run", "./outside", "--trust"];

/// A paper with one planner, which is waited for for an hour.
fn patient(name: &'static str, script: &str) -> Bench {
    let script = script.to_owned().leak();
    let bench = bench(&[&Case { name, script, status: "", reason: "" }]);
    bench.edit("outside/study.toml", "time_s = 60.0", "time_s = 3600.0");
    bench.edit("outside/study.toml", "output_mb = 4", "output_mb = 1000");
    bench
}

/// A run at work on one planner.
struct AtWork {
    bench: Bench,
    run: Child,
}

impl AtWork {
    /// Waits until the planner has made the file `ready` in the folder that it was started in.
    fn start(name: &'static str, script: &str, control_groups: &str) -> Self {
        let bench = patient(name, script);
        let mut command = bench.command(&RUN);
        let run = command.env("REPLAN_CONTROL_GROUPS", control_groups).spawn().unwrap();
        Self { bench, run }
    }

    fn await_planner(&self, name: &str) {
        let is_ready = || self.bench.at("ready").exists();
        assert!(soon_within(60, is_ready), "{name}: the planner was not seen");
    }

    fn signal(&self, signal: &str) {
        let kill = Command::new("kill").args([&format!("-{signal}"), &self.run.id().to_string()]).status();
        assert!(kill.unwrap().success());
    }

    fn has_ended(&self) -> bool {
        super::run_has_ended(self.run.id())
    }

    /// The control group of the process whose command line holds `text`; `None` where it shares that of the tests.
    fn control_group(text: &str) -> Option<PathBuf> {
        let group =
            |process: &str| std::fs::read_to_string(format!("/proc/{process}/cgroup")).unwrap_or_default();
        let (pid, _) = super::processes(text).pop().expect("it was seen");
        let own = group("self");
        let of_version_2 =
            |text: &str| text.lines().find_map(|line| line.strip_prefix("0::").map(PathBuf::from));
        of_version_2(&group(&pid)).filter(|found| Some(found) != of_version_2(&own).as_ref())
    }
}

/// Deaf to what can be ignored, in sessions of their own, with parents that have ended.
const DEAF: &str = "hello; query; trap '' TERM INT HUP QUIT
  (setsid sh -c 'trap \"\" TERM INT HUP; sleep 770011; :' &)
  setsid setsid sh -c 'sleep 770012; :' &
  : > ready; while :; do sleep 770013; done";

#[test]
fn replan_interrupted_or_killed_takes_its_planners_with_it() {
    for control_groups in ["", "off"] {
        for (signals, code) in [
            (&["INT"][..], Some(130)),
            (&["INT", "INT"], Some(130)),
            (&["TERM"], Some(130)),
            (&["KILL"], None),
        ] {
            let mut at_work = AtWork::start("hang-on", DEAF, control_groups);
            at_work.await_planner("hang-on");
            for signal in signals {
                at_work.signal(signal);
            }
            assert!(soon(|| at_work.has_ended()), "{signals:?}: replan goes on");
            assert_eq!(at_work.run.wait().unwrap().code(), code, "{signals:?}");
            let is_gone = || alive("sleep 77001").is_empty() && alive("hang-on.sh").is_empty();
            assert!(soon(is_gone), "{signals:?}: left alone: {:?}", alive("sleep 77001"));
        }
    }
}

#[test]
fn a_planner_that_kills_replan_does_not_outlive_it() {
    let script = "hello; query; (setsid sleep 770021) & sleep 0.1; kill -9 $PPID; sleep 770022";
    let mut at_work = AtWork::start("kills-its-parent", script, "off");
    assert_eq!(at_work.run.wait().unwrap().code(), None, "replan was not killed");
    let is_gone = || alive("sleep 77002").is_empty() && alive("kills-its-parent.sh").is_empty();
    assert!(soon(is_gone), "left alone: {:?}", alive("sleep 77002"));
}

#[test]
fn a_planner_without_guard_group_and_mark_still_ends_with_a_replan_that_is_killed() {
    // It has killed the guard and bears no mark: the death signal alone is left.
    let script = "hello; query; trap '' TERM INT HUP
  for file in /proc/[0-9]*/stat; do
    read -r pid rest < $file; rest=${rest##*) }; set -- $rest
    [ \"$2\" = \"$PPID\" ] && [ \"$pid\" != $$ ] && kill -9 $pid
  done
  : > ready; exec env -i sleep 770031";
    let mut at_work = AtWork::start("kills-the-guard", script, "off");
    at_work.await_planner("kills-the-guard");
    assert!(soon(|| alive("sleep 770031").len() == 1), "the planner was not seen");
    let guard = format!("replan-guard REPLAN_PLANNER={}", at_work.run.id());
    assert_eq!(alive(&guard), [""; 0], "the planner did not kill the guard");
    at_work.signal("KILL");
    at_work.run.wait().unwrap();
    assert!(soon(|| alive("sleep 770031").is_empty()), "the planner outlives replan");
}

#[test]
fn where_there_are_control_groups_nothing_outlives_a_replan_that_is_killed() {
    // A daemon: another session, another parent, no mark. It forks as fast as it can.
    let script = "hello; query; trap '' TERM INT HUP
  (setsid env -i sh -c 'trap \"\" TERM INT HUP; while :; do (sleep 770041 &); sleep 0.01; done' &)
  : > ready; while :; do sleep 770042; done";
    let mut at_work = AtWork::start("daemon", script, "");
    at_work.await_planner("daemon");
    let is_seen = || ["sleep 770041", "sleep 770042"].iter().all(|sleep| !alive(sleep).is_empty());
    assert!(soon(is_seen), "the daemon was not seen");
    let group = AtWork::control_group("sleep 770042");
    at_work.signal("KILL");
    at_work.run.wait().unwrap();
    let Some(group) = group else {
        eprintln!("no control group can be made here: that a daemon ends is not tested");
        end_all("770041");
        return;
    };
    assert!(soon(|| alive("77004").is_empty()), "left alone: {:?}", alive("77004"));
    let name = group.file_name().unwrap().to_string_lossy().into_owned();
    assert!(name.starts_with(&format!("replan-{}.", at_work.run.id())), "{name}");
    let mounts = std::fs::read_to_string("/proc/self/mounts").unwrap();
    let root = mounts.lines().find(|line| line.contains(" cgroup2 ")).unwrap().split(' ').nth(1).unwrap();
    let place = format!("{root}{}", group.display());
    assert!(soon(|| !std::path::Path::new(&place).exists()), "{place} is left");
}

/// Starts a process of another user, and waits until it is one.
const OF_ANOTHER: &str = "hello; query; setpriv --reuid=65534 --clear-groups sleep 600.01 & another=$!
  until grep -q 'Uid:.65534' /proc/$another/status; do sleep 0.01; done; echo $another > another
  : > ready";

#[test]
fn processes_that_replan_may_not_kill_are_named_at_the_end_and_after_an_interrupt() {
    let without_right = ["--bounding-set=-kill", "setpriv", "--reuid=65534", "--clear-groups", "true"];
    if !Command::new("setpriv").args(without_right).status().is_ok_and(|status| status.success()) {
        eprintln!("no process of another user can be started here: that survivors are named is not tested");
        return;
    }
    for (name, then, code) in [("done", "straight; query", 0), ("at-work", "sleep 600.02", 130)] {
        let bench = patient(name, &format!("{OF_ANOTHER}; {then}"));
        let replan = bench.command(&RUN);
        let mut run = Command::new("setpriv");
        run.arg(without_right[0]).arg(replan.get_program()).args(RUN).current_dir(bench.at(""));
        run.env("XDG_STATE_HOME", bench.at("state")).env("REPLAN_CONTROL_GROUPS", "off");
        let run = run.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
        let at_work = AtWork { bench, run };
        at_work.await_planner(name);
        if code == 130 {
            at_work.signal("INT");
        }
        let AtWork { bench, run } = at_work;
        let output = bench.output(&run.wait_with_output().unwrap());
        let another = std::fs::read_to_string(bench.at("another")).unwrap();
        let survivors = alive("sleep 600.01");
        end_all("sleep 600.01");
        assert_eq!(output.code, Some(code), "{}", output.err);
        assert_eq!(survivors, ["sleep 600.01 "], "it was killed");
        let named = format!("replan: processes of planners that could not be ended: {another}");
        assert!(output.err.contains(&named), "{named}{}", output.err);
        assert!(soon(|| alive("sleep 600.02").is_empty()), "{name}: one that can be killed was not");
    }
}

/// Ends what a test has started and replan cannot end.
fn end_all(text: &str) {
    while let Some((pid, _)) = super::processes(text).pop() {
        let _ = Command::new("kill").args(["-9", &pid]).status();
    }
}

/// Ways to hold up whoever waits, each with a process that can be counted.
// A planner of another test is called `silent`.
const HOLD_UP: [(&str, &str); 9] = [
    ("deaf", DEAF),
    ("says-nothing", ": > ready; sleep 770014"),
    ("never-reads", "hello; : > ready; sleep 770014"),
    ("stopped", "hello; query; : > ready; kill -STOP $$; sleep 770014"),
    ("half-a-line", "hello; query; : > ready; while :; do printf x; sleep 0.01; done"),
    ("loud-log", "hello; query; : > ready; yes >&2"),
    (
        "asks-without-end",
        r#"hello; query; : > ready; motions=$(yes '[[0,1],[299,200]],' | head -n 5000 | tr -d '\n')
  while :; do echo "{\"type\":\"ask\",\"id\":$id,\"motion\":[$motions[[0,1],[299,200]]]}"; read -r answer; done"#,
    ),
    (
        "incumbents-without-end",
        r#"hello; query; : > ready
  while :; do printf '{"type":"incumbent","id":%s,"cost":null,"path":[%s,%s]}\n' "$id" "$start" "$goal"; sleep 0.01; done"#,
    ),
    ("forks", "hello; query; : > ready; while :; do setsid sleep 770015 & sleep 0.05; done"),
];

/// An interrupt ends replan within two seconds on a machine at rest. The test grants five times that, by its own rounds, which a busy
/// machine makes longer; whoever waited for one of these planners would wait for an hour.
const GRANTED_S: u32 = 10;

#[test]
fn whatever_a_planner_does_an_interrupt_ends_replan_with_all_its_planners() {
    for signal in ["INT", "TERM"] {
        for (name, script) in HOLD_UP {
            let mut at_work = AtWork::start(name, &script.replace("77001", "77005"), "");
            at_work.await_planner(name);
            assert!(!at_work.has_ended(), "{name}: replan did not wait for its planner");
            let begun = now_ns();
            at_work.signal(signal);
            assert!(soon_within(GRANTED_S, || at_work.has_ended()), "{name}: replan goes on after {signal}");
            eprintln!("{signal} {name}: {:.1} s", (now_ns() - begun) as f64 * 1e-9);
            assert_eq!(at_work.run.wait().unwrap().code(), Some(130), "{name} {signal}");
            let left = || [alive(&format!("outside/{name}.sh")), alive("sleep 77005")].concat();
            assert!(soon(|| left().is_empty()), "{name} {signal}: left alone: {:?}", left());
        }
    }
}
