//! One scene of polyhedra from a file, with written queries, or queries drawn from balls around them; with an arm,
//! or without; a file with drawn numbers gives a scene with each instance.

use super::drawn_scene::DrawnScene;
use super::input::{input, load_robot, load_scene};
use super::{ArmPlacement, Entry, Family, Query};
use crate::preprocessing::{Preprocessing, polyhedra};
use crate::verification::CARRIED_COLUMNS;
use crate::{Inputs, StudyError};
use base::seed;
use base::settings::{Accepted, AnyTable, Faults, Settings, SettingsError};
use base::text::listed;
use engine::geometry::{Capsule, Convex, Segment, Vec3, distance_segment_convex};
use engine::kinematics::Robot;
use engine::planner::Invalid;
use engine::space::polyhedra::{CarriedArm, DOWN, PolyhedraError, Scene, parse_scene};
use engine::space::roadmap::joints;
use engine::space::{PolyhedraWorld, WorldKind};
use rand::RngExt as _;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use toml::Table;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "polyhedra_scene",
    about: "one scene of polyhedra from a file, with written queries or ones drawn around them; an arm may carry the tip",
    instances: "environments",
    revision: 3,
    is_drawn: false,
    preprocessing: polyhedra::ENTRY.name,
    columns: CARRIED_COLUMNS,
    settings: Accepted::shape::<SceneSettings>(),
    example: r#"
scene = "data/scenes/tang_c1.toml"
step_cm = 1
growth_cm = 7
robot = "data/robots/aubo_i10.toml"
body = "paper"
scatter_cm = 5
queries = [{ start = [70, -46, 36], goal = [70, 41, 51] }]
"#,
    build: |settings, inputs| Ok::<Box<dyn Family>, StudyError>(Box::new(posed(settings, inputs)?)),
};

const MM_PER_CM: f64 = 10.0;

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct SceneSettings {
    /// The scene file; with a table `[drawn]`, a scene is drawn with each instance, and the arm can stand at its start and goal.
    scene: String,
    /// Values that replace those of the scene file. Elements of lists are named by their number from 0 or by their `name`.
    #[schemars(with = "Option<AnyTable>")]
    scene_with: Option<Table>,
    /// The side of a lattice cell.
    step_cm: f64,
    /// By how much the tip keeps away from the obstacles.
    growth_cm: f64,
    /// The queries: start and goal each.
    queries: Vec<QuerySettings>,
    /// Each draw's start and goal lie in balls of this radius about the written ones.
    #[schemars(extend("exclusiveMinimum" = 0))]
    scatter_cm: Option<f64>,
    /// Which drawn scenes are kept, by the straight lines from starts to goals.
    #[serde(default)]
    line: Line,
    /// Whether a point on an obstacle's face is blocked.
    #[serde(default)]
    contact: Contact,
    /// The robot file of the arm whose tip the point is; a point alone if absent.
    robot: Option<String>,
    /// What is laid over the robot file.
    #[schemars(with = "Option<AnyTable>")]
    robot_with: Option<Table>,
    /// The body that stands for the robot's links.
    body: Option<String>,
}

/// Which environments are kept, by the straight line from start to goal.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(super) enum Line {
    /// All.
    #[default]
    Any,
    /// Those in which an obstacle is in its way; the others are drawn again, query and obstacles alike.
    Blocked,
}

impl Line {
    /// Whether an environment with `query` and these obstacles is kept.
    pub(super) fn keeps(self, query: &Query, obstacles: &[Convex]) -> bool {
        let way = Segment::new(point(&query.start), point(&query.goal));
        self == Self::Any || obstacles.iter().any(|body| distance_segment_convex(&way, body) == 0.0)
    }
}

pub(super) fn point(end: &[f64]) -> Vec3 {
    Vec3::new(end[0], end[1], end[2])
}

/// What a point on an obstacle's face is: there T of eq. 2 in Tang, Zhou & Xu (2023) is 0.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(super) enum Contact {
    /// In contact, so not free.
    #[default]
    Blocked,
    /// Not in contact.
    Free,
}

impl Contact {
    /// `world` with points on faces as this says.
    pub(super) fn applied(self, world: PolyhedraWorld) -> PolyhedraWorld {
        match self {
            Self::Blocked => world,
            Self::Free => world.touched_freely(),
        }
    }
}

/// A query as it is written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct QuerySettings {
    /// Its name; empty if it is the only one.
    #[serde(default)]
    name: String,
    /// x, y and z of the start, in centimetres.
    start: [f64; 3],
    /// x, y and z of the goal, in centimetres.
    goal: [f64; 3],
}

