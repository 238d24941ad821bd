//! A planar arm among obstacles, its tip on a lattice; start and goal are written, or drawn with each instance.

use super::ends::{Ends, PlaneEnd, is_within};
use super::{Entry, Family, Query};
use crate::StudyError;
use crate::preprocessing::Preprocessing;
use crate::preprocessing::workspace_map::{self, ShapeSetting};
use crate::verification::ARM_COLUMNS;
use base::grid::CornerRule;
use base::seed::Stream;
use base::settings::{Accepted, Faults, Settings, SettingsError};
use engine::geometry::planar::Touch;
use engine::kinematics::FARTHEST_CM;
use engine::kinematics::planar_2r::{ElbowRule, Planar2r};
use engine::planner::Invalid;
use engine::space::{ArmRules, ArmWorld, HopRule, Obstacle, TipLattice, WorldKind};
use rand::RngExt as _;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::num::NonZeroU32;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "arm_workspace",
    about: "a planar arm among obstacles, its tip on a lattice; start and goal are written, or drawn with each instance",
    instances: "problems",
    revision: 1,
    is_drawn: false,
    preprocessing: workspace_map::ENTRY.name,
    columns: ARM_COLUMNS,
    settings: Accepted::shape::<ArmWorkspace>(),
    example: r#"
links_cm = [30, 20]
x_cm = [-50, 50]
y_cm = [0, 50]
step_cm = 1
inner_radius_cm = 20
elbow = "negative_theta2"
touching = "collides"
hop_check = "end_points"
corner_rule = "allow"
obstacle_diameter_cm = 10
obstacle_shapes = ["circle"]
obstacles_cm = []
start_cm = [49, 3]
goal_cm = [0, 45]
"#,
    build: |settings, _inputs| {
        let read: ArmWorkspace = settings.read()?;
        let posed = read.posed(settings)?;
        Ok::<Box<dyn Family>, StudyError>(Box::new(posed))
    },
};

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct ArmWorkspace {
    /// The lengths of the two links.
    #[schemars(inner(range(max = FARTHEST_CM)))]
    links_cm: [f64; 2],
    /// The least and the greatest x of the lattice.
    x_cm: [f64; 2],
    /// The least and the greatest y of the lattice.
    y_cm: [f64; 2],
    /// The side of a lattice cell.
    step_cm: f64,
    /// How far the tip must stay from the base.
    #[schemars(range(min = 0, max = FARTHEST_CM))]
    inner_radius_cm: f64,
    /// How far joint 2 turns to either side; without stops if absent.
    #[schemars(range(max = 180), extend("exclusiveMinimum" = 0))]
    theta2_limit_deg: Option<f64>,
    /// On which side the elbow is.
    elbow: ElbowRule,
    /// Whether touching an obstacle counts as a collision.
    touching: Touch,
    /// How the move between neighbouring cells is checked.
    hop_check: HopRule,
    /// When a diagonal move past blocked cells is allowed.
    corner_rule: CornerRule,
    /// The diameter of every obstacle.
    #[schemars(range(max = FARTHEST_CM))]
    obstacle_diameter_cm: f64,
    /// One shape for all obstacles, or one for each.
    obstacle_shapes: Vec<ShapeSetting>,
    /// Shapes that the obstacles take in turn, in place of `obstacle_shapes`: for options of problems with more obstacles and
    /// with fewer.
    #[serde(default)]
    shapes_in_turn: Vec<ShapeSetting>,
    /// x and y of the middle of each obstacle.
    obstacles_cm: Vec<[f64; 2]>,
    /// x and y of the start; `drawn` with each instance among free points; or limits within which it is drawn, as
    /// in `{ x = [0, 9], y = 3 }`. Absent, as the goal, where the study looks for both.
    start_cm: Option<PlaneEnd<f64>>,
    /// The goal, written or drawn as a start is.
    goal_cm: Option<PlaneEnd<f64>>,
    /// How many queries an instance has, each with ends of its own; 1 if absent.
    #[schemars(range(max = 10_000))]
    queries: Option<NonZeroU32>,
    /// Which of the two ends a search begins at.
    #[serde(default)]
    direction: Direction,
    /// What is made of a start or goal that is not free.
    #[serde(default)]
    blocked_ends: BlockedEnds,
}

