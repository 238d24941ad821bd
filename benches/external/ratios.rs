//! The last bench: one table of ours beside its peers, from what the benches before it measured.
//!
//! `cargo bench` runs it after every bench that has a peer; by itself it tells what was measured last. What was not measured has
//! no line, and is counted. README quotes these lines.

use serde_json::Value;
use std::path::{Path, PathBuf};

/// What is asked, where criterion files ours, and the names of the peers beside it.
type Line = (&'static str, &'static str, &'static str, &'static [&'static str]);

const PATHFINDING: &[&str] = &["pathfinding_u32", "pathfinding_typical", "petgraph"];
const ALL: &[&str] =
    &["pathfinding_u32", "pathfinding_typical", "petgraph", "networkx", "pathfinding_python"];
const JPS: &[&str] = &["astar_octile", "pathfinding"];

const LINES: &[Line] = &[
    ("A* on 30×30 cells, 20 % blocked", "30x30", "astar_octile", ALL),
    ("the same through the planner, from request to plan", "30x30", "planner", PATHFINDING),
    ("A* on 512×512, 30 % blocked", "512_random", "astar_octile", PATHFINDING),
    ("A* on 512×512, rectangles", "512_rectangles", "astar_octile", PATHFINDING),
    ("JPS on 512×512, 30 % blocked", "random", "jps", JPS),
    ("JPS on 512×512, rectangles", "rectangles", "jps", JPS),
    ("JPS on 512×512, rooms", "rooms", "jps", JPS),
    ("JPS on 512×512, streets", "streets", "jps", JPS),
    ("JPS+ on 512×512, 30 % blocked", "random", "jps_plus", JPS),
    ("JPS+ on 512×512, rectangles", "rectangles", "jps_plus", JPS),
    ("JPS+ on 512×512, rooms", "rooms", "jps_plus", JPS),
    ("JPS+ on 512×512, streets", "streets", "jps_plus", JPS),
    ("planar arm, A*, 8 neighbours", "astar_8", "ours", &["pathfinding"]),
    ("planar arm, A*, 24 neighbours", "astar_24", "ours", &["pathfinding"]),
    ("planar arm, A*, 48 neighbours", "astar_48", "ours", &["pathfinding"]),
    ("planar arm, A*, 80 neighbours", "astar_80", "ours", &["pathfinding"]),
    ("planar arm, CHS, radius 4", "astar_chs_4", "ours", &["pathfinding"]),
    ("planar arm, CHS, radius 6", "astar_chs_6", "ours", &["pathfinding"]),
    ("six-axis arm in its cell, a configuration", "configuration", "ours", &["parry3d", "mujoco"]),
    ("4096 of them at once, in lanes", "configuration", "ours_4096_at_once", &["ours_4096"]),
    ("six-axis arm, a motion straight in joint space", "motion", "ours", &["parry3d"]),
    (
        "six-axis arm, a roadmap of 1 500 samples in joint space",
        "roadmap",
        "joint_space_1500",
        &["parry3d_1500"],
    ),
    ("200 segments to convex polyhedra, exact", "segment_polyhedron", "exact_x200", &["parry3d_x200"]),
];

/// The median that criterion filed, nanoseconds.
fn median_ns(folder: &Path, group: &str, name: &str) -> Option<f64> {
    let text = std::fs::read_to_string(folder.join(group).join(name).join("new/estimates.json")).ok()?;
    serde_json::from_str::<Value>(&text).ok()?["median"]["point_estimate"].as_f64()
}

fn in_words(ns: f64) -> String {
    let (scale, unit) =
        [(1e6, "ms"), (1e3, "µs")].into_iter().find(|(scale, _)| ns >= *scale).unwrap_or((1.0, "ns"));
    format!("{:.3} {unit}", ns / scale)
}

fn main() {
    let target = std::env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    let target = target.unwrap_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../target"));
    let folder = target.join("criterion");
    let mut missing = 0;
    println!("| what | ours | beside | takes | ratio |\n|---|---|---|---|---|");
    for (what, group, own, peers) in LINES {
        for peer in *peers {
            let [ours, theirs] = [own, peer].map(|name| median_ns(&folder, group, name));
            match ours.zip(theirs) {
                Some((ours, theirs)) => {
                    let [a, b] = [ours, theirs].map(in_words);
                    println!("| {what} | {a} | `{peer}` | {b} | {:.2} |", theirs / ours);
                }
                None => missing += 1,
            }
        }
    }
    if missing > 0 {
        println!("\n{missing} lines were not measured: `cargo bench` measures all");
    }
}
