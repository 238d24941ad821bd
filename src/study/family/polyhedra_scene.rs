//! One scene of polyhedra from a file, with written queries, or queries drawn from balls around them; with an arm,
//! or without.

use super::{Entry, Family, Query};
use crate::geometry::Vec3;
use crate::kinematics::Robot;
use crate::planner::Invalid;
use crate::seed;
use crate::settings::{Settings, SettingsError};
use crate::space::polyhedra::{CarriedArm, DOWN, read_scene};
use crate::space::{PolyhedraWorld, WorldKind};
use crate::study::judge::CARRIED_COLUMNS;
use crate::study::prepared::{Prepared, polyhedra};
use crate::study::{Inputs, StudyError};
use rand::RngExt as _;
use serde::Deserialize;
use std::path::PathBuf;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "polyhedra_scene",
    about: "one scene of polyhedra from a file, with written queries or ones drawn around them; an arm may carry the tip",
    revision: 1,
    prepared: polyhedra::ENTRY.name,
    columns: CARRIED_COLUMNS,
    build: |settings, inputs| Ok::<Box<dyn Family>, StudyError>(Box::new(posed(settings, inputs)?)),
};

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct SceneSettings {
    scene: String,
    step_cm: f64,
    /// By how much the tip keeps away from the obstacles.
    growth_cm: f64,
    queries: Vec<QuerySettings>,
    /// Each draw's start and goal lie in balls of this radius about the written ones.
    scatter_cm: Option<f64>,
    robot: Option<String>,
    /// The body that stands for the robot's links.
    body: Option<String>,
}

/// A query as it is written.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct QuerySettings {
    /// Its name; empty if it is the only one.
    #[serde(default)]
    name: String,
    start: [f64; 3],
    goal: [f64; 3],
}

impl QuerySettings {
    pub(super) fn query(&self) -> Query {
        Query { name: self.name.clone(), start: self.start.to_vec(), goal: self.goal.to_vec() }
    }
}

struct Posed {
    world: PolyhedraWorld,
    queries: Vec<Query>,
    scatter_cm: Option<f64>,
    inputs: Vec<PathBuf>,
}

fn posed(settings: &Settings, inputs: &Inputs) -> Result<Posed, StudyError> {
    let read: SceneSettings = settings.read()?;
    let refuse = |message: String| settings.error(message);
    let file = inputs.locate(&read.scene).map_err(refuse)?;
    let scene = read_scene(&file)?;
    let mut world = PolyhedraWorld::new(scene.bodies, scene.domain, read.step_cm, read.growth_cm)
        .map_err(|e| settings.error(format!("{}: {e}", read.scene)))?;
    let mut files = vec![file];
    match (&read.robot, &read.body) {
        (Some(robot), Some(body)) => {
            let file = inputs.locate(robot).map_err(refuse)?;
            let robot = Robot::load(&file).map_err(|e| settings.error(e.to_string()))?;
            world = world.with_arm(CarriedArm::new(&robot, body).map_err(refuse)?);
            files.push(file);
        }
        (None, None) => {}
        _ => return Err(settings.error("robot and body are given together or not at all").into()),
    }
    if let Some(radius) = read.scatter_cm
        && !(radius.is_finite() && radius > 0.0)
    {
        let message = format!("scatter_cm is {radius}; more than 0 is accepted");
        return Err(settings.error(message).into());
    }
    let queries: Vec<Query> = read.queries.iter().map(QuerySettings::query).collect();
    check(settings, &world, &queries)?;
    Ok(Posed { world, queries, scatter_cm: read.scatter_cm, inputs: files })
}

/// Refuses ends that are not free or that the arm cannot reach, and a list without queries.
pub(super) fn check(
    settings: &Settings,
    world: &PolyhedraWorld,
    queries: &[Query],
) -> Result<(), SettingsError> {
    if queries.is_empty() {
        return Err(settings.error("queries is empty; at least one start and goal is needed"));
    }
    for query in queries {
        for (what, end) in [("start", &query.start), ("goal", &query.goal)] {
            let at = world.free_point(what, end).map_err(|message| settings.error(message))?;
            if !is_reachable(world, &at) {
                let message = format!("the arm cannot reach the {what} {end:?} with its tool pointing down");
                return Err(settings.error(message));
            }
        }
    }
    Ok(())
}

/// Whether the arm, if there is one, reaches `tip` with its tool down.
fn is_reachable(world: &PolyhedraWorld, tip: &Vec3) -> bool {
    world.arm().is_none_or(|arm| {
        let found = arm.arm().inverse(&CarriedArm::target(tip, &DOWN), &[0.0; 6]);
        found.iter().next().is_some()
    })
}

impl Posed {
    /// A free and reachable point in the ball about `center`; the center itself if a thousand draws find none.
    fn near(&self, stream: &mut seed::Stream, center: &[f64], radius: f64) -> Vec<f64> {
        for _ in 0..1000 {
            let offset = Vec3::from_fn(|_, _| stream.random_range(-radius..=radius));
            let point = Vec3::new(center[0], center[1], center[2]) + offset;
            if offset.norm() <= radius
                && self.world.free_point("point", point.as_slice()).is_ok()
                && is_reachable(&self.world, &point)
            {
                return point.as_slice().to_vec();
            }
        }
        center.to_vec()
    }
}

impl Family for Posed {
    fn world(&self) -> WorldKind {
        if self.world.arm().is_some() { WorldKind::ArmAmongPolyhedra } else { WorldKind::Polyhedra }
    }

    fn prepare(&self, _seed: u64) -> Result<Prepared, Invalid> {
        Ok(polyhedra::prepare(self.world.clone()))
    }

    fn queries(&self) -> &[Query] {
        &self.queries
    }

    fn queries_for(&self, seed: u64) -> Vec<Query> {
        let Some(radius) = self.scatter_cm else { return self.queries.clone() };
        let mut stream = seed::stream(seed);
        let mut drawn = |query: &Query| Query {
            name: query.name.clone(),
            start: self.near(&mut stream, &query.start, radius),
            goal: self.near(&mut stream, &query.goal, radius),
        };
        self.queries.iter().map(&mut drawn).collect()
    }

    fn inputs(&self) -> &[PathBuf] {
        &self.inputs
    }
}
