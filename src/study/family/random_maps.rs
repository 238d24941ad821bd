//! The settings that random maps of all kinds share.
//!
//! A start or goal that is written is freed after everything else was drawn. One that is drawn lies on a cell that is
//! free.

use super::ends::{Ends, PlaneEnd};
use super::{Entry, Family, Query};
use crate::StudyError;
use crate::preprocessing::{Preprocessing, lattice};
use crate::verification::LATTICE_COLUMNS;
use base::grid::{CornerRule, Grid2, GridError, Vertices, corner_vertices};
use base::seed::{self, Stream};
use base::settings::{Accepted, Faults, Settings, SettingsError};
use engine::planner::Invalid;
use engine::space::{LatticeWorld, World, WorldKind};
use rand::RngExt as _;
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use std::num::NonZeroU32;

/// The entry of one kind of map.
pub(super) const fn entry<O: Obstacles>(
    name: &'static str,
    about: &'static str,
    example: &'static str,
) -> Entry {
    Entry {
        name,
        about,
        instances: "maps",
        revision: 1,
        is_drawn: true,
        preprocessing: lattice::ENTRY.name,
        columns: LATTICE_COLUMNS,
        settings: Accepted::shape::<O>(),
        example,
        build: |settings, _inputs| RandomMaps::<O>::build(settings),
    }
}

/// Settings that have a frame.
pub(super) trait Framed: DeserializeOwned + JsonSchema + Send + Sync + 'static {
    fn frame(&self) -> Frame<'_>;
}

/// Obstacles of one kind.
pub(super) trait Obstacles: Framed {
    /// A map with cells that are kept free.
    fn map(&self, stream: &mut Stream, keep_free: &[u32]) -> Result<Grid2, GridError>;

    /// How many cells a map's obstacles have at most, each counted by itself.
    fn blocked(&self) -> u64;

    fn check(&self, settings: &Settings) -> Result<(), SettingsError>;

    /// How many rows along each side a start or goal that is drawn keeps off.
    fn rows_off(&self) -> u32 {
        0
    }
}

/// What maps of all kinds have.
pub(super) struct Frame<'a> {
    pub(super) size_cells: [u32; 2],
    pub(super) start: &'a PlaneEnd<u32>,
    pub(super) goal: &'a PlaneEnd<u32>,
    pub(super) queries: Option<NonZeroU32>,
    pub(super) corner_rule: CornerRule,
    pub(super) vertices: Vertices,
}

