//! Queries of an arm in its work cell, answered on roadmaps drawn from a seed.

mod groups;
pub(super) mod picture;

pub use groups::GROUPS_FILE;

use super::drawn_scene::DrawnScene;
use super::ends::{Ends, SpaceLimits, is_within};
use super::input::{UNUSED_SRDF, input, load_robot, load_scene};
use super::{ArmPlacement, Entry, Family, Query};
use crate::preprocessing::Preprocessing;
use crate::preprocessing::nested_roadmap::{self, Neighbours};
use crate::verification::roadmap::ARM_COLUMNS;
use crate::{Inputs, StudyError};
use base::seed::{self, Stream};
use base::settings::{Accepted, AnyTable, Document, Faults, Settings, SettingsError};
use base::units::{seems_in_metres, setting_in_radians};
use engine::geometry::Solid;
use engine::kinematics::ik::Branch;
use engine::kinematics::{AXES, FARTHEST_MM, Joints, Robot};
use engine::planner::Invalid;
use engine::space::cell::{self, Cell, EdgeEnd, LineRules, Lines, Scene, SpeedRule};
use engine::space::roadmap::{Counted, Extent, Local, Near, Sample};
use engine::space::{World, WorldKind};
use groups::{posed, read_queries};
use rand::RngExt as _;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::num::NonZeroU32;
use std::path::{Path, PathBuf};
use toml::Table;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "cell_queries",
    about: "queries of a six-axis arm in its cell, on roadmaps of free configurations drawn at random",
    instances: "roadmaps",
    revision: 5,
    is_drawn: true,
    preprocessing: nested_roadmap::ENTRY.name,
    columns: ARM_COLUMNS,
    settings: Accepted::shape::<CellQueries>(),
    example: r#"
robot = "data/robots/motoman_up6.toml"
scene = "data/scenes/fu2018_cell.toml"
queries = "data/scenes/fu2018_groups.toml"
obstacles = true
self_collision = true
samples = 1500
counted = "accepted"
region = "full"
radius_mm = 500
path = "tool"
step_mm = 20
step_deg = 4
jump_deg = 20
turn_deg = 180
end = "own"
tool_mm = 100
"#,
    build: |settings, inputs| Ok::<Box<dyn Family>, StudyError>(Box::new(Posed::new(settings, inputs)?)),
};

/// Draws per wanted sample after which a cell counts as full.
const DRAWS_PER_SAMPLE: u32 = 1000;
/// How many configurations are drawn and looked at together.
const DRAWN_TOGETHER: usize = 256;
/// How far the region around the queries' poses reaches beyond them.
const AROUND_DEG: f64 = 20.0;
/// Obstacles of a drawn scene that reach less into each other than this touch.
const TOUCHING_M: f64 = 1e-6;

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct CellQueries {
    /// The robot file.
    robot: String,
    /// What is laid over the robot file: elements of lists go by their number from 0 or their `name`.
    #[schemars(with = "Option<AnyTable>")]
    robot_with: Option<Table>,
    /// The SRDF file that says which links of a URDF robot may touch each other.
    srdf: Option<String>,
    /// The scene file; with a table `[drawn]`, a scene is drawn with each instance, in which nothing stands in anything else and the
    /// arm can stand at every written start and goal.
    scene: String,
    /// Which of several roadmaps in one drawn scene it is: a sweep over it gives every instance several.
    roadmap: Option<u32>,
    /// What is laid over the scene file.
    #[schemars(with = "Option<AnyTable>")]
    scene_with: Option<Table>,
    /// Whether the scene's obstacles stand there; what the robot stands on always does.
    obstacles: bool,
    /// How high boxes of the scene are, by name, instead of what its file says.
    #[serde(default)]
    heights_mm: BTreeMap<String, f64>,
    /// Whether the arm must not touch itself.
    self_collision: bool,
    /// Instead of the robot file's tool.
    #[schemars(range(min = 0, max = FARTHEST_MM))]
    tool_mm: Option<f64>,
    /// The file with the groups of poses that are started from and planned to; or how many queries are drawn with
    /// each instance, from and to free configurations of the region.
    queries: Queries,
    /// Where the tip is at a start that is drawn, as in `{ x = [0, 500], z = [300, 900] }`; anywhere if absent.
    start_mm: Option<SpaceLimits>,
    /// Where the tip is at a goal that is drawn; anywhere if absent.
    goal_mm: Option<SpaceLimits>,
    /// How many samples the roadmap is built from.
    #[schemars(range(min = 1, max = 100_000))]
    samples: u32,
    /// Which samples the number `samples` counts.
    counted: Counted,
    /// Where samples are drawn from.
    region: Region,
    /// How much of its range is used when a joint is drawn that turns by more than half a turn either way.
    #[serde(default)]
    turns: Turns,
    /// Samples are tried as neighbours if their tools are at most this far apart. One of this, `radius_deg` and `nearest` is given.
    #[schemars(range(min = 0.001, max = FARTHEST_MM))]
    radius_mm: Option<f64>,
    /// The factor on `radius_mm`, for a study that varies a radius set elsewhere.
    #[serde(default = "once")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    radius_times: f64,
    /// The least factor on the radius with which the roadmap is built, for planners whose neighbours may be farther apart.
    #[schemars(extend("exclusiveMinimum" = 0))]
    built_times: Option<f64>,
    /// How far two samples may be apart in joint space, by the root of the sum of squares over the joints.
    #[schemars(range(min = 0.001, max = 36_000))]
    radius_deg: Option<f64>,
    /// How many samples, the nearest in joint space, are tried as a sample's neighbours.
    #[schemars(range(min = 1))]
    nearest: Option<u32>,
    /// What moves straight between neighbours.
    path: cell::Path,
    /// How far the tool may move between two configurations that are checked.
    #[schemars(range(min = 0.1, max = 1000.0))]
    step_mm: f64,
    /// How far the tool may turn between two configurations that are checked.
    #[schemars(range(min = 0.1, max = 180.0))]
    step_deg: f64,
    /// How far a joint may move between two of them before the path counts as broken.
    #[schemars(range(min = 0.001, max = 3600))]
    jump_deg: f64,
    /// How far the tool may turn along one local path.
    #[schemars(range(min = 0.001, max = 360))]
    turn_deg: f64,
    /// What the end of a local path must be.
    end: EdgeEnd,
    /// The tool's speed; without it the path has no time.
    speed: Option<SpeedSetting>,
}

