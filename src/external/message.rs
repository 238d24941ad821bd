//! The messages, one line of JSON each.

use super::world::{Kind, Pose, World};
use schemars::JsonSchema;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, MapAccess, Visitor};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::marker::PhantomData;

/// The version of the protocol.
pub const PROTOCOL: u32 = 1;

/// Every message, for a schema of them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Messages {
    /// A line that a planner writes.
    pub from_planner: FromPlanner,
    /// A line that replan writes.
    pub to_planner: ToPlanner,
}

/// What stands in a message as an object: of itself, the JSON library also reads a list by the order of the keys.
pub(super) struct Object<T>(pub T);

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Object<T> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_map(Keys(PhantomData)).map(Self)
    }
}

struct Keys<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for Keys<T> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object")
    }

    fn visit_map<A: MapAccess<'de>>(self, keys: A) -> Result<T, A::Error> {
        T::deserialize(MapAccessDeserializer::new(keys))
    }
}

/// What a planner writes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum FromPlanner {
    /// Its first line, within ten seconds.
    Hello(Hello),
    /// Questions, in a batch; replan answers before anything else.
    Ask(Ask),
    /// A path, the best so far; any number of them before the result.
    Incumbent(Incumbent),
    /// How the query ended.
    Result(QueryResult),
}

/// What replan writes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum ToPlanner {
    /// A query.
    Solve(Box<Solve>),
    /// The answers to a batch of questions.
    Answer(Answer),
    /// There are no more queries: the planner ends.
    Quit,
}

/// Who a planner is.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Hello {
    /// The version of the protocol that it speaks.
    pub protocol: u32,
    /// Its name.
    pub name: String,
    /// Its version, with those of the libraries that move its results.
    pub version: String,
    /// The worlds that it plans in.
    pub worlds: Vec<Kind>,
    /// When it can be seeded.
    pub seeding: Seeding,
    /// Whether it promises equal results for an equal query and seed, however long they take.
    pub deterministic: bool,
    /// Whether it writes incumbents and goes on while there is time.
    pub anytime: bool,
}

/// When a planner can be seeded.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Seeding {
    /// Once a process: every query gets a process of its own.
    Process,
    /// With every query: one process may be given many, one after another.
    Query,
}

/// A query.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Solve {
    /// Its number; the result bears it.
    pub id: u64,
    /// The seed of a planner that draws; below 2⁵³.
    pub seed: u64,
    /// Limits that replan holds.
    pub limits: Limits,
    /// Where to plan.
    pub world: World,
    /// The start configuration.
    pub start: Vec<f64>,
    /// The goal configuration.
    pub goal: Vec<f64>,
}

/// Limits that replan holds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Limits {
    /// From the query to its result by replan's clock; questions count.
    pub time_s: f64,
    /// Address space of each of the planner's processes.
    pub memory_mb: u64,
    /// What it may write on standard output for one query.
    pub output_mb: u64,
}

/// Questions about the world of the query in hand.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Ask {
    /// A number that the answer bears.
    pub id: u64,
    /// Whether each configuration is free.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub valid: Option<Vec<Vec<f64>>>,
    /// Whether the motion between each two configurations is free, both ends included.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub motion: Option<Vec<[Vec<f64>; 2]>>,
    /// Whether the answer also gives, for each motion, the fraction up to which it is free.
    #[serde(default)]
    pub fractions: bool,
    /// Where the tip is in each of an arm's postures, given as joint angles.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fk: Option<Vec<Vec<f64>>>,
    /// All postures, as joint angles, with the tip in each pose.
    #[serde(default, skip_serializing_if = "Option::is_none", deserialize_with = "poses")]
    pub ik: Option<Vec<Pose>>,
}

/// Answers, in the order of the questions: a list for each list of questions, an empty one too.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Answer {
    /// The number of the questions.
    pub id: u64,
    /// To `valid`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub valid: Option<Vec<bool>>,
    /// To `motion`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub motion: Option<Vec<bool>>,
    /// A fraction of each motion up to which it is free: 1 for a free one. What fails, fails after it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub free_until: Option<Vec<f64>>,
    /// To `fk`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fk: Option<Vec<Pose>>,
    /// To `ik`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ik: Option<Vec<Vec<Vec<f64>>>>,
}

/// The best path so far.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Incumbent {
    /// The query.
    pub id: u64,
    /// What the planner takes for its cost; replan measures the path itself.
    pub cost: Option<f64>,
    /// From start to goal.
    pub path: Vec<Vec<f64>>,
}

/// How a query ended.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct QueryResult {
    /// The query.
    pub id: u64,
    /// How it ended.
    pub status: Status,
    /// From start to goal; one beside another status refuses the result.
    #[serde(default)]
    pub path: Vec<Vec<f64>>,
    /// The path's cost in the world's unit; the verifier refuses one that is not the path's. Absent if it was not worked out, and
    /// where there is no path.
    #[serde(default)]
    pub cost: Option<f64>,
    /// What the planner counted.
    #[serde(default, deserialize_with = "counters")]
    pub counters: Counters,
}

fn poses<'de, D: Deserializer<'de>>(from: D) -> Result<Option<Vec<Pose>>, D::Error> {
    let poses: Option<Vec<Object<Pose>>> = Deserialize::deserialize(from)?;
    Ok(poses.map(|poses| poses.into_iter().map(|Object(pose)| pose).collect()))
}

fn counters<'de, D: Deserializer<'de>>(from: D) -> Result<Counters, D::Error> {
    Object::deserialize(from).map(|Object(counters)| counters)
}

/// A counter that is written; `null` becomes a number that none fits.
fn counter<'de, D: Deserializer<'de>>(from: D) -> Result<Option<f64>, D::Error> {
    Option::deserialize(from).map(|number: Option<f64>| number.or(Some(f64::NAN)))
}

/// The counters of a planner, each optional: one column each. An unknown name, or a number outside its column's range,
/// refuses the result.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Counters {
    /// Expanded nodes, a whole number.
    #[serde(deserialize_with = "counter")]
    pub expansions: Option<f64>,
    /// Iterations, a whole number.
    #[serde(deserialize_with = "counter")]
    pub iterations: Option<f64>,
    /// Samples, a whole number.
    #[serde(deserialize_with = "counter")]
    pub samples: Option<f64>,
    /// Its time by its own clock, a whole number.
    #[serde(deserialize_with = "counter")]
    pub own_wall_ns: Option<f64>,
}

impl Counters {
    /// From here on most languages, this one too, round whole numbers of JSON: 2⁵³.
    const TOO_MANY: f64 = 9_007_199_254_740_992.0;

    /// Each by the name of its column.
    pub fn named(&self) -> [(&'static str, Option<f64>); 4] {
        let Self { expansions, iterations, samples, own_wall_ns } = *self;
        [
            ("expansions", expansions),
            ("iterations", iterations),
            ("samples", samples),
            ("own_wall_ns", own_wall_ns),
        ]
    }

    /// The name of the first one that is no whole number of 0 or more and below 2⁵³.
    pub(super) fn misfit(&self) -> Option<&'static str> {
        let fits = |value: f64| value.fract() == 0.0 && (0.0..Self::TOO_MANY).contains(&value);
        self.named().into_iter().find_map(|(name, value)| (!fits(value?)).then_some(name))
    }
}

/// How a query ended, by the planner.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// With a path.
    Solved,
    /// There is no path, or the planner has nothing left to try.
    NoPath,
    /// A limit of the planner's own was reached.
    BudgetSpent,
    /// Its time ran out.
    TimeSpent,
}
