//! A particle among polygons, on roadmaps drawn from a seed; start and goal are written, or drawn too.

use super::ends::{Ends, PlaneEnd};
use super::{Entry, Family, Query};
use crate::StudyError;
use crate::preprocessing::{Preprocessing, nested_roadmap};
use crate::verification::roadmap::PLANE_COLUMNS;
use base::seed::{self, Stream};
use base::settings::{Accepted, Document, Faults, Settings, SettingsError, Spanned};
use base::text::listed;
use engine::geometry::Vec2;
use engine::geometry::planar::ConvexPolygon;
use engine::kinematics::FARTHEST_MM;
use engine::planner::{Invalid, Trace};
use engine::space::WorldKind;
use engine::space::roadmap::{Counted, Extent, Local, Near, PlaneMap, RASTER_MM, Sample};
use rand::RngExt as _;
use schemars::JsonSchema;
use serde::Deserialize;
use std::num::NonZeroU32;
use std::path::PathBuf;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "plane_queries",
    about: "a particle among polygons, on roadmaps of free points drawn at random; start and goal are written, or drawn too",
    instances: "roadmaps",
    revision: 1,
    is_drawn: true,
    preprocessing: nested_roadmap::ENTRY.name,
    columns: PLANE_COLUMNS,
    settings: Accepted::shape::<PlaneQueries>(),
    example: r#"
map = "data/scenes/fu2018_particle.toml"
samples = 40
radius_mm = 220
"#,
    build: |settings, inputs| {
        let read: PlaneQueries = settings.read()?;
        let file = inputs.locate(&read.map).map_err(|message| settings.error_at("map", message))?;
        let document = Document::open(&file)?;
        let map: MapFile = document.read()?;
        let plane = map.plane(&document)?;
        let [start, goal] = [
            EndOf { what: "start", key: "start_mm", written: &map.start_mm, over: read.start_mm.as_ref() },
            EndOf { what: "goal", key: "goal_mm", written: &map.goal_mm, over: read.goal_mm.as_ref() },
        ];
        let mut unposed = Faults::default();
        for end in [&start, &goal] {
            unposed.keep(end.posed(&plane, settings, &document));
        }
        let whole = plane.size_mm().map(|side| [0.0, side]);
        let mut faults = Faults::default();
        faults.keep(nested_roadmap::accept_radius(settings, read.radius_mm));
        let mut place = |end: &EndOf<'_>| faults.keep(end.end().place(settings, end.key, whole));
        let (from, to) = (place(&start), place(&goal));
        let (from, to) = faults.or(from.zip(to))?;
        let ends = Ends::new(from, to, read.queries, |key, message| match (key, goal.over) {
            ("goal", None) => document.error(goal.written.span(), message),
            ("goal", Some(_)) => settings.error_at(goal.key, message),
            _ => settings.error_at(key, message),
        })?;
        let drawn = Drawn { ends, posed: unposed.done(), plane, read, inputs: [file] };
        Ok::<Box<dyn Family>, StudyError>(Box::new(drawn))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PlaneQueries {
    /// The map file.
    map: String,
    /// How many samples the roadmap is built from.
    #[schemars(range(min = 1, max = 100_000))]
    samples: u32,
    /// How far two samples may be apart to be tried as neighbours.
    #[schemars(range(min = 0.001, max = FARTHEST_MM))]
    radius_mm: f64,
    /// x and y of the start, in place of the map file's; `drawn` with each instance among free points; or limits
    /// within which it is drawn, as in `{ x = [0, 90], y = 30 }`.
    start_mm: Option<PlaneEnd<f64>>,
    /// The goal, written or drawn as a start is, in place of the map file's.
    goal_mm: Option<PlaneEnd<f64>>,
    /// How many queries an instance has, each with ends of its own; 1 if absent.
    #[schemars(range(max = 10_000))]
    queries: Option<NonZeroU32>,
}

/// An end as the map file writes it, and as the settings do in its place.
struct EndOf<'a> {
    what: &'static str,
    key: &'static str,
    written: &'a Spanned<[f64; 2]>,
    over: Option<&'a PlaneEnd<f64>>,
}

impl EndOf<'_> {
    fn end(&self) -> PlaneEnd<f64> {
        self.over.cloned().unwrap_or(PlaneEnd::Written(*self.written.get_ref()))
    }

    /// That the particle can stand there, if it is written.
    fn posed(&self, plane: &PlaneMap, settings: &Settings, document: &Document) -> Result<(), SettingsError> {
        let PlaneEnd::Written(at) = self.end() else { return Ok(()) };
        let Some(refusal) = plane.refusal(at) else { return Ok(()) };
        let message = format!("the {} cannot be posed: {refusal}", self.what);
        Err(match self.over {
            Some(_) => settings.error_at(self.key, message),
            None => document.error(self.written.span(), message),
        })
    }
}