/// Where queries come from.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "a file of groups, or how many queries are drawn, is accepted")]
enum Queries {
    /// From this file of groups.
    File(String),
    /// So many are drawn.
    Drawn(#[schemars(range(max = 10_000))] NonZeroU32),
}

/// Where samples are drawn from, evenly.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum Region {
    /// All joint ranges, as far as `turns` says.
    Full,
    /// The same with the first joint within a quarter turn.
    Front,
    /// All, but only the branch of the first query's start.
    OneBranch,
    /// The smallest ranges that hold the queries' poses, and 20° more on either side.
    AroundPoses,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum Turns {
    /// At most half a turn either way.
    #[default]
    Half,
    /// The whole range.
    Whole,
}

#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct SpeedSetting {
    /// The greatest speed of the tool.
    #[schemars(extend("exclusiveMinimum" = 0))]
    tool_mm_s: f64,
    /// The greatest acceleration of the tool, in millimetres a second squared.
    #[schemars(extend("exclusiveMinimum" = 0))]
    acceleration_mm_s2: f64,
}

/// A radius as it is given.
fn once() -> f64 {
    1.0
}

impl CellQueries {
    /// Up to how many times `radius_mm` the roadmap joins samples.
    fn times(&self) -> f64 {
        self.built_times.map_or(self.radius_times, |least| self.radius_times.max(least))
    }

    /// `scene` with the heights that the settings give its boxes, or without its obstacles.
    fn furnished(&self, scene: Scene) -> Result<Scene, String> {
        if !self.obstacles {
            return Ok(scene.cleared());
        }
        let raised = |scene: Scene, (name, height_mm): (&String, &f64)| {
            let in_metres = seems_in_metres(&format!("heights_mm.{name}"), *height_mm);
            in_metres.map_or_else(|| scene.with_height(name, height_mm * 1e-3), Err)
        };
        self.heights_mm.iter().try_fold(scene, raised)
    }

    /// Refuses a speed of the tool that seems to be in metres.
    fn accept_speed(&self, settings: &Settings) -> Result<(), SettingsError> {
        let Some(SpeedSetting { tool_mm_s, acceleration_mm_s2 }) = self.speed else { return Ok(()) };
        let mut faults = Faults::default();
        for (key, found) in [("speed.tool_mm_s", tool_mm_s), ("speed.acceleration_mm_s2", acceleration_mm_s2)]
        {
            faults.keep(settings.accept_without(key, seems_in_metres(key, found)));
        }
        faults.done()
    }

