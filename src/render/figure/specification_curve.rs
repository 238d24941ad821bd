//! What readings make of claims: one column a claim, its outcomes above and the options taken below; also as a table.
//!
//! What is drawn stands in each claim's check `across_readings`. The readings stand in rising order of the median.

use super::{Entry, Kind, Scene, check_claim, printed_value};
use crate::analysis::check::{self, Outcome};
use crate::render::RenderError;
use crate::render::chart::legend::cell_key;
use crate::render::chart::marks::{Band, Cells, Line, Points};
use crate::render::chart::{Axis, Panel, Sheet};
use crate::render::latex::{Cell, Column, Table};
use crate::render::style::{
    BLUE, Dash, Fill, GREEN, GREY, INK, Marker, ORANGE, SKY, Stroke, VERMILLION, WHITE, Width,
};
use base::settings::{Accepted, Settings};
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "specification_curve",
    about: "outcomes of claims under every reading explored, with the options taken, and a table of both",
    settings: Accepted::of::<SpecificationCurve>(),
    example: r#"
columns = [
    { claim = "t1.reduction.cost", title = "simple: path cost", axis = "reduction (%)" },
    { claim = "t1.reduction.turn", title = "simple: turn sum", axis = "reduction (%)" },
    { claim = "t1.reduction.nodes", title = "simple: nodes", axis = "reduction (%)", low = -100.0 },
]
"#,
    build: |settings, study, paper| {
        let read: SpecificationCurve = settings.read()?;
        for column in &read.columns {
            check_claim(settings, paper, &column.claim, "across_readings")?;
        }
        let options = study.readings.iter().flat_map(|reading| {
            let others = reading.options.keys().filter(|option| **option != reading.default);
            others
                .chain([&reading.default])
                .map(|option| [reading.id.clone(), option.clone()])
                .collect::<Vec<_>>()
        });
        Ok(Box::new(Curve { options: options.collect(), read, settings: settings.clone() }))
    },
};

