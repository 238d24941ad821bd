//! How a search on a grid map went on: the cells opened so far, one panel a moment.

use super::grid_search::{add_ends, blocked, centres, goal_side, listed, map, painted, start_side};
use super::{Entry, Kind, Scene, Shown, check_labels};
use crate::render::RenderError;
use crate::render::chart::legend::cell_key;
use crate::render::chart::marks::{Line, Points};
use crate::render::chart::{Panel, Sheet};
use crate::render::style::{BLUE, Marker, PURPLE, Stroke, Width};
use crate::study::record::Row;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "search_flow",
    about: "how a search on a grid map went on: the cells opened so far, one panel a moment",
    settings: Accepted::of::<SearchFlow>(),
    example: r#"
problem = "W1"
contender = "A*"
shares = [0.15, 0.5, 1.0]
"#,
    build: |settings, study, _paper| {
        let read: SearchFlow = settings.read()?;
        check_labels(settings, study, [&read.contender], [&read.problem])?;
        if read.shares.is_empty() || read.shares.iter().any(|share| !(0.0..=1.0).contains(share)) {
            return Err(
                settings.error_at("shares", "shares of opened cells from 0 to 1 are accepted, one a panel")
            );
        }
        Ok(Box::new(read))
    },
};

/// Height of a panel's plot, in points.
const PLOT_PT: f64 = 150.0;

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct SearchFlow {
    /// The problem group; its first draw is shown.
    problem: String,
    /// The contender, by its label.
    contender: String,
    /// Which share of all opened cells each panel shows.
    shares: Vec<f64>,
}

impl Kind for SearchFlow {
    fn shown(&self) -> Vec<Shown<'_>> {
        Shown::first(&self.problem, std::slice::from_ref(&self.contender))
    }

    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let rows = scene.run.rows(&self.problem, &self.contender);
        let row = rows.first().ok_or_else(|| RenderError::NotStored {
            what: format!("a trial of `{}` on `{}`", self.contender, self.problem),
        })?;
        let mut sheet = Sheet::new(Width::Double, self.shares.len(), PLOT_PT);
        for share in &self.shares {
            sheet.add(panel(scene, row, *share)?);
        }
        Ok(sheet)
    }
}

fn panel(scene: &Scene<'_>, row: &Row, share: f64) -> Result<Panel, RenderError> {
    let exhibit = |name: &str| scene.run.exhibit(&row.key, name);
    let sides = ["opened_start_side", "opened_goal_side"].map(|name| listed(exhibit(name)));
    let shown = sides.each_ref().map(|side| (side.len() as f64 * share).ceil() as usize);
    let all: usize = sides.iter().map(Vec::len).sum();
    let title = format!("{} of {all} nodes opened", shown.iter().sum::<usize>());
    let map = map(scene, row)?;
    let around: Vec<[f64; 2]> = sides.concat().into_iter().map(|[x, y]| [x + 0.5, y + 0.5]).collect();
    let mut panel = map.panel_about(title, &around)?;
    let [start, goal] = [0, 1].map(|side: usize| sides[side][..shown[side]].to_vec());
    let mut keys = vec![cell_key("blocked", blocked()), cell_key("opened from the start", start_side())];
    if !sides[1].is_empty() {
        keys.push(cell_key("opened from the goal", goal_side()));
    }
    panel.add(painted(&map, &[(goal, goal_side()), (start, start_side())], keys));
    let path = exhibit("raw_path").or_else(|| exhibit("path"));
    let path = path.map(centres).unwrap_or_default();
    if share >= 1.0 {
        panel.add(Line::through(path.clone(), Stroke::solid(BLUE, 1.4)).labelled("path found"));
        let met: Vec<[f64; 2]> = exhibit("meeting").map(centres).unwrap_or_default();
        if !met.is_empty() {
            let (marker, label) = (Marker::Square, "where the sides met".to_owned());
            panel.add(Points { points: met, marker, radius_pt: 3.0, color: PURPLE, label });
        }
    }
    add_ends(&mut panel, &path);
    Ok(panel)
}
