//! A tiny paper in a folder of its own, and the program run on it.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

/// Of `all` cases that a test draws, those that it draws now: a fifth, or all where `REPLAN_THOROUGH` is set.
pub fn thoroughly(all: usize) -> usize {
    if std::env::var_os("REPLAN_THOROUGH").is_some() { all } else { all / 5 }
}

const PAPER: &str = r#"[source]
title = "A tiny paper"
authors = "N. N."

[prints]
figures = 1
tables = 1
equations = 0

[[inventory]]
item = "Fig. 1"
says = "a search in a room"
figures = ["fig1"]

[[inventory]]
item = "Table 1"
says = "cost and nodes"
figures = ["table1"]
[[table]]
id = "table1"
at = "Table 1"
caption = "Printed and ours"
column = [{ id = "cost", label = "Cost", unit = "cells" }]
row = [{ id = "astar", label = "A*", printed = ["7.83"], cell.cost.id = "cost" }]
[table.check.exists]
metric = "path_cost_cells"
contenders = ["A*"]
in = [{ study = "room", problems = ["room"] }]

[[claim]]
id = "nodes"
at = "section 1"
says = "two sides open fewer nodes"
[claim.check.lower]
is = "lower"
[claim.check.lower.select]
study = "draws"
problems = "drawn"
metric = "nodes"
contender = "Two-sided"
against = "A*"

[[choice]]
id = "nodes"
why = "not said"
default = "opened"
[choice.option]
opened = { metric = { nodes = "opened" } }
closed = { metric = { nodes = "closed" } }

[[choice]]
id = "corners"
why = "not said"
default = "allow"
[choice.option.allow]
problem = { corner_rule = "allow" }
[choice.option.forbid_any]
problem = { corner_rule = "forbid_any" }
"#;

/// The end of the contenders of `draws.toml`, behind which a sweep or a `[[keep]]` may stand.
pub const CONTENDERS_END: &str = "settings = { line_of_sight = \"exact_interior\" } }]\n";

const DRAWS: &str = r#"paper = "mini"
question = "Which side opens more?"
seed = 7

[budget]
expansions = 10_000

[quick]
instances = 3

[timing]
problems = 2
repeats = 2

[[problems]]
label = "drawn"
family = "random_cells"
instances = 24
settings = { size_cells = [12, 12], start = [0, 0], goal = [11, 9], blocked_share = 0.3, corner_rule = "allow" }

[[contender]]
label = "A*"
planner = "astar"
settings = { weight = 1, ties = "fifo" }

[[contender]]
label = "Two-sided"
planner = "bidirectional"
settings = { weight = "one", meeting = "generated_any", side = "alternate", ties = "fifo" }
then = [{ stage = "delete_inflections", settings = { line_of_sight = "exact_interior" } }]
"#;

const ROOM: &str = r#"paper = "mini"
question = "What does the room cost?"
seed = 8
searched = true
leaves_out = ["corners"]

[budget]
expansions = 10_000

[quick]
instances = 1

[[problems]]
label = "room"
family = "grid_map"
settings = { map = "room.map.txt", start = [0, 0], goal = [6, 3], corner_rule = "forbid_any" }

[[contender]]
label = "A*"
planner = "astar"
settings = { weight = 1, ties = "fifo" }

[[figure]]
id = "fig1"
kind = "grid_search"
caption = "A search in a room."
shows = [{ problems = "room", instances = 1 }]
settings = { problems = ["room"], contenders = ["A*"] }
"#;

const MAP: &str = "; a room with a wall\n.......\n...#...\n...#...\n...#...\n";

const PLANE: &str = r#"paper = "mini"
question = "Is there a way round?"
seed = 9
[budget]
expansions = 1_000
[quick]
instances = 1
[[problems]]
label = "plane"
family = "plane_queries"
instances = 2
settings = { map = "bar.toml", samples = 30, radius_mm = 40 }
[[contender]]
label = "Improved A*"
planner = "roadmap_astar"
settings = { samples = 30, neighbour_mm = 40, cost = "hops", goal_shot = "never", path = "parents" }
"#;

/// The papers that are committed, by name.
pub fn committed() -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("experiments");
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap());
    let papers = entries.filter(|entry| entry.path().join("paper.toml").is_file());
    let mut names: Vec<String> = papers.map(|entry| entry.file_name().into_string().unwrap()).collect();
    names.sort();
    assert!(names.len() >= 7, "{names:?}");
    names
}

/// A folder that holds the paper `mini` and whatever is run on it.
pub struct Bench {
    folder: TempDir,
}