/// What is made of a start or goal that is not free.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum BlockedEnds {
    /// The study is wrong.
    #[default]
    Refused,
    /// The problem cannot be posed under this interpretation: ends that one interpretation leaves free another may block.
    InvalidProblem,
}

/// Which way a path is searched.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum Direction {
    /// From the start to the goal.
    #[default]
    StartToGoal,
    /// From the goal to the start.
    GoalToStart,
}

impl ArmWorkspace {
    fn posed(&self, settings: &Settings) -> Result<Posed, SettingsError> {
        let mut faults = Faults::default();
        let arm = Planar2r::new(self.links_cm[0], self.links_cm[1])
            .map_err(|error| settings.error_at("links_cm", format!("links_cm: {error}")));
        let lattice = TipLattice::new(self.x_cm, self.y_cm, self.step_cm)
            .map_err(|(key, message)| settings.error_at(key, message));
        let arm = faults.keep(arm);
        let lattice = faults.keep(lattice);
        let ends = faults.keep(self.ends(settings));
        let obstacles =
            faults.keep(self.obstacles().map_err(|(key, message)| settings.error_at(&key, message)));
        let posed = arm.zip(lattice).zip(ends).zip(obstacles);
        let (((arm, lattice), ends), obstacles) = faults.or(posed)?;
        let q2_limit_rad = self.theta2_limit_deg.map_or(f64::INFINITY, f64::to_radians);
        let rules = ArmRules {
            arm,
            q2_limit_rad,
            elbow: self.elbow,
            lattice,
            inner_radius_cm: self.inner_radius_cm,
            touch: self.touching,
            corner_rule: self.corner_rule,
            hop: self.hop_check,
        };
        let world = ArmWorld::new(rules, obstacles.clone());
        let blocked = match (self.check_ends(&world, settings), self.blocked_ends) {
            (Err(error), BlockedEnds::Refused) => return Err(error),
            (found, _) => found.err().map(|error| Invalid(error.to_string())),
        };
        let goal_cm = match self.goal_cm {
            Some(PlaneEnd::Written(goal)) => Some(goal),
            _ => None,
        };
        Ok(Posed { rules, obstacles, ends, goal_cm, blocked })
    }

    /// The queries from the start to the goal; `None` where the study looks for both.
    fn ends(&self, settings: &Settings) -> Result<Option<Ends>, SettingsError> {
        match (&self.start_cm, &self.goal_cm) {
            (Some(start), Some(goal)) => {
                let whole = [self.x_cm, self.y_cm];
                let mut faults = Faults::default();
                let start = faults.keep(start.place(settings, "start_cm", whole));
                let goal = faults.keep(goal.place(settings, "goal_cm", whole));
                let (start, goal) = faults.or(start.zip(goal))?;
                let [start, goal] = match self.direction {
                    Direction::StartToGoal => [start, goal],
                    Direction::GoalToStart => [goal, start],
                };
                Ends::new(start, goal, self.queries, |key, message| {
                    settings.error_at(if key == "goal" { "goal_cm" } else { key }, message)
                })
                .map(Some)
            }
            (None, None) => Ok(None),
            (start, _) => {
                let (given, missing) =
                    if start.is_some() { ("start_cm", "goal_cm") } else { ("goal_cm", "start_cm") };
                let message =
                    format!("{missing} is missing; start and goal are given together or not at all");
                Err(settings.error_at(given, message))
            }
        }
    }

    fn check_ends(&self, world: &ArmWorld, settings: &Settings) -> Result<(), SettingsError> {
        let mut faults = Faults::default();
        for (what, key, end) in [("start", "start_cm", &self.start_cm), ("goal", "goal_cm", &self.goal_cm)] {
            if let Some(PlaneEnd::Written(point)) = end {
                let free = world.free_cell(what, point);
                faults.keep(free.map_err(|message| settings.error_at(key, message)));
            }
        }
        faults.done()
    }

