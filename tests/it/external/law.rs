//! What `motion` accepts, the verifier accepts: over random motions in every world of the protocol.

use crate::paper::thoroughly;
use base::seed;
use base::settings::Settings;
use engine::planner::{Build, Counts, Ending, Plan, Request};
use engine::space::World;
use engine::space::roadmap::Local;
use external::message::Ask;
use external::world::Pose;
use external::{Space, Unanswered, describe};
use rand::RngExt as _;
use std::cell::Cell;
use std::path::PathBuf;
use study::contender::Pipeline;
use study::family::{self, Query};
use study::record::Status;
use study::verification::{Guide, truth, verify};
use study::{Inputs, planner};

/// Draws a number from `low` to `high`.
type Draw<'a> = dyn FnMut(f64, f64) -> f64 + 'a;

/// Worlds of one family: what is laid over its example, how many worlds and motions, steps at any angle, and the least and the greatest
/// share of motions that a sample worth drawing accepts.
struct Sample {
    family: &'static str,
    over: &'static str,
    worlds: u64,
    motions: usize,
    any_angle: bool,
    accepts: [f64; 2],
}

const SAMPLES: &[Sample] = &[
    Sample {
        family: "random_cells",
        over: "corner_rule = \"allow\"",
        worlds: 5,
        motions: 3000,
        any_angle: false,
        accepts: [0.05, 0.9],
    },
    Sample {
        family: "random_cells",
        over: "corner_rule = \"forbid_any\"",
        worlds: 5,
        motions: 3000,
        any_angle: true,
        accepts: [0.05, 0.9],
    },
    Sample {
        family: "random_cells",
        over: "corner_rule = \"forbid_both\"",
        worlds: 5,
        motions: 3000,
        any_angle: true,
        accepts: [0.05, 0.9],
    },
    Sample {
        family: "random_cells",
        over: "corner_rule = \"allow\"\nvertices = \"corners\"",
        worlds: 5,
        motions: 3000,
        any_angle: false,
        accepts: [0.05, 0.95],
    },
    Sample {
        family: "random_cells",
        over: "corner_rule = \"allow\"\nvertices = \"corners\"\nblocked_share = 0.5",
        worlds: 5,
        motions: 3000,
        any_angle: true,
        accepts: [0.05, 0.9],
    },
    Sample {
        family: "arm_workspace",
        over: "obstacles_cm = [[0, 35]]\nhop_check = \"continuous\"",
        worlds: 1,
        motions: 15_000,
        any_angle: false,
        accepts: [0.05, 0.95],
    },
    Sample {
        family: "random_polyhedra",
        over: "",
        worlds: 4,
        motions: 5000,
        any_angle: false,
        accepts: [0.05, 0.95],
    },
    Sample {
        family: "plane_queries",
        over: "samples = 1",
        worlds: 1,
        motions: 20_000,
        any_angle: false,
        accepts: [0.05, 0.95],
    },
    Sample {
        family: "cell_queries",
        over: "samples = 1\npath = \"joints\"",
        worlds: 1,
        motions: 3000,
        any_angle: false,
        accepts: [0.02, 0.95],
    },
    Sample {
        family: "cell_queries",
        over: "samples = 1\nend = \"whole_turns\"",
        worlds: 1,
        motions: 3000,
        any_angle: false,
        accepts: [0.02, 0.95],
    },
];

/// A world of every sample.
pub fn worlds() -> Vec<World> {
    SAMPLES.iter().map(|sample| world(sample, 0)).collect()
}

fn world(sample: &Sample, number: u64) -> World {
    let entry = family::find(sample.family).unwrap();
    let settings = Settings::composed("the law", toml::from_str(entry.example).unwrap());
    let settings = settings.overlaid(&toml::from_str(sample.over).unwrap(), "the law");
    let inputs = Inputs::below(vec![PathBuf::from(env!("CARGO_MANIFEST_DIR"))]);
    let family = (entry.build)(&settings, &inputs).unwrap_or_else(|e| panic!("{}: {e}", sample.family));
    let mut draws =
        (0..50).filter_map(|draw| family.prepare(seed::derive(number, &["law", &draw.to_string()])).ok());
    draws.next().unwrap_or_else(|| panic!("{}: no instance of 50 can be posed", sample.family)).world
}

/// Two configurations, near enough that a motion between them may be free.
fn motion(world: &World, draw: &mut Draw<'_>) -> [Vec<f64>; 2] {
    let near = |at: f64, by: f64, draw: &mut Draw<'_>| at + draw(-by, by);
    let pair = |low: Vec<f64>, high: Vec<f64>, by: f64, draw: &mut Draw<'_>| {
        let from: Vec<f64> = low.iter().zip(&high).map(|(low, high)| draw(*low, *high)).collect();
        let to = from.iter().map(|x| near(*x, by, draw)).collect();
        [from, to]
    };
    match world {
        World::Lattice(lattice) => {
            let size = [lattice.grid().width(), lattice.grid().height()].map(|side| f64::from(side) - 1.0);
            pair(vec![0.0; 2], size.to_vec(), 2.4, draw).map(|at| at.into_iter().map(f64::round).collect())
        }
        World::Arm(arm) => {
            let lattice = arm.rules().lattice;
            let size = lattice.size().map(|side| f64::from(side) - 1.0);
            let cells = pair(vec![0.0; 2], size.to_vec(), 3.4, draw);
            let point = |k: usize, cell: f64| lattice.low_cm()[k] + lattice.step_cm() * cell.round();
            cells.map(|at| vec![point(0, at[0]), point(1, at[1])])
        }
        World::Polyhedra(among) => {
            let [low, high] =
                [among.domain().min, among.domain().max].map(|corner| corner.as_slice().to_vec());
            let by = (high[0] - low[0]) / 4.0;
            pair(low, high, by, draw)
        }
        World::Roadmap(roadmap) => match roadmap.local() {
            Local::Plane(map) => {
                let pair = pair(vec![0.0; 2], map.size_mm().to_vec(), map.size_mm()[0] / 4.0, draw);
                pair.map(|at| at.into_iter().map(|x| (x * 16.0).round() / 16.0).collect())
            }
            Local::Arm(lines) => {
                let joints = lines.cell().robot().arm().chain().joints();
                let (low, high) =
                    joints.iter().map(|j| (j.lower_rad.max(-2.0), j.upper_rad.min(2.0))).unzip();
                pair(low, high, 0.3, draw)
            }
            Local::Joints(_) => unreachable!("the protocol has no such world"),
        },
    }
}

