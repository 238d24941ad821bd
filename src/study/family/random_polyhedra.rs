//! Random obstacles of several shapes in a cube, apart from each other or not, with written queries or one drawn with them.

use super::polyhedra_scene::{Contact, Line, QuerySettings, point};
use super::{Entry, Family, Query};
use crate::StudyError;
use crate::preprocessing::{Preprocessing, polyhedra};
use crate::verification::POLYHEDRA_COLUMNS;
use base::seed::{self, Stream};
use base::settings::{Accepted, Faults, Settings, SettingsError};
use engine::geometry::{Aabb, Axis, Convex, Segment, Vec3, distance_segment_convex};
use engine::planner::Invalid;
use engine::space::{PolyhedraWorld, WorldKind};
use rand::RngExt as _;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "random_polyhedra",
    about: "a random number of random obstacles in a cube, disjoint or not, with written queries or a drawn one",
    instances: "environments",
    revision: 2,
    is_drawn: true,
    preprocessing: polyhedra::ENTRY.name,
    columns: POLYHEDRA_COLUMNS,
    settings: Accepted::shape::<RandomPolyhedra>(),
    example: r#"
side_cm = 60
step_cm = 1
count = [1, 20]
size_cm = [7, 16]
shapes = ["box", "prism", "octahedron", "wedge", "pyramid"]
gap_cm = 1
clear_cm = 2
queries = [{ start = [4, 5, 6], goal = [56, 54, 50] }]
"#,
    build: |settings, _inputs| {
        let read: RandomPolyhedra = settings.read()?;
        read.check(settings)?;
        let mut written: Vec<Query> = read.queries.iter().map(QuerySettings::query).collect();
        // The ends of the one that is drawn are not known here.
        let drawn = read.drawn.map(|_| Query { name: String::new(), start: Vec::new(), goal: Vec::new() });
        written.extend(drawn);
        Ok::<Box<dyn Family>, StudyError>(Box::new(Drawn { read, written }))
    },
};

/// How often an obstacle is drawn again before a draw is given up.
const TRIES: u32 = 10_000;

#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct RandomPolyhedra {
    /// The side of the cube that they stand in.
    side_cm: f64,
    /// The side of a lattice cell.
    step_cm: f64,
    /// The fewest and the most obstacles; each number in between is as likely.
    #[schemars(inner(range(max = 10_000)))]
    count: [u32; 2],
    /// The least and the greatest extent along each axis.
    size_cm: [f64; 2],
    /// The shapes that are drawn from, each with equal chance.
    #[schemars(length(min = 1))]
    shapes: Vec<ShapeName>,
    /// The least distance between the boxes about two obstacles; they may overlap without it.
    gap_cm: Option<f64>,
    /// How far obstacles stay from starts and goals.
    clear_cm: f64,
    /// The queries on every draw: start and goal each.
    #[serde(default)]
    queries: Vec<QuerySettings>,
    /// In place of written queries, one that is drawn with each environment.
    drawn: Option<DrawnQuery>,
    /// Whether a point on an obstacle's face is blocked.
    #[serde(default)]
    contact: Contact,
}

/// How a start and a goal are drawn: anywhere in the cube with equal chance.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct DrawnQuery {
    /// The least distance between the two.
    apart_cm: f64,
    /// Which environments are kept.
    line: Line,
}

#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum ShapeName {
    /// A box along the axes.
    Box,
    /// A prism with a regular base.
    Prism,
    /// A regular octahedron.
    Octahedron,
    /// A box cut in two along a diagonal.
    Wedge,
    /// A pyramid with a square base.
    Pyramid,
}

impl RandomPolyhedra {
    fn check(&self, settings: &Settings) -> Result<(), SettingsError> {
        let [fewest, most] = self.count;
        let [least, greatest] = self.size_cm;
        let mut faults = Faults::default();
        if fewest > most {
            let message =
                format!("count is [{fewest}, {most}]; the fewest and the most, in this order, are accepted");
            faults.add(settings.error_at("count", message));
        }
        if !(0.0 < least && least <= greatest && greatest < self.side_cm) {
            let message = format!(
                "size_cm is [{least}, {greatest}]; two rising sizes above 0 and below side_cm are accepted"
            );
            faults.add(settings.error_at("size_cm", message));
        }
        self.check_drawn(settings, &mut faults);
        let empty = self.world(Vec::new()).map_err(|invalid| settings.error_at("step_cm", invalid.0));
        if let Some(empty) = faults.keep(empty)
            && self.drawn.is_none()
        {
            let queries: Vec<Query> = self.queries.iter().map(QuerySettings::query).collect();
            faults.keep(super::polyhedra_scene::check(settings, &empty, &queries));
        }
        faults.done()
    }