    /// The obstacles, or the key at fault and what is wrong.
    fn obstacles(&self) -> Result<Vec<Obstacle>, (String, String)> {
        let count = self.obstacles_cm.len();
        let shapes = &self.obstacle_shapes;
        if shapes.len() != 1 && shapes.len() != count {
            let message = format!(
                "obstacle_shapes names {} shapes for {count} obstacles; one for all or one for each is accepted",
                shapes.len()
            );
            return Err(("obstacle_shapes".to_owned(), message));
        }
        let in_turn = &self.shapes_in_turn;
        let shape = |index: usize| match in_turn.len() {
            0 => &shapes[index.min(shapes.len() - 1)],
            turn => &in_turn[index % turn],
        };
        let shaped = self.obstacles_cm.iter().enumerate().map(|(index, center)| {
            shape(index)
                .obstacle(*center, self.obstacle_diameter_cm)
                .map_err(|e| (format!("obstacles_cm.{index}"), format!("obstacle {}: {e}", index + 1)))
        });
        shaped.collect()
    }
}

struct Posed {
    rules: ArmRules,
    obstacles: Vec<Obstacle>,
    /// `None` where the study looks for start and goal.
    ends: Option<Ends>,
    /// The goal, if it is written.
    goal_cm: Option<[f64; 2]>,
    /// Why the problem cannot be posed.
    blocked: Option<Invalid>,
}

impl Posed {
    fn arm_world(&self) -> ArmWorld {
        ArmWorld::new(self.rules, self.obstacles.clone())
    }

    fn drawn(&self, world: &ArmWorld, seed: u64) -> Result<Vec<Query>, Invalid> {
        let draw = |stream: &mut Stream, limits: &[[f64; 2]]| {
            let cell = stream.random_range(0..world.grid().cell_count());
            let point = world.rules().lattice.point(cell);
            let point = vec![point.x, point.y];
            (is_within(&point, limits) && world.grid().is_free(cell)).then_some(point)
        };
        self.ends.as_ref().map_or(Ok(Vec::new()), |ends| ends.drawn(seed, draw))
    }
}

impl Family for Posed {
    fn world(&self) -> WorldKind {
        WorldKind::Arm
    }

    fn prepare(&self, seed: u64) -> Result<Preprocessing, Invalid> {
        if let Some(blocked) = &self.blocked {
            return Err(blocked.clone());
        }
        let world = self.arm_world();
        self.drawn(&world, seed)?;
        Ok(workspace_map::prepare(world, self.goal_cm))
    }

    fn queries(&self) -> &[Query] {
        self.ends.as_ref().map_or(&[], Ends::queries)
    }

    fn queries_for(&self, seed: u64) -> Vec<Query> {
        let drawn = self.draws_ends().then(|| self.drawn(&self.arm_world(), seed).ok()).flatten();
        drawn.unwrap_or_else(|| self.queries().to_vec())
    }

    fn draws_ends(&self) -> bool {
        self.ends.as_ref().is_some_and(Ends::are_drawn)
    }