/// What a file of polygons may hold.
pub const MAP_FILE: Accepted = Accepted::shape::<MapFile>();

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct MapFile {
    /// The map's name, for readers.
    #[expect(dead_code, reason = "a map says its name to readers")]
    name: String,
    /// How wide and how high the plane is.
    size_mm: [f64; 2],
    /// x and y of the start.
    start_mm: Spanned<[f64; 2]>,
    /// x and y of the goal.
    goal_mm: Spanned<[f64; 2]>,
    /// The obstacles: convex polygons.
    #[serde(rename = "obstacle")]
    obstacles: Vec<Spanned<ObstacleEntry>>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct ObstacleEntry {
    /// x and y of each corner, counter-clockwise.
    corners_mm: Vec<[f64; 2]>,
}

impl MapFile {
    fn plane(&self, document: &Document) -> Result<PlaneMap, SettingsError> {
        let polygon = |entry: &Spanned<ObstacleEntry>| {
            let corners = &entry.get_ref().corners_mm;
            let is_fine = |x: &f64| (x / RASTER_MM).fract() == 0.0;
            if !corners.iter().flatten().all(is_fine) {
                let message = "a corner is no multiple of 1/16 mm; such corners are accepted".to_owned();
                return Err(document.error(entry.span(), message));
            }
            let vertices = corners.iter().map(|corner| Vec2::from(*corner)).collect();
            ConvexPolygon::new(vertices).map_err(|e| document.error(entry.span(), e.to_string()))
        };
        let mut faults = Faults::default();
        if !self.size_mm.iter().all(|side| side.is_finite() && *side > 0.0) {
            let message = format!("size_mm is {}; two lengths above 0 are accepted", listed(self.size_mm));
            faults.add(document.error_at("size_mm", message));
        }
        let polygons = faults.keep_each(self.obstacles.iter().map(polygon));
        faults.done()?;
        Ok(PlaneMap::new(self.size_mm, polygons))
    }
}

struct Drawn {
    read: PlaneQueries,
    plane: PlaneMap,
    ends: Ends,
    posed: Result<(), SettingsError>,
    inputs: [PathBuf; 1],
}

impl Drawn {
    /// A free point of the raster within limits, if the one that is drawn is free.
    fn draw_point(&self, stream: &mut Stream, limits: &[[f64; 2]]) -> Option<Vec<f64>> {
        let mut coordinate = |axis: usize| {
            let [low, high] = limits[axis];
            let range = (low / RASTER_MM).ceil() as u32..=(high / RASTER_MM) as u32;
            (!range.is_empty()).then(|| f64::from(stream.random_range(range)) * RASTER_MM)
        };
        let point = [coordinate(0)?, coordinate(1)?];
        self.plane.refusal(point).is_none().then(|| point.to_vec())
    }

    fn drawn(&self, seed: u64) -> Result<Vec<Query>, Invalid> {
        self.ends.drawn(seed, |stream, limits| self.draw_point(stream, limits))
    }
}

impl Family for Drawn {
    fn world(&self) -> WorldKind {
        WorldKind::Roadmap
    }

    fn prepare(&self, seed: u64) -> Result<Preprocessing, Invalid> {
        self.drawn(seed)?;
        let mut stream = seed::stream(seed);
        let mut samples = Vec::new();
        let mut draws = 0;
        let whole = self.plane.size_mm().map(|side| [0.0, side]);
        while samples.len() < self.read.samples as usize {
            if draws / 1000 > self.read.samples {
                return Err(Invalid(format!("{} free points were found in {draws} draws", samples.len())));
            }
            if let Some(config) = self.draw_point(&mut stream, &whole) {
                samples.push(Sample { config, drawn_after: draws });
            }
            draws += 1;
        }
        let [width, height] = self.plane.size_mm();
        let polygons = self.plane.polygons().iter().enumerate();
        let corners =
            polygons.flat_map(|(i, p)| p.vertices().iter().flat_map(move |v| [i as f64, v.x, v.y])).collect();
        let local = Local::Plane(self.plane.clone());
        let mut preprocessing = nested_roadmap::prepare(
            local,
            samples,
            draws,
            Near::Places(self.read.radius_mm),
            Counted::Accepted,
        );
        preprocessing.traces.push(Trace {
            name: "size_mm".to_owned(),
            width: 2,
            values: vec![width, height],
        });
        preprocessing.traces.push(Trace { name: "obstacles".to_owned(), width: 3, values: corners });
        Ok(preprocessing)
    }

    fn queries(&self) -> &[Query] {
        self.ends.queries()
    }

    fn queries_for(&self, seed: u64) -> Vec<Query> {
        self.drawn(seed).unwrap_or_else(|_| self.queries().to_vec())
    }

    fn draws_ends(&self) -> bool {
        self.ends.are_drawn()
    }

    fn check_ends(&self) -> Result<(), SettingsError> {
        self.posed.clone()
    }

    fn cells(&self) -> u64 {
        u64::from(self.read.samples)
    }

    fn extent(&self) -> Option<Extent> {
        Some(nested_roadmap::extent(self.read.samples, Near::Places(self.read.radius_mm), 1.0))
    }

    fn inputs(&self) -> &[PathBuf] {
        &self.inputs
    }
}