    /// How queries are drawn, if they are.
    fn drawn(&self, settings: &Settings) -> Result<Option<Ends>, SettingsError> {
        let count = match &self.queries {
            Queries::File(_) => None,
            Queries::Drawn(count) => Some(*count),
        };
        if count.is_some() && matches!(self.region, Region::OneBranch | Region::AroundPoses) {
            let message = "region goes by the poses of queries that a file holds; full or front is accepted where they are drawn";
            return Err(settings.error_at("region", message));
        }
        Ends::of_tips(settings, count, [&self.start_mm, &self.goal_mm])
    }

    /// The robot in `file`, with the tool that `settings` name.
    fn robot(&self, settings: &Settings, inputs: &Inputs, file: &Path) -> Result<Robot, SettingsError> {
        if self.srdf.is_some() && !self.self_collision {
            return Err(settings.error_at("srdf", UNUSED_SRDF));
        }
        let locate = |name| inputs.locate(name).map_err(|message| settings.error_at("srdf", message));
        let srdf = self.srdf.as_deref().map(locate).transpose()?;
        let robot = load_robot((settings, inputs), file, self.robot_with.as_ref(), srdf.as_deref())?;
        let Some(tool_mm) = self.tool_mm else { return Ok(robot) };
        settings.accept_without("tool_mm", seems_in_metres("tool_mm", tool_mm))?;
        robot
            .with_tool_length(tool_mm * 1e-3)
            .map_err(|error| settings.error_at("tool_mm", format!("tool_mm: {error}")))
    }

    fn rules(&self) -> LineRules {
        LineRules {
            path: self.path,
            step_m: self.step_mm * 1e-3,
            step_rad: self.step_deg.to_radians(),
            jump_rad: self.jump_deg.to_radians(),
            turn_rad: self.turn_deg.to_radians(),
            speed: self.speed.map(|speed| SpeedRule {
                speed_m_s: speed.tool_mm_s * 1e-3,
                acceleration_m_s2: speed.acceleration_mm_s2 * 1e-3,
            }),
            end: self.end,
        }
    }
}

struct Posed {
    read: CellQueries,
    near: Near,
    /// The cell; the one in the middle of its bounds if it is drawn.
    cell: Cell,
    /// How the cell's scene is drawn, if it is.
    drawn_scene: Option<DrawnScene>,
    bounds_rad: [[f64; 2]; AXES],
    branch: Option<Branch>,
    queries: Vec<Query>,
    /// How queries are drawn, if they are.
    drawn: Option<Ends>,
    ends: Result<(), SettingsError>,
    inputs: Vec<PathBuf>,
}

impl Posed {
    fn new(settings: &Settings, inputs: &Inputs) -> Result<Self, SettingsError> {
        let read: CellQueries = settings.read()?;
        let CellQueries { radius_mm, radius_deg, nearest, .. } = read;
        let near = Neighbours { radius_mm, radius_deg, nearest }.rule(settings, read.times())?;
        let mut faults = Faults::default();
        // A joint that turns the tool by a step has moved as far itself.
        let turns = [
            ("step_deg", read.step_deg, 0.0),
            ("jump_deg", read.jump_deg, read.step_deg),
            ("turn_deg", read.turn_deg, 0.0),
        ];
        for (key, angle_deg, least_deg) in turns {
            faults.keep(settings.accept_without(key, setting_in_radians(key, angle_deg, least_deg)));
        }
        faults.keep(read.accept_speed(settings));
        let robot = faults
            .keep(input(settings, inputs, "robot", &read.robot, |file| read.robot(settings, inputs, file)));
        let scene = faults.keep(input(settings, inputs, "scene", &read.scene, |file| {
            load_scene((settings, inputs), file, read.scene_with.as_ref(), |document| {
                let drawn = DrawnScene::read(document)?;
                let middle = drawn.as_ref().map(DrawnScene::middle);
                Ok((Scene::parse(middle.as_ref().unwrap_or(document))?, drawn))
            })
        }));
        let drawn = faults.keep(read.drawn(settings));
        let placed = match &read.queries {
            Queries::Drawn(_) => None,
            Queries::File(file) => faults.keep(input(settings, inputs, "queries", file, |file| {
                inputs.once(file.display().to_string(), || {
                    let document = Document::open(file)?;
                    Ok((read_queries(&document)?, document))
                })
            })),
        };
        let all = robot.zip(scene).zip(drawn);
        let (((robot_file, robot), (scene_file, (scene, drawn_scene))), drawn) = faults.or(all)?;
        let scene = read.furnished(scene).map_err(|message| settings.error_at("heights_mm", message))?;
        if read.roadmap.is_some() && drawn_scene.is_none() {
            let message =
                "roadmap numbers the roadmaps of a drawn scene; a scene with a table `[drawn]` is accepted";
            return Err(settings.error_at("roadmap", message));
        }
        let cell = Cell::new(robot, scene, read.self_collision);
        let mut inputs = vec![robot_file, scene_file];
        let (queries, ends) = match placed {
            Some((file, (placed, document))) => {
                inputs.push(file);
                // In a drawn scene every instance sees to it.
                let ends = if drawn_scene.is_none() { posed(&cell, &document, &placed) } else { Ok(()) };
                (placed.0, ends)
            }
            None => (drawn.iter().flat_map(Ends::queries).cloned().collect(), Ok(())),
        };
        let bounds_rad = bounds_rad(&cell, &read, &queries);
        let branch = (read.region == Region::OneBranch).then(|| {
            let home: Joints = queries[0].start.as_slice().try_into().expect("a pose has six angles");
            cell.robot().arm().branch_of(&home)
        });
        inputs.extend(cell.robot().files().iter().cloned());
        Ok(Self { read, near, cell, drawn_scene, bounds_rad, branch, queries, drawn, ends, inputs })
    }