    fn cells(&self) -> u64 {
        self.rules.lattice.size().into_iter().map(u64::from).product()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Inputs;
    use toml::Table;

    const PLAIN: &str = "links_cm = [30, 20]\nx_cm = [-50, 50]\ny_cm = [0, 50]\nstep_cm = 1\ninner_radius_cm = 20\n\
        elbow = 'negative_theta2'\ntouching = 'collides'\nhop_check = 'end_points'\ncorner_rule = 'allow'\n\
        obstacle_diameter_cm = 10\nobstacle_shapes = ['circle']\nobstacles_cm = [[35, 18], [7, 35]]\n\
        start_cm = [49, 3]\ngoal_cm = [0, 45]\n";

    fn build(changes: &str) -> Result<Box<dyn Family>, String> {
        let plain = Settings::composed("plain", PLAIN.parse::<Table>().unwrap());
        let changed = plain.overlaid(&changes.parse::<Table>().unwrap(), "a change");
        (ENTRY.build)(&changed, &Inputs::default()).map_err(|e| e.to_string())
    }

    #[test]
    fn wrong_input_says_what_is_wrong_and_what_is_accepted() {
        assert!(build("").is_ok());
        for (changes, parts) in [
            ("start_cm = [35, 18]", ["the start [35.0, 18.0]", "lies in obstacle 1"]),
            ("goal_cm = [8, 36]", ["the goal [8.0, 36.0]", "lies in obstacle 2"]),
            (
                "goal_cm = [50, 50]",
                ["the goal", "is 70.7107 cm from the base; the arm may stand from 20 to 50 cm"],
            ),
            ("goal_cm = [0.5, 45]", ["the goal", "in steps of 1 cm"]),
            ("links_cm = [30, 0]", ["links_cm", "link 2 is 0 long; a link must be longer than 0"]),
            ("step_cm = 3", ["step_cm is 3", "does not divide x_cm of 100 cm"]),
            ("step_cm = 0", ["step_cm is 0", "a step above 0 is accepted"]),
            ("inner_radius_cm = -1", ["`inner_radius_cm` is -1", "a number from 0 to"]),
            ("obstacle_diameter_cm = 0", ["obstacle 1", "must be greater than 0"]),
            (
                "obstacle_shapes = ['circle', 'square', 'square']",
                ["3 shapes for 2 obstacles", "one for all or one"],
            ),
            ("obstacle_shapes = []", ["0 shapes for 2 obstacles", "one for all or one"]),
            ("obstacle_shapes = ['star']", ["star", "triangle"]),
            ("elbows = 'higher'", ["elbows", "elbow"]),
            ("theta2_limit_deg = 0", ["`theta2_limit_deg` is 0", "above 0 to 180"]),
            ("theta2_limit_deg = 30", ["the goal [0.0, 45.0]", "the arm may stand from 48.36"]),
            (
                "direction = 'goal_to_start'\ngoal_cm = [8, 36]",
                ["the goal [8.0, 36.0]", "lies in obstacle 2"],
            ),
        ] {
            let refused = build(changes).err().unwrap_or_else(|| panic!("{changes} was accepted"));
            assert!(parts.iter().all(|part| refused.contains(part)), "{changes}: {refused}");
        }
    }

    #[test]
    fn a_blocked_end_is_a_problem_that_cannot_be_posed_where_the_study_says_so() {
        let blocked = build("start_cm = [35, 18]\nblocked_ends = 'invalid_problem'").unwrap();
        let Err(Invalid(reason)) = blocked.prepare(1) else { panic!("a start within an obstacle was posed") };
        assert!(reason.contains("the start [35.0, 18.0] lies in obstacle 1"), "{reason}");
        assert_eq!(blocked.queries().len(), 1, "its trials are rows all the same");
        assert!(build("blocked_ends = 'invalid_problem'").unwrap().prepare(1).is_ok());
    }

    #[test]
    fn obstacles_take_shapes_in_turn() {
        let spots = |changes: &str| {
            let world = build(changes).unwrap().prepare(1).unwrap().world;
            let arm = world.as_arm().unwrap();
            [[30.0, 18.0], [7.0, 30.0]].map(|point| arm.free_cell("point", &point).is_err())
        };
        // The rim of a circle touches what a triangle with its corner on top leaves free, left of it and below.
        assert_eq!(spots("shapes_in_turn = ['circle', 'triangle', 'hexagon']"), [true, false]);
        assert_eq!(spots("shapes_in_turn = ['triangle', 'circle']"), [false, true]);
        assert_eq!(spots("shapes_in_turn = ['circle']"), spots("obstacle_shapes = ['circle']"));
    }

    #[test]
    fn an_end_alone_is_refused_and_none_poses_no_query() {
        let without = |keys: &[&str]| {
            let mut table = PLAIN.parse::<Table>().unwrap();
            for key in keys {
                table.remove(*key);
            }
            (ENTRY.build)(&Settings::composed("plain", table), &Inputs::default())
        };
        assert!(without(&["goal_cm"]).err().unwrap().to_string().contains("goal_cm is missing"));
        assert!(without(&["start_cm", "goal_cm"]).unwrap().queries().is_empty());
    }
}