    fn check_drawn(&self, settings: &Settings, faults: &mut Faults) {
        let Some(drawn) = self.drawn else { return };
        if !self.queries.is_empty() {
            faults.add(settings.error_at("drawn", "queries are written or drawn, not both"));
        }
        if !(drawn.apart_cm > 0.0 && drawn.apart_cm <= self.side_cm) {
            let message = format!(
                "apart_cm is {}; more than 0 and at most the cube's side, {}, is accepted",
                drawn.apart_cm, self.side_cm
            );
            faults.add(settings.error_at("drawn.apart_cm", message));
        }
        if drawn.line == Line::Blocked && self.count[1] == 0 {
            let message = "line is blocked, and there are no obstacles to block it; any is accepted";
            faults.add(settings.error_at("drawn.line", message));
        }
    }

    fn world(&self, bodies: Vec<Convex>) -> Result<PolyhedraWorld, Invalid> {
        let domain = Aabb { min: Vec3::zeros(), max: Vec3::repeat(self.side_cm) };
        let world = PolyhedraWorld::new(bodies, domain, self.step_cm, 0.0);
        world.map(|world| self.contact.applied(world)).map_err(|e| Invalid(e.to_string()))
    }

    fn shape(&self, stream: &mut Stream) -> Convex {
        let [least, greatest] = self.size_cm;
        let size = Vec3::from_fn(|_, _| stream.random_range(least..=greatest));
        let center = Vec3::from_fn(|_, _| stream.random_range(0.0..=self.side_cm));
        let made = match self.shapes[stream.random_range(0..self.shapes.len())] {
            ShapeName::Box => Convex::cuboid(center, size),
            ShapeName::Octahedron => Convex::octahedron(center, size.x / 2.0),
            ShapeName::Wedge => Convex::wedge(center, size),
            ShapeName::Pyramid => Convex::pyramid(center, size.x, size.y),
            ShapeName::Prism => {
                let axis = [Axis::X, Axis::Y, Axis::Z][stream.random_range(0..3)];
                let sides = stream.random_range(5..=8);
                let turn = stream.random_range(0.0..1.0);
                Convex::prism(axis, center, size.x / 2.0, size.y, sides, turn)
            }
        };
        made.expect("sizes were checked when the settings were read")
    }

    /// Whether `shape` lies in the cube, off the queries' ends and apart from the others.
    fn fits(&self, shape: &Convex, others: &[Convex], queries: &[Query]) -> bool {
        let within = shape.aabb().min.min() >= 0.0 && shape.aabb().max.max() <= self.side_cm;
        let mut ends = queries.iter().flat_map(|query| [&query.start, &query.goal]);
        let off = |end: &Vec<f64>| {
            let point = point(end);
            distance_segment_convex(&Segment::new(point, point), shape) > self.clear_cm
        };
        let apart = |gap: f64| others.iter().all(|o| !o.aabb().grown(gap).overlaps(shape.aabb()));
        within && ends.all(off) && self.gap_cm.is_none_or(apart)
    }

    /// Obstacles that stay off the ends of `queries`.
    fn bodies(&self, stream: &mut Stream, queries: &[Query]) -> Result<Vec<Convex>, Invalid> {
        let [fewest, most] = self.count;
        let count = stream.random_range(fewest..=most);
        let mut bodies: Vec<Convex> = Vec::new();
        for number in 0..count {
            let mut draws = (0..TRIES).map(|_| self.shape(stream));
            let found = draws.find(|shape| self.fits(shape, &bodies, queries));
            let shape = found.ok_or_else(|| {
                Invalid(format!("obstacle {} of {count} found no place in {TRIES} draws", number + 1))
            })?;
            bodies.push(shape);
        }
        Ok(bodies)
    }

    /// A start and a goal anywhere in the cube, far enough apart.
    fn query(&self, stream: &mut Stream, drawn: DrawnQuery) -> Query {
        let mut ends = || [0; 2].map(|_| Vec3::from_fn(|_, _| stream.random_range(0.0..=self.side_cm)));
        let [start, goal] = std::iter::repeat_with(&mut ends)
            .find(|[start, goal]| (start - goal).norm() >= drawn.apart_cm)
            .expect("two points of a cube are as far apart as its side with a chance above 0");
        Query { name: String::new(), start: start.as_slice().to_vec(), goal: goal.as_slice().to_vec() }
    }