    /// The cell of the instance that belongs to `seed`.
    fn cell_of(&self, seed: u64) -> Result<Cell, Invalid> {
        let Some(drawn) = &self.drawn_scene else { return Ok(self.cell.clone()) };
        let ends: Vec<Joints> =
            self.queries.iter().flat_map(Query::ends).filter_map(|end| end.try_into().ok()).collect();
        // A draw that leaves a box without size is no scene, and is drawn again.
        let cell = drawn.draw(seed, |document| {
            let scene = self.read.furnished(Scene::parse(document).ok()?).ok()?;
            let cell = Cell::new(self.cell.robot().clone(), scene, self.read.self_collision);
            (are_apart(cell.scene()) && ends.iter().all(|end| cell.is_free(end))).then_some(cell)
        });
        cell.ok_or_else(|| Invalid("no drawn scene left every start and goal free".to_owned()))
    }

    /// The queries of the instance that belongs to `seed`, in its cell.
    fn queries_drawn(&self, cell: &Cell, seed: u64) -> Result<Vec<Query>, Invalid> {
        let Some(drawn) = &self.drawn else { return Ok(self.queries.clone()) };
        drawn.drawn(seed, |stream, limits| {
            let q = self.draw_configuration(stream);
            let tip_mm: [f64; 3] = (cell.robot().arm().chain().forward(&q).origin * 1e3).into();
            (is_within(&tip_mm, limits) && cell.is_free(&q)).then(|| q.to_vec())
        })
    }

    fn draw_configuration(&self, stream: &mut Stream) -> Joints {
        self.bounds_rad.map(|[low, high]| low + (high - low) * stream.random::<f64>())
    }

    /// Free configurations of `cell`, as many as the settings want, and how many draws they took; fewer if the draws run out.
    fn samples(&self, cell: &Cell, seed: u64) -> (Vec<Sample>, u32) {
        let seed = match self.read.roadmap {
            None => seed,
            Some(number) => seed::derive(seed, &["roadmap", &number.to_string()]),
        };
        let mut stream = seed::stream(seed);
        let wanted = self.read.samples;
        let mut samples = Vec::new();
        let mut draws = 0;
        let is_done = |accepted: usize, draws: u32| match self.read.counted {
            Counted::Accepted => accepted >= wanted as usize || draws / DRAWS_PER_SAMPLE >= wanted,
            Counted::Drawn => draws >= wanted,
        };
        let fits =
            |q: &Joints| self.branch.is_none_or(|branch| self.cell.robot().arm().branch_of(q) == branch);
        while !is_done(samples.len(), draws) {
            // What is drawn beyond the last sample is dropped: the stream serves nothing else.
            let drawn: [Joints; DRAWN_TOGETHER] =
                std::array::from_fn(|_| self.draw_configuration(&mut stream));
            for (q, is_free) in drawn.iter().zip(cell.are_free(&drawn)) {
                if is_done(samples.len(), draws) {
                    break;
                }
                if is_free && fits(q) {
                    samples.push(Sample { config: q.to_vec(), drawn_after: draws });
                }
                draws += 1;
            }
        }
        (samples, draws)
    }
}

