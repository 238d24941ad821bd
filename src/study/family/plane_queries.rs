//! A particle among polygons, with one start and one goal, on roadmaps drawn from a seed.

use super::{Entry, Family, Query};
use crate::StudyError;
use crate::prepared::{Prepared, nested_roadmap};
use crate::verification::roadmap::PLANE_COLUMNS;
use base::seed;
use base::settings::{Accepted, Document, Faults, SettingsError, Spanned};
use base::text::listed;
use engine::geometry::Vec2;
use engine::geometry::planar::ConvexPolygon;
use engine::kinematics::FARTHEST_MM;
use engine::planner::{Exhibit, Invalid};
use engine::space::WorldKind;
use engine::space::roadmap::{Counted, Extent, Local, Near, PlaneMap, Sample};
use rand::RngExt as _;
use schemars::JsonSchema;
use serde::Deserialize;
use std::path::PathBuf;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "plane_queries",
    about: "a particle among polygons, one start and one goal, on roadmaps of free points drawn at random",
    revision: 1,
    is_drawn: true,
    prepared: nested_roadmap::ENTRY.name,
    columns: PLANE_COLUMNS,
    settings: Accepted::of::<PlaneQueries>(),
    example: r#"
map = "data/scenes/fu2018_particle.toml"
samples = 40
radius_mm = 220
"#,
    build: |settings, inputs| {
        let read: PlaneQueries = settings.read()?;
        let file = inputs.locate(&read.map).map_err(|message| settings.error_at("map", message))?;
        let document = Document::open(&file)?;
        let mut faults = Faults::default();
        let Some((map, document)) = document.read_rest::<MapFile>(&mut faults) else {
            return Err(faults.error().into());
        };
        let plane = faults.keep(map.plane(&document));
        let plane = faults.or(plane)?;
        let posed = map.posed(&plane, &document);
        let [start, goal] = [map.start_mm, map.goal_mm].map(|point| point.into_inner().to_vec());
        let queries = [Query { name: String::new(), start, goal }];
        Ok::<Box<dyn Family>, StudyError>(Box::new(Drawn { read, plane, queries, posed, inputs: [file] }))
    },
};

/// Samples lie on this raster, on which the verifier is exact.
const RASTER_MM: f64 = 1.0 / 16.0;

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
}

/// What a file of polygons may hold.
pub const MAP_FILE: Accepted = Accepted::of::<MapFile>();

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct MapFile {
    /// Its name.
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
    /// That the particle can stand at both ends.
    fn posed(&self, plane: &PlaneMap, document: &Document) -> Result<(), SettingsError> {
        let mut faults = Faults::default();
        for (what, end) in [("start", &self.start_mm), ("goal", &self.goal_mm)] {
            if let Some(refusal) = plane.refusal(*end.get_ref()) {
                let message = format!("the {what} cannot be posed: {refusal}");
                faults.add(document.error(end.span(), message));
            }
        }
        faults.done()
    }

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
        if !document.is_part("size_mm") && !self.size_mm.iter().all(|side| side.is_finite() && *side > 0.0) {
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
    queries: [Query; 1],
    posed: Result<(), SettingsError>,
    inputs: [PathBuf; 1],
}

impl Family for Drawn {
    fn world(&self) -> WorldKind {
        WorldKind::Roadmap
    }

    fn prepare(&self, seed: u64) -> Result<Prepared, Invalid> {
        let mut stream = seed::stream(seed);
        let (mut samples, mut draws) = (Vec::new(), 0);
        let [columns, rows] = self.plane.size_mm().map(|side| (side / RASTER_MM) as u32);
        while samples.len() < self.read.samples as usize {
            if draws / 1000 > self.read.samples {
                return Err(Invalid(format!("{} free points were found in {draws} draws", samples.len())));
            }
            let cell = [stream.random_range(0..=columns), stream.random_range(0..=rows)];
            let point = cell.map(|count| f64::from(count) * RASTER_MM);
            if self.plane.refusal(point).is_none() {
                samples.push(Sample { config: point.to_vec(), drawn_after: draws });
            }
            draws += 1;
        }
        let [width, height] = self.plane.size_mm();
        let polygons = self.plane.polygons().iter().enumerate();
        let corners =
            polygons.flat_map(|(i, p)| p.vertices().iter().flat_map(move |v| [i as f64, v.x, v.y])).collect();
        let local = Local::Plane(self.plane.clone());
        let mut prepared = nested_roadmap::prepare(
            local,
            samples,
            draws,
            Near::Places(self.read.radius_mm),
            Counted::Accepted,
        );
        prepared.exhibits.push(Exhibit { name: "size_mm".to_owned(), width: 2, values: vec![width, height] });
        prepared.exhibits.push(Exhibit { name: "obstacles".to_owned(), width: 3, values: corners });
        Ok(prepared)
    }

    fn queries(&self) -> &[Query] {
        &self.queries
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
