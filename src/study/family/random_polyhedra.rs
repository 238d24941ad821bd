//! Random obstacles of several shapes in a cube, apart from each other or not, with written queries.

use super::polyhedra_scene::QuerySettings;
use super::{Entry, Family, Query};
use crate::study::StudyError;
use crate::study::prepared::{Prepared, polyhedra};
use crate::study::verification::POLYHEDRA_COLUMNS;
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
    about: "a random number of random obstacles in a cube, disjoint or not, with written queries",
    revision: 2,
    prepared: polyhedra::ENTRY.name,
    columns: POLYHEDRA_COLUMNS,
    settings: Accepted::of::<RandomPolyhedra>(),
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
        let queries = read.queries.iter().map(QuerySettings::query).collect();
        Ok::<Box<dyn Family>, StudyError>(Box::new(Drawn { read, queries }))
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
    shapes: Vec<ShapeName>,
    /// The least distance between the boxes about two obstacles; they may overlap without it.
    gap_cm: Option<f64>,
    /// How far obstacles stay from starts and goals.
    clear_cm: f64,
    /// The queries on every draw: start and goal each.
    queries: Vec<QuerySettings>,
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
        if self.shapes.is_empty() {
            let message = "shapes is empty; at least one of box, prism, octahedron, wedge, pyramid is needed";
            faults.add(settings.error_at("shapes", message));
        }
        let empty = self.world(Vec::new()).map_err(|invalid| settings.error_at("step_cm", invalid.0));
        if let Some(empty) = faults.keep(empty) {
            let queries: Vec<Query> = self.queries.iter().map(QuerySettings::query).collect();
            faults.keep(super::polyhedra_scene::check(settings, &empty, &queries));
        }
        faults.done()
    }

    fn world(&self, bodies: Vec<Convex>) -> Result<PolyhedraWorld, Invalid> {
        let domain = Aabb { min: Vec3::zeros(), max: Vec3::repeat(self.side_cm) };
        PolyhedraWorld::new(bodies, domain, self.step_cm, 0.0).map_err(|e| Invalid(e.to_string()))
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
                let (sides, turn) = (stream.random_range(5..=8), stream.random_range(0.0..1.0));
                Convex::prism(axis, center, size.x / 2.0, size.y, sides, turn)
            }
        };
        made.expect("sizes were checked when the settings were read")
    }

    /// Whether `shape` lies in the cube, off the queries' ends and apart from the others.
    fn fits(&self, shape: &Convex, others: &[Convex]) -> bool {
        let within = shape.aabb().min.min() >= 0.0 && shape.aabb().max.max() <= self.side_cm;
        let ends = self.queries.iter().map(QuerySettings::query).flat_map(|query| [query.start, query.goal]);
        let off = |end: Vec<f64>| {
            let point = Vec3::new(end[0], end[1], end[2]);
            distance_segment_convex(&Segment::new(point, point), shape) > self.clear_cm
        };
        let apart = |gap: f64| others.iter().all(|o| !o.aabb().grown(gap).overlaps(shape.aabb()));
        within && ends.into_iter().all(off) && self.gap_cm.is_none_or(apart)
    }
}

struct Drawn {
    read: RandomPolyhedra,
    queries: Vec<Query>,
}

impl Family for Drawn {
    fn world(&self) -> WorldKind {
        WorldKind::Polyhedra
    }

    fn prepare(&self, seed: u64) -> Result<Prepared, Invalid> {
        let mut stream = seed::stream(seed);
        let [fewest, most] = self.read.count;
        let count = stream.random_range(fewest..=most);
        let mut bodies: Vec<Convex> = Vec::new();
        for number in 0..count {
            let mut draws = (0..TRIES).map(|_| self.read.shape(&mut stream));
            let found = draws.find(|shape| self.read.fits(shape, &bodies));
            let shape = found.ok_or_else(|| {
                Invalid(format!("obstacle {} of {count} found no place in {TRIES} draws", number + 1))
            })?;
            bodies.push(shape);
        }
        Ok(polyhedra::prepare(self.read.world(bodies)?))
    }

    fn queries(&self) -> &[Query] {
        &self.queries
    }
}
