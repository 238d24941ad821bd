//! A planner from outside plans for a six-axis arm in its cell, by asking whether motions are free.

use super::PAPER;
use super::scripts::PRELUDE;
use crate::paper::Bench;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use study::record::{Row, Status};
use study::reuse;

/// The cell of fu2018 with its ten queries, the joints going straight.
const CELL: &str = r#"paper = "outside"
question = "Who finds a way for the arm?"
seed = 3

[budget]
expansions = 100_000

[[problems]]
label = "cell"
family = "cell_queries"
instances = 1
[problems.settings]
robot = "data/robots/motoman_up6.toml"
scene = "data/scenes/fu2018_cell.toml"
queries = "data/scenes/fu2018_groups.toml"
obstacles = true
self_collision = true
samples = 1
counted = "accepted"
region = "full"
radius_mm = 500
path = "joints"
step_mm = 20
step_deg = 4
jump_deg = 20
turn_deg = 180
end = "own"
"#;

/// Goes straight, or by one posture that it knows; what is free it asks.
const ASKS: &str = r#"ask() {
  printf '{"type":"ask","id":%s,"motion":[%s]}\n' "$id" "$1"
  read -r answer
  case $answer in *false*) return 1 ;; *'"motion":[true'*) return 0 ;; esac
  echo "no answer: $answer" >&2; exit 1
}
via='[0,-1.5,0,0,1.5,0]'
world=cell; hello
while query; do
  if ask "[$start,$goal]"; then result "[$start,$goal]"
  elif ask "[$start,$via],[$via,$goal]"; then result "[$start,$via,$goal]"
  else printf '{"type":"result","id":%s,"status":"no_path"}\n' "$id"; fi
done
"#;

/// Goes straight without asking.
const BLIND: &str = "world=cell; hello; while query; do straight; done\n";

/// The rows of one contender by their query.
fn rows(bench: &Bench, contender: &str) -> BTreeMap<String, Row> {
    let (_, records) = reuse::stored(&bench.at("target/replan/outside/data/runs/outside"), "study").unwrap();
    let own = records.batch.rows.into_iter().filter(|row| *row.key.contender == *contender);
    own.map(|row| (format!("{:?}", row.key.query), row)).collect()
}

#[test]
fn a_planner_from_outside_plans_for_the_arm_and_one_that_does_not_ask_is_refused_where_it_collides() {
    let bench = Bench::empty();
    let home = Path::new(env!("CARGO_MANIFEST_DIR"));
    for file in ["robots/motoman_up6.toml", "scenes/fu2018_cell.toml", "scenes/fu2018_groups.toml"] {
        bench.write(&format!("data/{file}"), &fs::read(home.join("data").join(file)).unwrap());
    }
    let mut study = CELL.to_owned();
    for (name, script) in [("asks", ASKS), ("blind", BLIND)] {
        let file = format!("outside/{name}.sh");
        bench.write(&file, format!("{PRELUDE}{script}").as_bytes());
        study += &super::contender(name, &format!("[\"sh\", \"{file}\"]"), &format!("[\"{file}\"]"))
            .replace("time_s = 60.0", "time_s = 10.0")
            .replace("any_angle = true, ", "");
    }
    bench.write("outside/paper.toml", PAPER.as_bytes());
    bench.write("outside/study.toml", study.as_bytes());
    bench.done(&["run", "./outside", "--trust"]);
    let asks = rows(&bench, "asks");
    let blind = rows(&bench, "blind");
    assert_eq!((asks.len(), blind.len()), (10, 10));
    let mut detours = 0;
    for (query, row) in &asks {
        assert!(row.is_solved(), "{query}: {:?}", row.reason);
        // One motion if the straight one is free, and the two of the detour if not.
        let is_straight_free = row.value("questions_motion") == Some(1.0);
        let straight = &blind[query];
        assert_eq!(straight.value("questions_motion"), Some(0.0));
        if is_straight_free {
            let length = |row: &Row| row.value("path_length_mm").unwrap();
            assert!(straight.is_solved(), "{query}: {:?}", straight.reason);
            assert!(length(row) == length(straight) && length(row) > 500.0, "{query}: {}", length(row));
        } else {
            detours += 1;
            assert_eq!(row.value("questions_motion"), Some(3.0));
            let reason = straight.reason.clone().unwrap_or_default();
            assert!(
                straight.status == Status::Rejected && reason.contains("touches obstacle"),
                "{query}: {reason}"
            );
        }
    }
    assert!((2..=8).contains(&detours), "{detours} of 10 straight motions collide: one-sided");
}
