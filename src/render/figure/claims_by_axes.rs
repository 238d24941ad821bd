//! What each reading of a paper does to each of its claims when it alone departs from its default.

use super::{Entry, Kind, Scene};
use crate::analysis::verdict::{Across, Effect, Judged};
use crate::render::RenderError;
use crate::render::chart::legend::cell_key;
use crate::render::chart::marks::Cells;
use crate::render::chart::{Axis, Panel, Sheet};
use crate::render::style::{BLUE, GREY, GRID, Rgb, Stroke, VERMILLION, WHITE, Width, YELLOW};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "claims_by_axes",
    about: "which reading moves which claim: the greatest effect of an axis's voting options, one at a time",
    statistic: "Of options that vote, one at a time beside the defaults; of several in one cell the greatest effect; what nothing moves is \
                left out; {readings}.",
    settings: Accepted::of::<ClaimsByAxes>(),
    example: "",
    build: |settings, _study, _paper| Ok(Box::new(settings.read::<ClaimsByAxes>()?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct ClaimsByAxes {}

/// Height of a row, in points.
const ROW_PT: f64 = 9.5;

/// What an effect is called and drawn as, the least first.
const LOOKS: [(Effect, &str, Rgb); 4] = [
    (Effect::Number, "moves the number", GRID),
    (Effect::Class, "changes the class, not the direction", YELLOW),
    (Effect::Opens, "opens or decides it", BLUE),
    (Effect::Turns, "turns it", VERMILLION),
];

fn color(across: &Across, axis: &str) -> Option<Rgb> {
    let effect = across.effects.get(axis)?.effect;
    LOOKS.iter().find(|(own, ..)| *own == effect).map(|(_, _, color)| color.mixed(WHITE, 0.25))
}

impl ClaimsByAxes {
    /// The sentences and rows that readings can touch, from above.
    fn rows<'s>(scene: &'s Scene<'_>) -> Vec<(&'s Judged, &'s Across)> {
        let moved = |judged: &'s Judged| {
            let across = judged.across.as_ref().filter(|across| !across.effects.is_empty())?;
            Some((judged, across))
        };
        scene.verdicts.claims.iter().filter(|judged| judged.part_of.is_none()).filter_map(moved).collect()
    }
}

impl Kind for ClaimsByAxes {
    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let rows = Self::rows(scene);
        let readings = scene.evidence.paper.readings();
        let is_moving = |id: &&str| rows.iter().any(|(_, across)| across.effects.contains_key(*id));
        let axes: Vec<&str> = readings.iter().map(|reading| reading.id.as_str()).filter(is_moving).collect();
        if rows.is_empty() || axes.is_empty() {
            // A quick run, or one whose readings were not explored, has nothing to show; that is no fault of the figure's.
            return Ok(Sheet::new(Width::Double, 1, ROW_PT).titled("No explored reading moves a claim."));
        }
        let columns = axes.iter().copied();
        let named = |(judged, _): &(&Judged, &Across)| format!("{}: {}", judged.claim, judged.outcome());
        let names: Vec<String> = rows.iter().rev().map(named).collect();
        let mut panel = Panel::new("", Axis::names("", columns), Axis::names("", names));
        let of_row = |(_, across): &(&Judged, &Across)| {
            axes.iter().map(|axis| color(across, axis)).collect::<Vec<_>>()
        };
        panel.add(Cells {
            corner: [-0.5, -0.5],
            cell: [1.0, 1.0],
            columns: axes.len(),
            colors: rows.iter().rev().flat_map(of_row).collect(),
            lines: Some(Stroke::solid(GREY.mixed(WHITE, 0.6), 0.4)),
            keys: LOOKS.map(|(_, label, color)| cell_key(label, color.mixed(WHITE, 0.25))).to_vec(),
        });
        let height = rows.len() as f64 * ROW_PT + 2.0 * ROW_PT;
        Sheet::new(Width::Double, 1, height).with([Ok(panel)])
    }
}
