//! How tip, posture or joints change over the time of a motion, one panel a contender.

use super::polyhedra_scene::stored;
use super::{Entry, Kind, Scene, Shown, ask};
use crate::render::RenderError;
use crate::render::chart::marks::Line;
use crate::render::chart::{Axis, Panel, Sheet};
use crate::render::style::{Width, series_stroke};
use crate::study::key::SweepKey;
use crate::study::record::Row;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "motion_curves",
    about: "how tip, posture or joints change over the time of a motion, one panel a contender",
    settings: Accepted::of::<Read>(),
    example: r#"
problem = "C1"
contenders = ["This method"]
quantity = "joints"
sweep = "delta_deg=10.0"
"#,
    build: |settings, study, _paper| {
        let read: Read = settings.read()?;
        super::check_labels(settings, study, &read.contenders, [&read.problem])?;
        let sweep = read.sweep.as_ref().map(|text| ask::sweep(settings, study, text)).transpose()?;
        Ok(Box::new(MotionCurves { read, sweep }))
    },
};

/// Height of a panel's plot, in points.
const PLOT_PT: f64 = 150.0;

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Read {
    /// The problem group; its first draw is shown.
    problem: String,
    /// One panel each.
    contenders: Vec<String>,
    /// What is drawn.
    quantity: Quantity,
    /// The sweeps' values of the trial that is shown, as `setting=value,…`; the first trial if absent.
    sweep: Option<String>,
}

struct MotionCurves {
    read: Read,
    /// The point of the sweeps that is shown; the first trial if absent.
    sweep: Option<SweepKey>,
}

#[derive(Deserialize, JsonSchema, Clone, Copy)]
#[serde(rename_all = "snake_case")]
enum Quantity {
    /// The tip's coordinates.
    Tip,
    /// The arm's posture.
    Posture,
    /// The joint angles.
    Joints,
}

impl Quantity {
    fn exhibit(self) -> &'static str {
        match self {
            Self::Tip => "tip_trail",
            Self::Posture => "posture_trail",
            Self::Joints => "path",
        }
    }

    fn axis(self) -> &'static str {
        match self {
            Self::Tip => "tip (cm)",
            Self::Posture => "turn from tool down (rad)",
            Self::Joints => "joint angle (rad)",
        }
    }

    fn name(self, index: usize) -> String {
        match self {
            Self::Tip => ["x", "y", "z"][index].to_owned(),
            Self::Posture => ["about x", "about y", "about z"][index].to_owned(),
            Self::Joints => format!("joint {}", index + 1),
        }
    }
}

impl Kind for MotionCurves {
    fn shown(&self) -> Vec<Shown<'_>> {
        Shown::first(&self.read.problem, &self.read.contenders)
    }

    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let note = "Stored configurations follow each other at equal times.";
        let mut sheet = Sheet::new(Width::Double, self.read.contenders.len(), PLOT_PT).noted(note);
        for contender in &self.read.contenders {
            let rows = scene.run.rows(&self.read.problem, contender);
            let is_asked = |row: &&Row| self.sweep.as_ref().is_none_or(|sweep| row.key.sweep == *sweep);
            let row = rows.into_iter().find(is_asked).ok_or_else(|| RenderError::NotStored {
                what: format!("a trial of `{contender}` on `{}`", self.read.problem),
            })?;
            sheet.add(self.panel(scene, row)?);
        }
        Ok(sheet)
    }
}

impl MotionCurves {
    fn panel(&self, scene: &Scene<'_>, row: &Row) -> Result<Panel, RenderError> {
        let found = stored(scene.run, &row.key, self.read.quantity.exhibit())?;
        let count = found.values.len() / found.width;
        let x = Axis::linear("share of the motion's time", 0.0, 1.0)?;
        let y = Axis::over(self.read.quantity.axis(), found.values.iter().copied());
        let mut panel = Panel::new(row.key.contender.to_string(), x, y);
        for index in 0..found.width {
            let values = found.values.chunks(found.width).map(|point| point[index]).enumerate();
            let points = values.map(|(k, value)| [k as f64 / (count - 1).max(1) as f64, value]).collect();
            panel.add(Line::through(points, series_stroke(index)).labelled(self.read.quantity.name(index)));
        }
        Ok(panel)
    }
}