fn pipeline(any_angle: bool) -> Pipeline {
    let text = planner::external::ENTRY.example.replace("files = [\"", "files = [] # [\"");
    let text = format!("{text}\nany_angle = {any_angle}\n");
    let settings = Settings::composed("the law", toml::from_str(&text).unwrap());
    let Build::Planner(build) = planner::external::ENTRY.build else { panic!("it plans") };
    Pipeline { planner: build(&settings).unwrap(), stages: Vec::new() }
}

/// Why the verifier refuses the motion as a path; `None` if it does not.
fn refusal(
    world: &World,
    [from, to]: &[Vec<f64>; 2],
    cost: Option<f64>,
    pipeline: &Pipeline,
) -> Option<String> {
    let query = Query { name: String::new(), start: from.clone(), goal: to.clone() };
    let request = Request { world, start: from, goal: to, expansions: 1, seed: 0, trace: false };
    let path = vec![from.clone(), to.clone()];
    let counts = Counts::new();
    let traces = Vec::new();
    let plan = Plan { ending: Ending::Solved, path, cost, counts, traces, reason: None };
    let truth = truth(world, &query, &Guide::default());
    match verify(&request, &plan, pipeline, &truth).outcome {
        (Status::Solved, _) => None,
        (status, reason) => Some(format!("{status}: {}", reason.unwrap_or_default())),
    }
}

#[test]
fn what_motion_accepts_the_verifier_accepts() {
    let mut tried = 0;
    for sample in SAMPLES {
        let mut accepted = 0;
        let mut drawn = 0;
        let mut refused = Vec::new();
        let pipeline = pipeline(sample.any_angle);
        for number in 0..sample.worlds {
            let world = world(sample, number);
            let mut stream =
                seed::stream(seed::derive(23, &["law", sample.family, sample.over, &number.to_string()]));
            let mut draw = |low: f64, high: f64| stream.random_range(low..=high);
            let mut space = Space::new(&world, sample.any_angle);
            assert!(describe(&world, sample.any_angle).is_ok());
            for _ in 0..thoroughly(sample.motions) {
                let pair = motion(&world, &mut draw);
                drawn += 1;
                if space.is_free(&pair[0], &pair[1]) == Ok(true) {
                    accepted += 1;
                    let cost = space.cost(&pair);
                    refused.extend(
                        refusal(&world, &pair, cost, &pipeline).map(|why| format!("{pair:?}: {why}")),
                    );
                }
            }
        }
        let share = f64::from(accepted) / f64::from(drawn);
        let what = format!("{} {}", sample.family, sample.over);
        assert!(
            (sample.accepts[0]..=sample.accepts[1]).contains(&share),
            "{what}: a one-sided sample, {share}"
        );
        assert!(refused.is_empty(), "{what}: {} of {accepted} refused; {}", refused.len(), refused[0]);
        tried += drawn;
    }
    assert!(tried as usize >= thoroughly(100_000), "{tried} motions");
}

#[test]
fn a_batch_of_any_kind_of_question_is_given_up_as_soon_as_its_time_is_over() {
    let mut stopped = [0; 4];
    for world in worlds() {
        let at = vec![0.25; Space::new(&world, false).width()];
        let turn = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let pose = Pose { position: vec![0.4, 0.1, 0.5], rotation: Some(turn) };
        let batches = [
            Ask { valid: Some(vec![at.clone(); 1000]), ..Ask::default() },
            Ask { motion: Some(vec![[at.clone(), at.clone()]; 1000]), ..Ask::default() },
            Ask { fk: Some(vec![at; 1000]), ..Ask::default() },
            Ask { ik: Some(vec![pose; 1000]), ..Ask::default() },
        ];
        for (kind, batch) in batches.iter().enumerate() {
            let looks = Cell::new(0);
            let goes_on = || looks.replace(looks.get() + 1) < 2;
            match Space::new(&world, false).answer_while(batch, &goes_on) {
                Err(Unanswered::Stopped) => stopped[kind] += 1,
                // A world without an arm has no postures.
                Err(Unanswered::Refused(_)) if kind > 1 => continue,
                other => panic!("{batch:?}: {other:?}"),
            }
            assert_eq!(looks.get(), 3, "looks at the clock");
        }
    }
    assert!(stopped.iter().all(|worlds| *worlds > 0), "{stopped:?}");
}
