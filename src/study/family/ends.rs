//! Starts and goals that are written in settings, or drawn with each instance.
//!
//! A family says how a point is drawn within limits and whether it is free. This module decides how often that is tried and that
//! a goal is never the start. Each query draws from a stream of its own: one more query moves no other, and none moves what else
//! is drawn with the instance.

use super::Query;
use base::seed::{self, Stream};
use base::settings::{Faults, Settings, SettingsError};
use base::text::listed;
use base::units::points_in_metres;
use engine::planner::Invalid;
use schemars::JsonSchema;
use serde::Deserialize;
use std::num::NonZeroU32;

/// How many points are drawn for one end of a query before the instance is given up.
const TRIES: u32 = 100_000;

/// A start or a goal as settings write it.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "coordinates, `drawn`, or limits along the axes are accepted")]
pub(super) enum End<P, R> {
    /// There.
    Written(P),
    /// Drawn with each instance.
    Drawn(Anywhere),
    /// Drawn with each instance, within these limits.
    Within(R),
}

/// Without limits.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(super) enum Anywhere {
    /// Anywhere that is free.
    Drawn,
}

/// A start or goal in the plane: `[x, y]`, drawn, or drawn within limits.
pub(super) type PlaneEnd<T> = End<[T; 2], PlaneLimits<T>>;

/// Limits in the plane; a coordinate without a limit is drawn from all that there are.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct PlaneLimits<T> {
    /// The least and the greatest x, or the only one.
    x: Option<Limit<T>>,
    /// The least and the greatest y, or the only one.
    y: Option<Limit<T>>,
}

/// Limits in space; a coordinate without a limit is drawn from all that there are.
#[derive(Debug, Clone, Copy, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SpaceLimits {
    /// The least and the greatest x, or the only one.
    x: Option<Limit<f64>>,
    /// The least and the greatest y, or the only one.
    y: Option<Limit<f64>>,
    /// The least and the greatest z, or the only one.
    z: Option<Limit<f64>>,
}

/// What one coordinate may be.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "a number, or the least and the greatest, is accepted")]
enum Limit<T> {
    /// This alone.
    One(T),
    /// The least and the greatest.
    Range([T; 2]),
}

impl<T: Copy + Into<f64>> Limit<T> {
    fn range(self) -> [f64; 2] {
        match self {
            Self::One(value) => [value.into(); 2],
            Self::Range(range) => range.map(Into::into),
        }
    }
}

/// One end of every query of a family.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Place {
    /// There.
    At(Vec<f64>),
    /// Drawn within the least and the greatest of each coordinate.
    Within(Vec<[f64; 2]>),
}

impl Place {
    /// The point, if it is written.
    fn written(&self) -> Option<&[f64]> {
        match self {
            Self::At(at) => Some(at),
            Self::Within(_) => None,
        }
    }

    /// The same within the least and the greatest of these rows, where it is drawn; `None` if no row is left.
    pub(super) fn in_rows(self, rows: [f64; 2]) -> Option<Self> {
        let Self::Within(mut limits) = self else { return Some(self) };
        limits[1] = [limits[1][0].max(rows[0]), limits[1][1].min(rows[1])];
        (limits[1][0] <= limits[1][1]).then_some(Self::Within(limits))
    }

    /// The point, if no other can be drawn.
    fn only(&self) -> Option<Vec<f64>> {
        match self {
            Self::At(at) => Some(at.clone()),
            Self::Within(limits) => {
                let only = |[low, high]: &[f64; 2]| (low == high).then_some(*low);
                limits.iter().map(only).collect()
            }
        }
    }
}

impl<T: Copy + Into<f64>> PlaneEnd<T> {
    /// Where the end is that settings write under `key`, in a plane of these limits.
    ///
    /// # Errors
    /// Limits that are not in order or leave the plane.
    pub(super) fn place(
        &self,
        settings: &Settings,
        key: &str,
        plane: [[f64; 2]; 2],
    ) -> Result<Place, SettingsError> {
        match self {
            Self::Written(at) => Ok(Place::At(at.map(Into::into).to_vec())),
            Self::Drawn(Anywhere::Drawn) => Ok(Place::Within(plane.to_vec())),
            Self::Within(PlaneLimits { x, y }) => {
                let limits = [("x", x, plane[0]), ("y", y, plane[1])]
                    .map(|(axis, limit, whole)| (axis, limit.map(Limit::range), whole));
                within(settings, key, &limits)
            }
        }
    }
}

/// Whether each coordinate of `point` is within its limits.
pub(super) fn is_within(point: &[f64], limits: &[[f64; 2]]) -> bool {
    point.iter().zip(limits).all(|(value, [low, high])| low <= value && value <= high)
}

impl SpaceLimits {
    /// The place within these limits, which settings write under `key`.
    ///
    /// # Errors
    /// Limits that are not in order.
    pub(super) fn place(&self, settings: &Settings, key: &str) -> Result<Place, SettingsError> {
        let whole = [f64::NEG_INFINITY, f64::INFINITY];
        let limits = [("x", self.x), ("y", self.y), ("z", self.z)]
            .map(|(axis, limit)| (axis, limit.map(Limit::range), whole));
        within(settings, key, &limits)
    }

    /// The message about limits under `key` that seem to be in metres.
    fn in_metres(&self, key: &str) -> Option<String> {
        let limits: Vec<f64> =
            [self.x, self.y, self.z].into_iter().flatten().flat_map(Limit::range).collect();
        points_in_metres(key, &limits)
    }
}