    /// The obstacles and the query that are drawn with `seed`.
    fn environment(&self, seed: u64, drawn: DrawnQuery) -> Result<(Vec<Convex>, Query), Invalid> {
        let mut stream = seed::stream(seed);
        for _ in 0..TRIES {
            let query = self.query(&mut stream, drawn);
            let bodies = self.bodies(&mut stream, std::slice::from_ref(&query))?;
            if drawn.line.keeps(&query, &bodies) {
                return Ok((bodies, query));
            }
        }
        Err(Invalid(format!("no obstacle was in the way in {TRIES} draws of query and obstacles")))
    }
}

struct Drawn {
    read: RandomPolyhedra,
    written: Vec<Query>,
}

impl Family for Drawn {
    fn world(&self) -> WorldKind {
        WorldKind::Polyhedra
    }

    fn prepare(&self, seed: u64) -> Result<Preprocessing, Invalid> {
        let bodies = match self.read.drawn {
            None => self.read.bodies(&mut seed::stream(seed), &self.written)?,
            Some(drawn) => self.read.environment(seed, drawn)?.0,
        };
        Ok(polyhedra::prepare(self.read.world(bodies)?))
    }

    fn queries(&self) -> &[Query] {
        &self.written
    }

    fn cells(&self) -> u64 {
        let nodes = (self.read.side_cm / self.read.step_cm + 1e-9).floor() + 1.0;
        (nodes * nodes * nodes) as u64
    }

    fn queries_for(&self, seed: u64) -> Vec<Query> {
        let Some(drawn) = self.read.drawn else { return self.written.clone() };
        // An environment that cannot be drawn is refused by `prepare`, with the reason; its query is never planned.
        let any = |_| self.read.query(&mut seed::stream(seed), drawn);
        vec![self.read.environment(seed, drawn).map_or_else(any, |(_, query)| query)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inputs::Inputs;
    use toml::Table;

    const PLAIN: &str = "side_cm = 60\nstep_cm = 1\ncount = [1, 12]\nsize_cm = [7, 16]\nclear_cm = 2\n\
        shapes = ['box', 'octahedron']\n";

    fn build(more: &str) -> Result<Box<dyn Family>, String> {
        let table = format!("{PLAIN}{more}").parse::<Table>().unwrap();
        let settings = Settings::composed("plain", table);
        (ENTRY.build)(&settings, &Inputs::below(Vec::new())).map_err(|e| e.to_string())
    }

    #[test]
    fn a_drawn_query_belongs_to_its_environment_and_is_blocked_where_that_is_wanted() {
        let mut blocked = [0, 0];
        let mut pairs = std::collections::BTreeSet::new();
        for (index, line) in ["any", "blocked"].into_iter().enumerate() {
            let family = build(&format!("drawn = {{ apart_cm = 40, line = '{line}' }}")).unwrap();
            for seed in 0..60 {
                let [query] = family.queries_for(seed).try_into().unwrap();
                assert_eq!(vec![query.clone()], family.queries_for(seed), "seed {seed}");
                let preprocessing = family.prepare(seed).unwrap();
                let world = preprocessing.world.as_polyhedra().unwrap();
                let [start, goal] = [&query.start, &query.goal].map(|end| point(end));
                assert!((start - goal).norm() >= 40.0, "seed {seed}");
                assert!([start, goal].iter().all(|end| world.is_free(end)), "seed {seed}");
                blocked[index] += u32::from(!world.is_clear(&Segment::new(start, goal)));
                pairs.insert(format!("{line} {:?}", query.start));
            }
        }
        assert_eq!((blocked[1], pairs.len()), (60, 120));
        assert!((15..50).contains(&blocked[0]), "one-sided sample: {} of 60 blocked", blocked[0]);
    }

    #[test]
    fn written_and_drawn_queries_exclude_each_other() {
        let drawn = "drawn = { apart_cm = 40, line = 'any' }\n";
        let written = "queries = [{ start = [4, 5, 6], goal = [56, 54, 50] }]\n";
        assert!(build(drawn).is_ok() && build(written).is_ok());
        for (more, part) in [
            (format!("{drawn}{written}"), "written or drawn, not both"),
            ("drawn = { apart_cm = 70, line = 'any' }".to_owned(), "at most the cube's side, 60"),
            (String::new(), "queries is empty"),
        ] {
            let refused = build(&more).err().unwrap_or_else(|| panic!("{more} was accepted"));
            assert!(refused.contains(part), "{refused}");
        }
    }
}