/// Whether no box or ball about an obstacle of `scene` reaches into another's; touching is allowed.
fn are_apart(scene: &Scene) -> bool {
    let bounds: Vec<_> = scene
        .obstacles()
        .iter()
        .filter(|obstacle| !matches!(obstacle.solid, Solid::HalfSpace(_)))
        .map(|obstacle| obstacle.solid.aabb())
        .collect();
    bounds
        .iter()
        .enumerate()
        .all(|(index, one)| bounds[..index].iter().all(|other| !one.grown(-TOUCHING_M).overlaps(other)))
}

fn bounds_rad(cell: &Cell, read: &CellQueries, queries: &[Query]) -> [[f64; 2]; AXES] {
    let joints = cell.robot().arm().chain().joints();
    let half_turn = std::f64::consts::PI;
    let whole =
        joints.map(|joint| joint.range_rad()).map(|[low, high]| [low.max(-half_turn), high.min(half_turn)]);
    // A joint that turns beyond half a turn on one side only keeps its own ends.
    let whole: [[f64; 2]; AXES] = std::array::from_fn(|i| {
        let [low, high] = joints[i].range_rad();
        if high - low <= 2.0 * half_turn + 1e-9 || read.turns == Turns::Whole {
            [low, high]
        } else {
            whole[i]
        }
    });
    let poses = || queries.iter().flat_map(|query| [&query.start, &query.goal]);
    match read.region {
        Region::Full | Region::OneBranch => whole,
        Region::Front => {
            let quarter = half_turn / 2.0;
            let mut front = whole;
            front[0] = [front[0][0].max(-quarter), front[0][1].min(quarter)];
            front
        }
        Region::AroundPoses => std::array::from_fn(|i| {
            let around = AROUND_DEG.to_radians();
            let low = poses().map(|pose| pose[i]).fold(f64::INFINITY, f64::min) - around;
            let high = poses().map(|pose| pose[i]).fold(f64::NEG_INFINITY, f64::max) + around;
            [low.max(whole[i][0]), high.min(whole[i][1])]
        }),
    }
}

impl Family for Posed {
    fn world(&self) -> WorldKind {
        WorldKind::Roadmap
    }

    fn prepare(&self, seed: u64) -> Result<Preprocessing, Invalid> {
        let cell = self.cell_of(seed)?;
        let queries = self.queries_drawn(&cell, seed)?;
        let (samples, draws) = self.samples(&cell, seed);
        let counted = self.read.counted;
        if counted == Counted::Accepted && samples.len() < self.read.samples as usize {
            let found = samples.len();
            let wanted = self.read.samples;
            return Err(Invalid(format!(
                "{found} of {wanted} free configurations were found in {draws} draws"
            )));
        }
        let lines = Lines::new(cell, self.read.rules());
        let local = Local::Arm(Box::new(lines.clone()));
        let mut preprocessing = nested_roadmap::prepare(local, samples, draws, self.near, counted);
        if let (World::Roadmap(map), Some(unit_mm)) = (&mut preprocessing.world, self.read.radius_mm) {
            map.set_unit(unit_mm, self.read.times());
        }
        preprocessing.traces = picture::traces(&lines, &queries);
        Ok(preprocessing)
    }

    fn queries(&self) -> &[Query] {
        &self.queries
    }

    fn queries_for(&self, seed: u64) -> Vec<Query> {
        if self.drawn.is_none() {
            return self.queries.clone();
        }
        let queries = self.cell_of(seed).and_then(|cell| self.queries_drawn(&cell, seed));
        queries.unwrap_or_else(|_| self.queries.clone())
    }

    fn draws_ends(&self) -> bool {
        self.drawn.is_some()
    }

    fn check_ends(&self) -> Result<(), SettingsError> {
        self.ends.clone()
    }

    fn instances(&self) -> Option<&'static str> {
        self.drawn_scene.is_some().then_some("cells")
    }

    fn cells(&self) -> u64 {
        u64::from(self.read.samples)
    }

    fn extent(&self) -> Option<Extent> {
        Some(nested_roadmap::extent(self.read.samples, self.near, self.read.times()))
    }

    fn stance(&self, q_rad: &[f64]) -> Option<ArmPlacement> {
        // How clear an arm is in a drawn scene hangs on the instance.
        if self.drawn_scene.is_some() { None } else { picture::stance(&self.cell, q_rad) }
    }

    fn notes(&self) -> Vec<String> {
        let notes = self.cell.robot().notes();
        notes.into_iter().map(|note| format!("{}: {note}", self.read.robot)).collect()
    }

    fn inputs(&self) -> &[PathBuf] {
        &self.inputs
    }
}

#[cfg(test)]
mod tests;
