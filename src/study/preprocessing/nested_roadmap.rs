//! A roadmap whose first N samples are a roadmap too, with what became of every pair it tried; neighbours are near by their places
//! or by their configurations.

use super::{Entry, Preprocessing};
use base::settings::{Settings, SettingsError};
use base::units::{seems_in_metres, setting_in_radians};
use engine::planner::{Counts, Trace, Value};
use engine::space::World;
use engine::space::cell::Rejection;
use engine::space::roadmap::{Counted, Extent, Local, Near, Roadmap, Sample};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "nested_roadmap",
    about: "samples in the order they were drawn and the local paths between them; smaller sizes and radii are read off",
    columns: &[
        "samples",
        "draws",
        "pairs",
        "edges",
        "components",
        "checked_states",
        "rejected_branch",
        "rejected_turn",
        "rejected_unreachable",
        "rejected_limits",
        "rejected_jump",
        "rejected_speed",
        "rejected_end",
        "rejected_contact",
    ],
};

/// The column that counts pairs rejected for `reason`.
fn column(reason: Rejection) -> &'static str {
    match reason {
        Rejection::Branch => "rejected_branch",
        Rejection::Turn => "rejected_turn",
        Rejection::Unreachable => "rejected_unreachable",
        Rejection::Limits => "rejected_limits",
        Rejection::Jump => "rejected_jump",
        Rejection::Speed => "rejected_speed",
        Rejection::End => "rejected_end",
        Rejection::Contact => "rejected_contact",
    }
}

/// Two joints that turn all the way round need neighbours at 2.2° for one connected roadmap of 100 000 samples, the most that are
/// accepted: `360° √(ln n / π n)`. More joints need them farther apart.
///
/// # Source
/// Penrose, *Random Geometric Graphs* (2003), ch. 13: the radius at which such a graph is connected.
const LEAST_DEG: f64 = 2.0;

/// What settings say of neighbours, each perhaps.
#[derive(Debug, Clone, Copy)]
pub struct Neighbours {
    /// How far apart their places may be.
    pub radius_mm: Option<f64>,
    /// How far apart their configurations may be.
    pub radius_deg: Option<f64>,
    /// How many nearest configurations are a sample's neighbours.
    pub nearest: Option<u32>,
}

impl Neighbours {
    /// The rule, with `times` the `radius_mm`.
    ///
    /// # Errors
    /// None or several are given; `radius_mm` seems to be in metres, or `radius_deg` in radians.
    pub fn rule(self, settings: &Settings, times: f64) -> Result<Near, SettingsError> {
        match (self.radius_mm, self.radius_deg, self.nearest) {
            (Some(radius_mm), None, None) => {
                accept_radius(settings, radius_mm)?;
                Ok(Near::Places(radius_mm * times))
            }
            (None, Some(radius_deg), None) => {
                let in_radians = setting_in_radians("radius_deg", radius_deg, LEAST_DEG);
                settings.accept_without("radius_deg", in_radians)?;
                Ok(Near::Configurations(radius_deg.to_radians()))
            }
            (None, None, Some(nearest)) => Ok(Near::Nearest(nearest as usize)),
            _ => Err(settings.error("exactly one of radius_mm, radius_deg and nearest is accepted")),
        }
    }
}

/// That a `radius_mm` does not seem to be in metres.
///
/// # Errors
/// It does.
pub fn accept_radius(settings: &Settings, radius_mm: f64) -> Result<(), SettingsError> {
    settings.accept_without("radius_mm", seems_in_metres("radius_mm", radius_mm))
}

/// How large a roadmap of so many samples is that is built up to `times` its unit.
pub fn extent(samples: u32, near: Near, times: f64) -> Extent {
    let radius_mm = if let Near::Places(radius_mm) = near { Some(radius_mm) } else { None };
    Extent { samples, radius_mm, times: radius_mm.map(|_| times) }
}

/// The roadmap of `samples`, joined with those that are `near`.
pub fn prepare(
    local: Local,
    samples: Vec<Sample>,
    draws: u32,
    near: Near,
    counted: Counted,
) -> Preprocessing {
    let roadmap = Roadmap::build(local, samples, near, counted);
    let tally = *roadmap.tally();
    let count = roadmap.samples().len();
    let parts = roadmap.components(count as u32, roadmap.radius_mm());
    let components = parts.iter().zip(0..).filter(|(part, node)| *part == node).count();
    let mut values = Counts::from([
        ("samples", Value::Count(count as u64)),
        ("draws", Value::Count(u64::from(draws))),
        ("pairs", Value::Count(tally.pairs)),
        ("edges", Value::Count(tally.edges)),
        ("components", Value::Count(components as u64)),
        ("checked_states", Value::Count(tally.checked)),
    ]);
    for (reason, rejected) in Rejection::ALL.into_iter().zip(tally.rejected) {
        values.insert(column(reason), Value::Count(rejected));
    }
    let traces = match roadmap.local() {
        Local::Plane(_) => plane_traces(&roadmap),
        Local::Arm(_) | Local::Joints(_) => Vec::new(),
    };
    Preprocessing { world: World::Roadmap(Box::new(roadmap)), values, traces }
}

/// What a picture of a roadmap in the plane needs: samples and edges.
fn plane_traces(roadmap: &Roadmap) -> Vec<Trace> {
    let places = roadmap.samples().iter().flat_map(|sample| sample.config.clone()).collect();
    let mut edges = Vec::new();
    for node in 0..roadmap.samples().len() as u32 {
        let links = roadmap.links(node);
        edges.extend(
            links.iter().filter(|(to, _)| *to < node).flat_map(|(to, _)| [f64::from(*to), f64::from(node)]),
        );
    }
    vec![
        Trace { name: "samples".to_owned(), width: 2, values: places },
        Trace { name: "edges".to_owned(), width: 2, values: edges },
    ]
}