/// The place within the limits of `axes`: each has its name, its limits and the widest that are accepted, which stand in for
/// absent ones.
///
/// # Errors
/// Limits out of order or wider than the widest.
fn within(
    settings: &Settings,
    key: &str,
    axes: &[(&str, Option<[f64; 2]>, [f64; 2])],
) -> Result<Place, SettingsError> {
    let mut faults = Faults::default();
    let mut limits = Vec::new();
    for (axis, limit, whole) in axes {
        let [low, high] = limit.unwrap_or(*whole);
        if !(whole[0] <= low && low <= high && high <= whole[1]) {
            let bounds = if whole[0].is_finite() {
                format!(", both from {} to {},", whole[0], whole[1])
            } else {
                String::new()
            };
            let message = format!(
                "{axis} of {key} is from {low} to {high}; the least and the greatest{bounds} are accepted"
            );
            faults.add(settings.error_at(&format!("{key}.{axis}"), message));
        }
        limits.push([low, high]);
    }
    faults.or(Some(Place::Within(limits)))
}

/// The queries of a family: how many an instance has, and where they start and end.
#[derive(Debug, Clone)]
pub(super) struct Ends {
    start: Place,
    goal: Place,
    queries: Vec<Query>,
}

impl Ends {
    /// `count` queries, one if it is absent, from `start` to `goal`; `error_at` makes an error about `goal` or `queries`.
    ///
    /// # Errors
    /// A goal that cannot but be the start; several queries between fixed ends.
    pub(super) fn new(
        start: Place,
        goal: Place,
        count: Option<NonZeroU32>,
        error_at: impl Fn(&str, String) -> SettingsError,
    ) -> Result<Self, SettingsError> {
        let count = count.map_or(1, NonZeroU32::get);
        if let (Some(from), Some(to)) = (start.only(), goal.only()) {
            if from == to && [&start, &goal].iter().any(|place| place.written().is_none()) {
                let message = format!(
                    "start and goal can be drawn at {} alone; wider limits are accepted",
                    listed(&from)
                );
                return Err(error_at("goal", message));
            }
            if count > 1 {
                let message = format!("queries is {count}, and nothing of them is drawn; 1 is accepted");
                return Err(error_at("queries", message));
            }
        }
        let query = |number: u32| Query {
            name: if count == 1 { String::new() } else { number.to_string() },
            start: start.written().unwrap_or_default().to_vec(),
            goal: goal.written().unwrap_or_default().to_vec(),
        };
        let queries = (1..=count).map(query).collect();
        Ok(Self { start, goal, queries })
    }

    /// So many queries of an arm, whose tip lies within limits that settings write under `start_mm` and `goal_mm`; `None` if none
    /// is drawn.
    ///
    /// # Errors
    /// Limits that are not in order, or that nothing is drawn within.
    pub(super) fn of_tips(
        settings: &Settings,
        count: Option<NonZeroU32>,
        limits: [&Option<SpaceLimits>; 2],
    ) -> Result<Option<Self>, SettingsError> {
        let keys = ["start_mm", "goal_mm"];
        let mut faults = Faults::default();
        let [start, goal] = [0, 1].map(|end| {
            let key = keys[end];
            let limits = limits[end];
            if limits.is_some() && count.is_none() {
                let message = format!(
                    "{key} limits queries that are drawn; `queries`, how many, is accepted beside it"
                );
                faults.add(settings.error_at(key, message));
            }
            let limits = limits.unwrap_or_default();
            if let Some(message) = limits.in_metres(key) {
                faults.add(settings.error_at(key, message));
            }
            faults.keep(limits.place(settings, key))
        });
        let (start, goal) = faults.or(start.zip(goal))?;
        let error_at =
            |key: &str, message| settings.error_at(if key == "goal" { "goal_mm" } else { key }, message);
        count.map(|_| Self::new(start, goal, count, error_at)).transpose()
    }

    /// The queries, without the ends that are drawn.
    pub(super) fn queries(&self) -> &[Query] {
        &self.queries
    }

    /// Whether a start or a goal is drawn.
    pub(super) fn are_drawn(&self) -> bool {
        self.written().count() < 2
    }

    /// The ends that are written.
    pub(super) fn written(&self) -> impl Iterator<Item = &[f64]> {
        [&self.start, &self.goal].into_iter().filter_map(Place::written)
    }

    /// The queries of the instance that belongs to `seed`. `draw` draws a point within limits and gives it back if it is free.
    ///
    /// # Errors
    /// [`Invalid`] if no free point is found.
    pub(super) fn drawn(
        &self,
        seed: u64,
        draw: impl Fn(&mut Stream, &[[f64; 2]]) -> Option<Vec<f64>>,
    ) -> Result<Vec<Query>, Invalid> {
        if !self.are_drawn() {
            return Ok(self.queries.clone());
        }
        let query = |(number, named): (usize, &Query)| {
            let mut stream = seed::stream(seed::derive(seed, &["query", &number.to_string()]));
            let mut left = [TRIES; 2];
            let mut end = |what: &str, place: &Place, left: &mut u32| {
                let limits = match place {
                    Place::At(at) => return Ok(at.clone()),
                    Place::Within(limits) => limits,
                };
                while *left > 0 {
                    *left -= 1;
                    if let Some(point) = draw(&mut stream, limits) {
                        return Ok(point);
                    }
                }
                let of =
                    if named.name.is_empty() { String::new() } else { format!(" of query {}", named.name) };
                Err(Invalid(format!("no free {what}{of} was found in {TRIES} draws")))
            };
            loop {
                let start = end("start", &self.start, &mut left[0])?;
                let goal = end("goal", &self.goal, &mut left[1])?;
                if start != goal {
                    return Ok(Query { name: named.name.clone(), start, goal });
                }
            }
        };
        self.queries.iter().enumerate().map(query).collect()
    }
}
