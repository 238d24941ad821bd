//! Distributions of our instances, with the printed number marked: one panel a claim.
//!
//! What is drawn stands in each claim's check `one_instance`.

use super::{Entry, Kind, Scene};
use crate::analysis::context::Context;
use crate::analysis::criterion;
use crate::analysis::shown::Distribution;
use crate::render::RenderError;
use crate::render::canvas::{Align, Stand, Type};
use crate::render::chart::marks::{Line, Note};
use crate::render::chart::rules::Rules;
use crate::render::chart::{Axis, Panel, Sheet};
use crate::render::style::{INK, Stroke, TextSize, Width, series_color, series_stroke};
use base::settings::{Accepted, Settings, SettingsError, none_called};
use schemars::JsonSchema;
use serde::Deserialize;
use study::paper::{Claim, Paper};

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "instances",
    about: "cumulative distributions of our instances with the printed number marked, one panel a claim",
    statistic: "Outer hundredths cut; {n}.",
    settings: Accepted::shape::<Instances>(),
    example: r#"
columns = 4
panels = [
    { claim = "t1.reduction.time", title = "simple: planning time", axis = "reduction (%)" },
    { claim = "t1.reduction.cost", title = "simple: path cost", axis = "reduction (%)" },
    { claim = "t1.reduction.turn", title = "simple: turn sum", axis = "reduction (%)" },
    { claim = "t1.reduction.nodes", title = "simple: nodes", axis = "reduction (%)" },
    { claim = "t2.reduction.time", title = "complex: planning time", axis = "reduction (%)" },
    { claim = "t2.reduction.cost", title = "complex: path cost", axis = "reduction (%)" },
    { claim = "t2.reduction.turn", title = "complex: turn sum", axis = "reduction (%)" },
    { claim = "t2.reduction.nodes", title = "complex: nodes", axis = "reduction (%)" },
]
"#,
    build: |settings, _study, paper| {
        let read: Instances = settings.read()?;
        for panel in &read.panels {
            claim_of_panel(settings, paper, &panel.claim)?;
        }
        Ok(Box::new(InstancesFigure { read, settings: settings.clone() }))
    },
};

/// Height of a panel's plot, in points.
const PLOT_PT: f64 = 118.0;

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Instances {
    /// The panels, in their order.
    panels: Vec<PanelSpec>,
    /// How many panels stand beside each other.
    #[schemars(range(min = 1, max = 12))]
    columns: usize,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PanelSpec {
    /// The claim, by its id.
    claim: String,
    /// What stands above it.
    title: String,
    /// What stands along the axis.
    axis: String,
}

struct InstancesFigure {
    read: Instances,
    settings: Settings,
}

impl Kind for InstancesFigure {
    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let panels = self.read.panels.iter().map(|panel| self.panel(scene, panel));
        Sheet::new(Width::Double, self.read.columns, PLOT_PT).with(panels)
    }
}

impl InstancesFigure {
    fn panel(&self, scene: &Scene<'_>, spec: &PanelSpec) -> Result<Panel, RenderError> {
        let paper = scene.evidence.paper;
        let point = &scene.evidence.point;
        let claim = claim_of_panel(&self.settings, paper, &spec.claim)?;
        let context = Context { claim, settings: &self.settings, paper, point };
        let sets = criterion::instances(&context, scene.evidence)?;
        let printed = context.print().ok().map(|print| print.printed.value());
        let found: Vec<_> = sets.iter().map(|set| Distribution::new(&set.values)).collect();
        // The outermost hundredth on either side would squeeze all the rest.
        let bulk = found.iter().flat_map(|found| found.bulk.iter().copied());
        let x = Axis::over(&spec.axis, bulk.chain(printed));
        let corner = [x.ends()[0], 1.0];
        let mut panel = Panel::new(&spec.title, x, Axis::linear("share of maps", 0.0, 1.0)?);
        for (index, (set, found)) in sets.iter().zip(found).enumerate() {
            panel.add(Line::through(found.steps, series_stroke(index)).labelled(&set.label));
            panel.add(how_many(corner, index, set.values.len()));
        }
        if let Some(printed) = printed {
            let marks = vec![(printed, format!("printed {printed}"))];
            panel.add(Rules { marks, stroke: Stroke::solid(INK, 1.0) });
        }
        Ok(panel)
    }
}

/// How many instances stand behind a curve, in its ink: no cumulative curve comes near the upper left corner.
fn how_many(corner: [f64; 2], index: usize, instances: usize) -> Note {
    let set = Type::regular(TextSize::TICK).aligned(Align::Start, Stand::Centre);
    let set = Type { color: series_color(index), rim: true, ..set };
    let down_pt = (index as f64 + 1.0) * 1.25 * TextSize::TICK.pt();
    Note { at: corner, shift_pt: [3.0, down_pt], text: format!("n = {instances}"), set }
}

/// The claim called `id`, whose criterion `one_instance` says what is to be shown.
fn claim_of_panel<'p>(settings: &Settings, paper: &'p Paper, id: &str) -> Result<&'p Claim, SettingsError> {
    let known = paper.claims.iter().map(|claim| claim.id.as_str());
    let missing = || settings.error_about("", &["claim"], id, none_called("claim", id, known)).about("id");
    let claim = paper.claim(id).ok_or_else(missing)?;
    if claim.criteria().any(|(own, _)| own == "one_instance") {
        return Ok(claim);
    }
    let message = format!("claim `{id}` has no criterion `one_instance`, which says what is to be shown");
    Err(settings.error_about("", &["claim"], id, message))
}