impl QuerySettings {
    pub(super) fn query(&self) -> Query {
        Query { name: self.name.clone(), start: self.start.to_vec(), goal: self.goal.to_vec() }
    }
}

struct Posed {
    settings: Settings,
    read: SceneSettings,
    robot: Option<Robot>,
    /// The world; that in the middle of its bounds if the scene is drawn.
    world: PolyhedraWorld,
    /// How the scene is drawn, if it is.
    drawn: Option<DrawnScene>,
    queries: Vec<Query>,
    inputs: Vec<PathBuf>,
}

fn posed(settings: &Settings, inputs: &Inputs) -> Result<Posed, StudyError> {
    let read: SceneSettings = settings.read()?;
    let mut faults = Faults::default();
    let scene = faults.keep(input(settings, inputs, "scene", &read.scene, |file| {
        load_scene((settings, inputs), file, read.scene_with.as_ref(), |document| {
            let drawn = DrawnScene::read(document)?;
            let middle = drawn.as_ref().map(DrawnScene::middle);
            Ok((parse_scene(middle.as_ref().unwrap_or(document))?, drawn))
        })
    }));
    let robot = faults.keep(read.robot(settings, inputs)).flatten();
    let (file, (scene, drawn)) = faults.or(scene)?;
    let (robot_file, robot) = robot.unzip();
    if read.line == Line::Blocked && drawn.is_none() {
        let message = "line keeps drawn scenes; a scene with a table `[drawn]` is accepted";
        return Err(settings.error_at("line", message).into());
    }
    let world = read.world(settings, scene, robot.as_ref())?;
    let queries: Vec<Query> = read.queries.iter().map(QuerySettings::query).collect();
    // In a drawn scene every instance sees to it.
    if drawn.is_none() {
        check(settings, &world, &queries)?;
    }
    let inputs = std::iter::once(file).chain(robot_file).collect();
    Ok(Posed { settings: settings.clone(), read, robot, world, drawn, queries, inputs })
}

impl SceneSettings {
    /// The world of `scene`; with an arm, if `robot` is one.
    fn world(
        &self,
        settings: &Settings,
        scene: Scene,
        robot: Option<&Robot>,
    ) -> Result<PolyhedraWorld, SettingsError> {
        let domain = scene.domain;
        let world = |bodies| {
            let made = PolyhedraWorld::new(bodies, domain, self.step_cm, self.growth_cm);
            made.map(|world| self.contact.applied(world)).map_err(|error| {
                let key = match error {
                    PolyhedraError::Step { .. } => "step_cm",
                    PolyhedraError::Growth { .. } => "growth_cm",
                    _ => "scene",
                };
                settings.error_at(key, format!("{}: {error}", self.scene))
            })
        };
        let (Some(robot), Some(body)) = (robot, &self.body) else { return world(scene.bodies) };
        let (bodies, support) = scene
            .with_arm()
            .map_err(|message| settings.error_at("scene", format!("{}: {message}", self.scene)))?;
        let arm =
            CarriedArm::new(robot, body, &support).map_err(|message| settings.error_at("body", message))?;
        Ok(world(bodies)?.with_arm(arm))
    }

    /// The robot, if there is one, with the file that it was read from.
    fn robot(&self, settings: &Settings, inputs: &Inputs) -> Result<Option<(PathBuf, Robot)>, SettingsError> {
        let robot = match (&self.robot, &self.body) {
            (Some(robot), Some(_)) => robot,
            (None, None) => return Ok(None),
            (robot, _) => {
                let given = if robot.is_some() { "robot" } else { "body" };
                return Err(settings.error_at(given, "robot and body are given together or not at all"));
            }
        };
        input(settings, inputs, "robot", robot, |file| {
            load_robot((settings, inputs), file, self.robot_with.as_ref(), None)
        })
        .map(Some)
    }
}

/// Refuses ends that are not free or that the arm cannot reach, and a list without queries.
pub(super) fn check(
    settings: &Settings,
    world: &PolyhedraWorld,
    queries: &[Query],
) -> Result<(), SettingsError> {
    if queries.is_empty() {
        return Err(settings.error_at("queries", "queries is empty; at least one start and goal is needed"));
    }
    let stands = |what: &str, end: &[f64]| {
        let at = world.free_point(what, end)?;
        let missed =
            || format!("the arm cannot reach the {what} {} with its tool pointing down", listed(end));
        if is_reachable(world, &at) { Ok(()) } else { Err(missed()) }
    };
    let mut faults = Faults::default();
    for (index, query) in queries.iter().enumerate() {
        for (what, end) in [("start", &query.start), ("goal", &query.goal)] {
            let key = format!("queries.{index}.{what}");
            faults.keep(stands(what, end).map_err(|message| settings.error_at(&key, message)));
        }
    }
    faults.done()
}