/// What the program said; the bench's folder is written as `[dir]`.
#[derive(Debug, PartialEq)]
pub struct ProgramOutput {
    pub code: Option<i32>,
    pub out: String,
    /// Standard error, but for the lines in `doing`.
    pub err: String,
    /// The lines of standard error that say what is being done: they end in an ellipsis.
    pub doing: Vec<String>,
}

impl Bench {
    /// A fresh folder with nothing in it.
    pub fn empty() -> Self {
        Self { folder: tempfile::tempdir().unwrap() }
    }

    /// A fresh folder with the paper.
    pub fn new() -> Self {
        let bench = Self::empty();
        for (name, text) in [("paper", PAPER), ("draws", DRAWS), ("room", ROOM)] {
            bench.write(&format!("mini/{name}.toml"), text.as_bytes());
        }
        bench.write("mini/room.map.txt", MAP.as_bytes());
        bench
    }

    /// Gives the paper a third study, of roadmaps of a particle that goes round a bar.
    pub fn add_plane(&self) {
        let map = "name = 'bar'\nsize_mm = [100, 100]\nstart_mm = [5, 5]\ngoal_mm = [95, 95]\n[[obstacle]]\n\
                   corners_mm = [[40, 0], [60, 0], [60, 50], [40, 50]]\n";
        self.write("bar.toml", map.as_bytes());
        self.write("mini/plane.toml", PLANE.as_bytes());
    }

    /// The place called `name` in the folder.
    pub fn at(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Writes a file, making folders on the way.
    pub fn write(&self, name: &str, bytes: &[u8]) {
        fs::create_dir_all(self.at(name).parent().unwrap()).unwrap();
        fs::write(self.at(name), bytes).unwrap();
    }

    /// Replaces `from`, which must stand in the file once or more, by `to` where it stands first.
    pub fn edit(&self, name: &str, from: &str, to: &str) {
        let text = fs::read_to_string(self.at(name)).unwrap();
        assert!(text.contains(from), "{name} does not hold `{from}`");
        let mut text = text.replacen(from, to, 1);
        if text.starts_with("# seal: ") {
            // An edited manifest is one of before there were seals: what it says is then held against the study.
            text.drain(..=text.find('\n').unwrap());
        }
        fs::write(self.at(name), text).unwrap();
    }

    /// Every file below `name` with its bytes, but for what only a run at work has.
    pub fn tree(&self, name: &str) -> BTreeMap<PathBuf, Vec<u8>> {
        let mut found = BTreeMap::new();
        collect(&self.at(name), &mut found);
        found
    }

    /// The records below `name` that must repeat: trials, preprocessed objects, traces.
    pub fn facts(&self, name: &str) -> BTreeMap<String, Vec<u8>> {
        let is_fact = |path: &str| {
            ["trials", "preprocessing", "traces"]
                .iter()
                .any(|part| path.ends_with(&format!(".{part}.parquet")))
        };
        let named = self
            .tree(name)
            .into_iter()
            .map(|(path, bytes)| (path.file_name().unwrap().to_string_lossy().into_owned(), bytes));
        named.filter(|(path, _)| is_fact(path)).collect()
    }

    /// The program, ready to be called with `arguments` in the folder.
    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_replan"));
        command.current_dir(self.folder.path()).args(arguments);
        command.env("XDG_STATE_HOME", self.at("state"));
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    }

    /// Runs the program to its end.
    pub fn run(&self, arguments: &[&str]) -> ProgramOutput {
        self.output(&self.command(arguments).output().unwrap())
    }

    /// Runs the program, which must succeed, and gives what it printed.
    pub fn done(&self, arguments: &[&str]) -> String {
        let output = self.run(arguments);
        assert_eq!(output.code, Some(0), "{arguments:?}\n{}{}", output.out, output.err);
        output.out
    }

    pub fn output(&self, output: &Output) -> ProgramOutput {
        let place = self.folder.path().display().to_string();
        let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap().replace(&place, "[dir]");
        let message = text(&output.stderr);
        let (doing, rest): (Vec<&str>, Vec<&str>) =
            message.split_inclusive('\n').partition(|line| line.ends_with(" …\n"));
        let doing = doing.iter().map(|line| line.trim_end().to_owned()).collect();
        ProgramOutput { code: output.status.code(), out: text(&output.stdout), err: rest.concat(), doing }
    }
}

fn collect(folder: &Path, found: &mut BTreeMap<PathBuf, Vec<u8>>) {
    for entry in fs::read_dir(folder).into_iter().flatten() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            collect(&path, found);
        } else if !path.ends_with(".lock") {
            found.insert(path.clone(), fs::read(&path).unwrap());
        }
    }
}
