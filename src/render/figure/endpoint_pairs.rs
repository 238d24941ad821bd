//! Where pairs of end points lie that have printed lengths.

use super::{Entry, Kind, Scene, Shown, ask};
use crate::render::RenderError;
use crate::render::chart::marks::{Line, Points};
use crate::render::chart::{Axis, Panel, Sheet, Trim};
use crate::render::style::{Marker, Stroke, WHITE, Width, series_color};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "endpoint_pairs",
    about: "where pairs of end points lie that have the printed lengths, one series a variant",
    statistic: "Every pair that was found; nothing is left out.",
    settings: Accepted::shape::<EndpointPairs>(),
    example: r#"
problem = "workspace"
panels = [
    { title = "one shape for all", variants = ["circles", "squares", "hexagons", "triangles"] },
    { title = "any shape for each", variants = ["each obstacle of any shape"] },
]
"#,
    build: |settings, study, _paper| {
        let read: EndpointPairs = settings.read()?;
        ask::known(settings, study, [&read.problem], [])?;
        Ok(Box::new(read))
    },
};

/// Starts with their goals.
type Pairs = Vec<[[f64; 2]; 2]>;

/// Height of a panel's plot, in points.
const PLOT_PT: f64 = 190.0;

/// Most panels that stand beside each other.
const COLUMNS: usize = 3;

/// Radius of a marker, in points: ends a centimetre apart do not hide each other.
const RADIUS_PT: f64 = 1.3;

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct EndpointPairs {
    /// The problem group.
    problem: String,
    /// The panels, in their order.
    panels: Vec<PanelSetting>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PanelSetting {
    /// What stands above it.
    title: String,
    /// Labels of the variants shown.
    variants: Vec<String>,
}

impl Kind for EndpointPairs {
    fn shown(&self) -> Vec<Shown<'_>> {
        Shown::preprocessing(&self.problem)
    }

    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let mut sheet = Sheet::new(Width::Double, self.panels.len().min(COLUMNS), PLOT_PT);
        let mut first = 0;
        for setting in &self.panels {
            let mut series = Vec::new();
            for label in &setting.variants {
                // A quick run may leave out variants that take long.
                if scene.run.manifest.quick && scene.run.rows(&self.problem, label).is_empty() {
                    continue;
                }
                let row = ask::trial(scene, &self.problem, 0, None, label)?;
                let found = ask::trace(scene, &row.key, "pairs")?;
                let pairs = found.values.chunks(4).map(|p| [[p[0], p[1]], [p[2], p[3]]]);
                series.push((label, pairs.collect::<Pairs>()));
            }
            if !series.is_empty() {
                sheet.add(panel(&setting.title, first, &series)?);
                first += series.len();
            }
        }
        Ok(sheet)
    }
}

/// One panel, its series coloured from number `first` on.
fn panel(title: &str, first: usize, series: &[(&String, Pairs)]) -> Result<Panel, RenderError> {
    let count: usize = series.iter().map(|(_, pairs)| pairs.len()).sum();
    let (x, y) = (Axis::linear("x (cm)", -10.0, 55.0)?, Axis::linear("y (cm)", 0.0, 52.0)?);
    let mut panel = Panel::new(format!("{title}: {count} pair{}", if count == 1 { "" } else { "s" }), x, y)
        .trimmed(Trim::Grid)
        .with_equal_scales();
    for (index, (_, pairs)) in (first..).zip(series) {
        for pair in pairs {
            let pale = Stroke::solid(series_color(index).mixed(WHITE, 0.6), 0.5);
            panel.add(Line::through(pair.to_vec(), pale));
        }
    }
    for (place, (label, pairs)) in series.iter().enumerate() {
        let index = first + place;
        // Several series may share points: the first ones are larger and show behind the last.
        let radius_pt = RADIUS_PT + 0.9 * (series.len() - 1 - place) as f64;
        let of_end = |end: usize| pairs.iter().map(|pair| pair[end]).collect::<Vec<_>>();
        // The caption says what a diamond is: a line of the legend for each would come apart from its circle's.
        let one = Points::unlabelled(of_end(0), Marker::Circle, radius_pt, series_color(index));
        let is_titled = series.len() == 1;
        let said = if is_titled { String::new() } else { format!("{label} ({})", pairs.len()) };
        panel.add(one.labelled(said));
        panel.add(Points::unlabelled(of_end(1), Marker::Diamond, radius_pt, series_color(index)));
    }
    Ok(panel)
}