/// Whether the arm, if there is one, reaches `tip` with its tool down.
fn is_reachable(world: &PolyhedraWorld, tip: &Vec3) -> bool {
    world.arm().is_none_or(|arm| {
        let found = arm.arm().inverse(&CarriedArm::target(tip, &DOWN), &[0.0; 6]);
        found.iter().next().is_some()
    })
}

/// How far the arm keeps from everything at the ends of a drawn query.
const CLEAR_CM: f64 = 0.1;

/// Whether the arm, if there is one, stands clear of everything with `tip` and its tool down.
fn can_stand(world: &PolyhedraWorld, tip: &Vec3) -> bool {
    world.arm().is_none_or(|arm| {
        let found = arm.arm().inverse(&CarriedArm::target(tip, &DOWN), &[0.0; 6]);
        let clearance = |q| arm.clearance(q, world.bodies(), 2.0 * CLEAR_CM, false);
        found.iter().any(|(_, q)| clearance(q) > CLEAR_CM)
    })
}

impl Posed {
    /// The queries in `world` of the instance that belongs to `seed`; the written end stands where a thousand draws give none.
    fn scattered(&self, world: &PolyhedraWorld, seed: u64) -> Vec<Query> {
        let Some(radius) = self.read.scatter_cm else { return self.queries.clone() };
        let mut stream = seed::stream(seed);
        let mut near = |center: &[f64]| {
            let found = (0..1000).find_map(|_| near(world, &mut stream, center, radius));
            found.unwrap_or_else(|| center.to_vec())
        };
        let mut drawn = |query: &Query| Query {
            name: query.name.clone(),
            start: near(&query.start),
            goal: near(&query.goal),
        };
        self.queries.iter().map(&mut drawn).collect()
    }

    /// The world of the instance that belongs to `seed`, and its queries.
    fn instance(&self, seed: u64) -> Result<(PolyhedraWorld, Vec<Query>), Invalid> {
        let Some(drawn) = &self.drawn else {
            return Ok((self.world.clone(), self.scattered(&self.world, seed)));
        };
        let instance = drawn.draw(seed, |document| {
            let scene = parse_scene(document).ok()?;
            let world = self.read.world(&self.settings, scene, self.robot.as_ref()).ok()?;
            let queries = self.scattered(&world, seed);
            let stands =
                |end: &[f64]| world.free_point("end", end).is_ok_and(|point| can_stand(&world, &point));
            let is_kept = |query: &Query| {
                query.ends().into_iter().all(stands) && self.read.line.keeps(query, world.obstacles())
            };
            queries.iter().all(is_kept).then_some((world, queries))
        });
        instance.ok_or_else(|| Invalid("the arm stands at every start and goal of no drawn scene".to_owned()))
    }
}

/// A point in the ball about `center`, if the one that is drawn is free and reached.
fn near(world: &PolyhedraWorld, stream: &mut seed::Stream, center: &[f64], radius: f64) -> Option<Vec<f64>> {
    let offset = Vec3::from_fn(|_, _| stream.random_range(-radius..=radius));
    let point = point(center) + offset;
    let stands = offset.norm() <= radius
        && world.free_point("point", point.as_slice()).is_ok()
        && is_reachable(world, &point);
    stands.then(|| point.as_slice().to_vec())
}

impl Family for Posed {
    fn world(&self) -> WorldKind {
        if self.world.arm().is_some() { WorldKind::ArmAmongPolyhedra } else { WorldKind::Polyhedra }
    }

    fn prepare(&self, seed: u64) -> Result<Preprocessing, Invalid> {
        let world = match self.drawn {
            None => self.world.clone(),
            Some(_) => self.instance(seed)?.0,
        };
        Ok(polyhedra::prepare(world))
    }

    fn queries(&self) -> &[Query] {
        &self.queries
    }

    fn queries_for(&self, seed: u64) -> Vec<Query> {
        // A scene that cannot be drawn is refused by `prepare`, with the reason; its queries are never planned.
        self.instance(seed).map_or_else(|_| self.queries.clone(), |(_, queries)| queries)
    }

    fn draws_ends(&self) -> bool {
        self.drawn.is_some()
    }

    fn cells(&self) -> u64 {
        self.world.node_count() as u64
    }