/// Height of a panel's plot, in points.
const PLOT_PT: f64 = 178.0;

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct SpecificationCurve {
    /// The columns, one a claim.
    columns: Vec<ColumnSpec>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct ColumnSpec {
    /// The claim, by its id.
    claim: String,
    /// What stands above it.
    title: String,
    /// What stands along the axis.
    axis: String,
    /// Where the axis begins, if what lies below is to be cut off.
    low: Option<f64>,
}

/// What a column without outcomes says; a quick run may have too few maps for any.
const NOTHING: &str = "no reading has enough maps";

/// The axis that outcomes stand along, one unit each; it has room for one where there is none.
fn places(label: &str, outcomes: &[Outcome]) -> Result<Axis, RenderError> {
    Axis::linear(label, -0.5, outcomes.len().max(1) as f64 - 0.5)
}

struct Curve {
    read: SpecificationCurve,
    settings: Settings,
    /// Every reading with each of its options.
    options: Vec<[String; 2]>,
}

impl Curve {
    fn outcomes(&self, scene: &Scene<'_>, column: &ColumnSpec) -> Result<Vec<Outcome>, RenderError> {
        let mut outcomes = check::outcomes(scene.evidence, &self.settings, &column.claim)?;
        outcomes.sort_by(|a, b| a.median.total_cmp(&b.median));
        Ok(outcomes)
    }

    fn curve(scene: &Scene<'_>, spec: &ColumnSpec, outcomes: &[Outcome]) -> Result<Panel, RenderError> {
        let printed = printed_value(scene.evidence, &spec.claim);
        let low = spec.low.unwrap_or(f64::NEG_INFINITY);
        let ends = outcomes.iter().flat_map(|o| [o.central.low, o.central.high]).map(|end| end.max(low));
        let y = Axis::over(&spec.axis, ends.chain(printed));
        if outcomes.is_empty() {
            return Ok(Panel::new(format!("{}: {NOTHING}", spec.title), places("", outcomes)?, y));
        }
        let mut panel = Panel::new(&spec.title, places("", outcomes)?, y);
        let at = |index: usize| index as f64;
        let edges =
            outcomes.iter().enumerate().map(|(i, o)| [at(i), o.central.low, o.central.high]).collect();
        let fill = Fill::solid(SKY.mixed(WHITE, 0.6));
        panel.add(Band { edges, fill, label: "where 95 % of maps lie".to_owned() });
        if let Some(printed) = printed {
            let line = vec![[-0.5, printed], [outcomes.len() as f64 - 0.5, printed]];
            panel.add(
                Line::through(line, Stroke::solid(VERMILLION, 1.1).dashed(Dash::Dashed)).labelled("printed"),
            );
        }
        let medians = outcomes.iter().enumerate().map(|(i, o)| [at(i), o.median]).collect();
        let label = "median over maps".to_owned();
        panel.add(Points { points: medians, marker: Marker::Circle, radius_pt: 1.2, color: BLUE, label });
        let met = |is: fn(&Outcome) -> bool| {
            let met = outcomes.iter().enumerate().filter(move |(_, o)| is(o));
            met.filter_map(|(i, _)| Some([at(i), printed?])).collect::<Vec<_>>()
        };
        let label = "met on a map that was searched for".to_owned();
        let points = met(|o| o.met_searched > 0);
        panel.add(Points { points, marker: Marker::Cross, radius_pt: 2.2, color: ORANGE, label });
        let label = "met on some random map".to_owned();
        let points = met(|o| o.met > 0);
        panel.add(Points { points, marker: Marker::Diamond, radius_pt: 1.8, color: GREEN, label });
        Ok(panel)
    }

    fn matrix(&self, outcomes: &[Outcome], is_first: bool) -> Result<Panel, RenderError> {
        let names = self.options.iter().rev().map(|[reading, option]| {
            if is_first {
                format!("{}: {}", reading.replace('_', " "), option.replace('_', " "))
            } else {
                String::new()
            }
        });
        let x = places("readings, by median", outcomes)?;
        let mut panel = Panel::new("", x, Axis::names("", names.collect::<Vec<_>>()));
        if outcomes.is_empty() {
            return Ok(panel);
        }
        let color = |outcome: &Outcome, [reading, option]: &[String; 2]| {
            (outcome.point.choices()[reading] == *option).then_some(if outcome.is_among {
                INK
            } else {
                GREY.mixed(WHITE, 0.45)
            })
        };
        let rows = self.options.iter().rev();
        let colors = rows.flat_map(|option| outcomes.iter().map(move |outcome| color(outcome, option)));
        panel.add(Cells {
            corner: [-0.5, -0.5],
            cell: [1.0, 1.0],
            columns: outcomes.len(),
            colors: colors.collect(),
            lines: None,
            keys: vec![
                cell_key("option taken, printed number among 95 % of maps", INK),
                cell_key("option taken, printed number not among them", GREY.mixed(WHITE, 0.45)),
            ],
        });
        Ok(panel)
    }
}

impl Kind for Curve {
    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let columns = &self.read.columns;
        let mut sheet = Sheet::new(Width::Double, columns.len(), PLOT_PT).level();
        let all: Vec<Vec<Outcome>> =
            columns.iter().map(|column| self.outcomes(scene, column)).collect::<Result<_, _>>()?;
        for (column, outcomes) in columns.iter().zip(&all) {
            sheet.add(Self::curve(scene, column, outcomes)?);
        }
        for (index, outcomes) in all.iter().enumerate() {
            sheet.add(self.matrix(outcomes, index == 0)?);
        }
        Ok(sheet)
    }

    fn table(&self, scene: &Scene<'_>, label: &str, caption: &str) -> Result<Option<Table>, RenderError> {
        let specs = &self.read.columns;
        let mut kinds = vec![Column::Left, Column::Left];
        kinds.extend(specs.iter().flat_map(|_| [Column::Right; 3]));
        let mut table = Table::new(label, caption, &kinds);
        let mut head = vec![Cell::from(""), Cell::from("")];
        head.extend(specs.iter().map(|spec| Cell::Across(3, spec.title.clone())));
        table.head(head);
        let mut head = vec![Cell::from("reading"), Cell::from("option")];
        head.extend(specs.iter().flat_map(|_| ["less", "among", "met"].map(Cell::from)));
        table.head(head);
        let all: Vec<Vec<Outcome>> =
            specs.iter().map(|column| self.outcomes(scene, column)).collect::<Result<_, _>>()?;
        for [reading, option] in &self.options {
            let mut cells = vec![Cell::from(reading.replace('_', " ")), Cell::from(option.replace('_', " "))];
            for outcomes in &all {
                let taken: Vec<&Outcome> =
                    outcomes.iter().filter(|outcome| outcome.point.choices()[reading] == *option).collect();
                let share = |is: fn(&Outcome) -> bool| {
                    format!("{}/{}", taken.iter().filter(|outcome| is(outcome)).count(), taken.len())
                };
                cells.push(Cell::from(share(|outcome| outcome.median > 0.0)));
                cells.push(Cell::from(share(|outcome| outcome.is_among)));
                cells.push(Cell::from(share(|outcome| outcome.met > 0)));
            }
            table.row(cells);
        }
        table.note(
            "Readings with the option under which most random maps show a reduction at all, under which the printed number \
             lies among the central 95 % of them, and under which it is met exactly on some (maps that were searched for do not \
             count), of the readings with the option that can be judged. An option with none is one under which the verifier \
             refused paths, or too few maps were solved.",
        );
        Ok(Some(table))
    }
}