/// How large a map is.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "the side of a square, or columns and rows, are accepted")]
pub(super) enum Size {
    /// The side of a square.
    Square(#[schemars(range(max = 65_535))] u32),
    /// Columns and rows.
    Sides(#[schemars(inner(range(max = 65_535)))] [u32; 2]),
}

impl Size {
    /// Columns and rows.
    pub(super) fn sides(self) -> [u32; 2] {
        match self {
            Self::Square(side) => [side; 2],
            Self::Sides(sides) => sides,
        }
    }
}

/// Settings of one kind of map: those of the frame, and its own.
macro_rules! settings {
    ($name:ident { $($own:tt)* }) => {
        #[derive(Debug, Clone, serde::Deserialize, schemars::JsonSchema)]
        #[serde(deny_unknown_fields)]
        struct $name {
            /// Columns and rows of the map, or one number if it is square.
            size_cells: $crate::family::random_maps::Size,
            /// The column and row of the start cell, counted from 0 at the lower left; `drawn` with each instance
            /// among free cells; or limits within which it is drawn, as in `{ x = [0, 9], y = 3 }`.
            start: $crate::family::ends::PlaneEnd<u32>,
            /// The goal cell, written or drawn as a start is.
            goal: $crate::family::ends::PlaneEnd<u32>,
            /// How many queries an instance has, each with ends of its own; 1 if absent.
            #[schemars(range(max = 10_000))]
            queries: Option<std::num::NonZeroU32>,
            /// When a diagonal move past blocked cells is allowed.
            corner_rule: base::grid::CornerRule,
            /// Where the vertices are that paths lead over; `centres` of cells if absent. At `corners`, a start or goal [x, y] is the
            /// lower left corner of that cell, which is freed if it is written. The last column and row of corners are the right and upper
            /// edge: a map of 100 cells has corners 0 to 100.
            vertices: Option<base::grid::Vertices>,
            $($own)*
        }

        impl $crate::family::random_maps::Framed for $name {
            fn frame(&self) -> $crate::family::random_maps::Frame<'_> {
                let Self { start, goal, queries, corner_rule, vertices, .. } = self;
                let size_cells = self.size_cells.sides();
                let queries = *queries;
                let corner_rule = *corner_rule;
                let vertices = vertices.unwrap_or_default();
                $crate::family::random_maps::Frame { size_cells, start, goal, queries, corner_rule, vertices }
            }
        }
    };
}
pub(super) use settings;

/// Refuses a range of whole numbers of cells that is empty or starts at 0.
pub(super) fn check_range(
    settings: &Settings,
    key: &str,
    [least, most]: [u32; 2],
) -> Result<(), SettingsError> {
    if 0 < least && least <= most {
        return Ok(());
    }
    let message = format!("{key} is [{least}, {most}]; [least, most] with 1 ≤ least ≤ most is accepted");
    Err(settings.error_at(key, message))
}

/// Where queries on a map of this size start and end; those that are drawn keep off so many rows along each side.
///
/// # Errors
/// Ends and limits outside the map; limits that leave no row; those of [`Ends::new`].
pub(super) fn ends_on(
    settings: &Settings,
    size_cells: [u32; 2],
    vertices: Vertices,
    [start, goal]: [&PlaneEnd<u32>; 2],
    queries: Option<NonZeroU32>,
    rows_off: u32,
) -> Result<Ends, SettingsError> {
    let (more, all) = if vertices == Vertices::Corners { (1, "corners") } else { (0, "cells") };
    let [width, height] = size_cells.map(|side| side + more);
    let plane = [width, height].map(|side| [0.0, f64::from(side) - 1.0]);
    let mut faults = Faults::default();
    let [start, goal] = [("start", start), ("goal", goal)].map(|(key, end)| {
        let outside = |x: &u32, y: &u32| {
            let message = format!(
                "{key} is [{x}, {y}], outside the map; {all} from [0, 0] to [{}, {}] are accepted",
                width - 1,
                height - 1
            );
            settings.error_at(key, message)
        };
        faults.keep(match end {
            PlaneEnd::Written([x, y]) if *x >= width || *y >= height => Err(outside(x, y)),
            end => end.place(settings, key, plane).and_then(|place| {
                let rows = [f64::from(rows_off), f64::from(size_cells[1]) - 1.0 - f64::from(rows_off)];
                let nowhere = || settings.error_at(key, format!("{key} has no row left inside the border"));
                if rows_off == 0 { Ok(place) } else { place.in_rows(rows).ok_or_else(nowhere) }
            }),
        })
    });
    let (start, goal) = faults.or(start.zip(goal))?;
    Ends::new(start, goal, queries, |key, message| settings.error_at(key, message))
}

/// A free vertex within limits of its column and row, if the one that is drawn is free.
pub(super) fn draw_vertex(grid: &Grid2, stream: &mut Stream, limits: &[[f64; 2]]) -> Option<Vec<f64>> {
    let at = [0, 1].map(|axis: usize| stream.random_range(limits[axis][0] as i32..=limits[axis][1] as i32));
    let cell = grid.cell(at[0], at[1])?;
    grid.is_free(cell).then(|| at.map(f64::from).to_vec())
}

/// A family of random maps of one size.
struct RandomMaps<O> {
    read: O,
    ends: Ends,
    keep_free: Vec<u32>,
}

impl<O: Obstacles> RandomMaps<O> {
    fn build(settings: &Settings) -> Result<Box<dyn Family>, StudyError> {
        let read: O = settings.read()?;
        let Frame { size_cells, start, goal, queries, corner_rule, vertices } = read.frame();
        let mut faults = Faults::default();
        faults.keep(read.check(settings));
        faults.keep(lattice::check_rule(settings, corner_rule, vertices));
        let empty = Grid2::new(size_cells[0], size_cells[1])
            .map_err(|e| settings.error_at("size_cells", format!("size_cells: {e}")));
        let empty = faults.keep(empty);
        let ends = empty.as_ref().and_then(|_| {
            let ends = [start, goal];
            faults.keep(ends_on(settings, size_cells, vertices, ends, queries, read.rows_off()))
        });
        let (empty, ends) = faults.or(empty.zip(ends))?;
        // The last column and row of corners belong to the cells before them.
        let within = |at: f64, side: u32| (at as i32).min(side as i32 - 1);
        let [width, height] = size_cells;
        let cell = |at: &[f64]| {
            empty.cell(within(at[0], width), within(at[1], height)).expect("ends lie on the map")
        };
        let keep_free = ends.written().map(cell).collect();
        Ok(Box::new(Self { read, ends, keep_free }))
    }

    fn map(&self, seed: u64) -> Grid2 {
        self.read
            .map(&mut seed::stream(seed), &self.keep_free)
            .expect("the size was checked when the settings were read")
    }

    fn world_of(&self, seed: u64) -> LatticeWorld {
        let Frame { corner_rule, vertices, .. } = self.read.frame();
        lattice::world(self.map(seed), corner_rule, vertices)
    }

    fn queries_on(&self, vertices: &Grid2, seed: u64) -> Result<Vec<Query>, Invalid> {
        self.ends.drawn(seed, |stream, limits| draw_vertex(vertices, stream, limits))
    }
}

impl<O: Obstacles> Family for RandomMaps<O> {
    fn world(&self) -> WorldKind {
        lattice::kind(self.read.frame().vertices)
    }

    fn prepare(&self, seed: u64) -> Result<Preprocessing, Invalid> {
        let world = self.world_of(seed);
        let queries = self.queries_on(world.grid(), seed)?;
        lattice::prepare(world, queries.iter().map(Query::ends))
    }

    fn draw(&self, seed: u64) -> Result<World, Invalid> {
        // A written start and goal are freed, so that no map is invalid.
        Ok(World::Lattice(self.world_of(seed)))
    }

    fn queries(&self) -> &[Query] {
        self.ends.queries()
    }

    fn queries_for(&self, seed: u64) -> Vec<Query> {
        if !self.draws_ends() {
            return self.queries().to_vec();
        }
        // An instance whose ends cannot be drawn is refused by `prepare`; its queries are never planned.
        let mut vertices = self.map(seed);
        if self.read.frame().vertices == Vertices::Corners {
            vertices = corner_vertices(&vertices);
        }
        self.queries_on(&vertices, seed).unwrap_or_else(|_| self.queries().to_vec())
    }

    fn draws_ends(&self) -> bool {
        self.ends.are_drawn()
    }

    fn cells(&self) -> u64 {
        self.read.frame().size_cells.map(u64::from).iter().product::<u64>() + self.read.blocked()
    }
}