    fn stance(&self, q_rad: &[f64]) -> Option<ArmPlacement> {
        let arm = self.world.arm().filter(|_| self.drawn.is_none())?;
        let q = joints(q_rad)?;
        let mm = |point: &Vec3| -> [f64; 3] { (point * MM_PER_CM).into() };
        let capsule = |rod: &Capsule| {
            let ([ax, ay, az], [bx, by, bz]) = (mm(&rod.segment.a), mm(&rod.segment.b));
            [ax, ay, az, bx, by, bz, rod.radius * MM_PER_CM]
        };
        let capsules_mm = arm.rods(&q).iter().map(capsule).collect();
        let domain = self.world.domain();
        let clearance_cm = arm.clearance(&q, self.world.bodies(), (domain.max - domain.min).norm(), false);
        let clearance_mm = Some(clearance_cm * MM_PER_CM);
        Some(ArmPlacement { capsules_mm, tip_mm: mm(&arm.tip(&q)), clearance_mm })
    }

    fn inputs(&self) -> &[PathBuf] {
        &self.inputs
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use toml::Table;

    const PLAIN: &str = "scene = 'data/scenes/tang_c1.toml'\nstep_cm = 1\ngrowth_cm = 7\n\
        robot = 'data/robots/aubo_i10.toml'\nbody = 'paper'\nscatter_cm = 5\n\
        queries = [{ start = [70, -46, 36], goal = [70, 41, 51] }]\n";

    /// Start and goal of the study of drawn scenes, in the middle of their balls.
    const DRAWN_ENDS: &str = "queries = [{ start = [61, -44, 40], goal = [61, 42, 46] }]";

    fn build(changes: &str, without: &[&str]) -> Result<Box<dyn Family>, String> {
        let mut table = PLAIN.parse::<Table>().unwrap();
        table.retain(|key, _| !without.contains(&key));
        table.extend(changes.parse::<Table>().unwrap());
        let inputs = Inputs::below(vec![PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))]);
        (ENTRY.build)(&Settings::composed("plain", table), &inputs).map_err(|e| e.to_string())
    }

    /// The family of drawn scenes, with this `line`.
    fn drawn(line: &str) -> Box<dyn Family> {
        let scene = "scene = 'data/scenes/tang_drawn.toml'\nscatter_cm = 10";
        build(&format!("{scene}\nline = '{line}'\n{DRAWN_ENDS}"), &[]).unwrap()
    }

    #[test]
    fn wrong_input_says_what_is_wrong_and_what_is_accepted() {
        assert!(build("", &[]).is_ok());
        let query = |start: &str, goal: &str| format!("queries = [{{ start = {start}, goal = {goal} }}]");
        let (start, goal) = ("[70, -46, 36]", "[70, 41, 51]");
        for (changes, parts) in [
            (
                query("[70, 15, 48]", goal),
                ["the start [70.0, 15.0, 48.0]", "is inside obstacle 1 grown by 7 cm"],
            ),
            (
                query(start, "[82, 24, 61]"),
                ["the goal [82.0, 24.0, 61.0]", "is inside obstacle 1 grown by 7 cm"],
            ),
            (query(start, "[70, 41, 999]"), ["the goal", "is outside the domain; it goes from"]),
            (
                query(start, "[90, 65, 105]"),
                ["the arm cannot reach the goal [90.0, 65.0, 105.0]", "with its tool pointing down"],
            ),
            (query("[70, -46]", goal), ["`start` is an array of 2", "an array of 3"]),
            ("queries = []".to_owned(), ["queries is empty", "at least one start and goal is needed"]),
            ("step_cm = 999".to_owned(), ["tang_c1.toml: step is 999", "at most the domain's shortest side"]),
            ("step_cm = 0".to_owned(), ["step is 0", "more than 0"]),
            ("growth_cm = -1".to_owned(), ["grow by -1", "0 or more is accepted"]),
            (
                "line = 'blocked'".to_owned(),
                ["line keeps drawn scenes", "a scene with a table `[drawn]` is accepted"],
            ),
            ("scatter_cm = 0".to_owned(), ["`scatter_cm` is 0", "a number above 0 is accepted"]),
            ("body = 'bones'".to_owned(), ["no body `bones`", "it has paper, mesh"]),
            ("scene = 'data/scenes/none.toml'".to_owned(), ["`data/scenes/none.toml`", "does not exist"]),
            ("robot = 'data/robots/none.toml'".to_owned(), ["`data/robots/none.toml`", "does not exist"]),
            (
                "scene = 'data/scenes/tang_e1.toml'".to_owned(),
                [
                    "data/scenes/tang_e1.toml: a scene of an arm says where its base stands",
                    "a table `[support]`",
                ],
            ),
            ("steps = 1".to_owned(), ["steps", "step_cm"]),
        ] {
            let refused = build(&changes, &[]).err().unwrap_or_else(|| panic!("{changes} was accepted"));
            assert!(parts.iter().all(|part| refused.contains(part)), "{changes}: {refused}");
        }
    }

    #[test]
    fn robot_and_body_come_together_or_not_at_all() {
        assert_eq!(build("", &["robot", "body"]).unwrap().world(), WorldKind::Polyhedra);
        assert_eq!(build("", &[]).unwrap().world(), WorldKind::ArmAmongPolyhedra);
        for alone in ["robot", "body"] {
            let refused = build("", &[alone]).err().unwrap();
            assert!(refused.contains("robot and body are given together or not at all"), "{refused}");
        }
    }

    #[test]
    fn a_drawn_scene_changes_with_the_seed_alone_and_leaves_its_ends_free() {
        let (any, blocked) = (drawn("any"), drawn("blocked"));
        let world = |family: &dyn Family, seed: u64| match family.prepare(seed).unwrap().world {
            engine::space::World::Polyhedra(world) => *world,
            _ => panic!("seed {seed}"),
        };
        let mut free_lines = 0;
        for seed in 0..20 {
            for family in [&any, &blocked] {
                let query = &family.queries_for(seed)[0];
                let world = world(family.as_ref(), seed);
                assert_eq!(*query, family.queries_for(seed)[0], "seed {seed}");
                assert!(
                    query.ends().into_iter().all(|end| world.free_point("end", end).is_ok()),
                    "seed {seed}"
                );
            }
            let corner = |seed| world(any.as_ref(), seed).bodies()[0].vertices()[0];
            assert!(corner(seed) == corner(seed) && corner(seed) != corner(seed + 1), "seed {seed}");
            let line = |family: &dyn Family| {
                Line::Blocked.keeps(&family.queries_for(seed)[0], world(family, seed).obstacles())
            };
            assert!(line(blocked.as_ref()), "seed {seed}");
            free_lines += usize::from(!line(any.as_ref()));
        }
        assert!(free_lines > 0, "no line is free");
    }

    #[test]
    fn the_scenes_that_the_cross_check_reads_are_those_that_the_study_draws() {
        let vertices = |bodies: &[engine::geometry::Convex]| -> Vec<Vec3> {
            bodies.iter().flat_map(|body| body.vertices().to_vec()).collect()
        };
        // The seeds of number 7 of the group `drawn` and number 4 of `drawn, blocked` of the study `drawn_scenes`.
        for (file, line, seed) in [
            ("tang_drawn_7", "any", 4_165_450_341_848_544_698),
            ("tang_drawn_blocked_4", "blocked", 1_618_639_161_523_250_425),
        ] {
            let engine::space::World::Polyhedra(world) = drawn(line).prepare(seed).unwrap().world else {
                panic!("{file}: no polyhedra");
            };
            let path = format!("{}/../../data/scenes/{file}.toml", env!("CARGO_MANIFEST_DIR"));
            let written = parse_scene(&base::settings::Document::open(path.as_ref()).unwrap()).unwrap();
            let (drawn, written) = (vertices(world.bodies()), vertices(&written.bodies));
            let is_same = drawn.len() == written.len()
                && drawn.iter().zip(&written).all(|(drawn, written)| (drawn - written).norm() < 1e-9);
            assert!(is_same, "{file}: the corners are {drawn:?}");
        }
    }

    #[test]
    fn scattered_ends_lie_in_their_balls_and_change_with_the_seed_alone() {
        let family = build("", &[]).unwrap();
        let mut all = std::collections::BTreeSet::new();
        for seed in 0..40 {
            let drawn = family.queries_for(seed);
            assert_eq!(drawn, family.queries_for(seed), "seed {seed}");
            for (end, center) in
                [(&drawn[0].start, [70.0, -46.0, 36.0]), (&drawn[0].goal, [70.0, 41.0, 51.0])]
            {
                let off = (0..3).map(|i| (end[i] - center[i]) * (end[i] - center[i])).sum::<f64>().sqrt();
                assert!(off <= 5.0 && off > 0.0, "seed {seed}: {off}");
            }
            all.insert(format!("{:?}", drawn[0].start));
        }
        assert_eq!(all.len(), 40);
    }
}
