//! How tip, posture or joints change over the time of a motion, one panel a contender.

use super::polyhedra_scene::stored;
use super::{Entry, Kind, Scene, Shown};
use crate::render::RenderError;
use crate::render::chart::marks::Line;
use crate::render::chart::{Axis, Panel, Sheet};
use crate::render::style::{Width, series_stroke};
use crate::study::name;
use crate::study::record::Row;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "motion_curves",
    about: "how tip, posture or joints change over the time of a motion, one panel a contender",
    settings: Accepted::of::<MotionCurves>(),
    example: r#"
problem = "C1"
contenders = ["This method"]
quantity = "joints"
sweep = "delta_deg=10.0"
"#,
    build: |settings, study, _paper| {
        let read: MotionCurves = settings.read()?;
        super::check_labels(settings, study, &read.contenders, [&read.problem])?;
        Ok(Box::new(read))
    },
};

/// Height of a panel's plot, in points.
const PLOT_PT: f64 = 150.0;

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct MotionCurves {
    /// The problem group; its first draw is shown.
    problem: String,
    /// One panel each.
    contenders: Vec<String>,
    /// What is drawn.
    quantity: Quantity,
    /// The value of the sweep, where there is one.
    sweep: Option<String>,
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
        Shown::first(&self.problem, &self.contenders)
    }

    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let note = "Stored configurations follow each other at equal times.";
        let mut sheet = Sheet::new(Width::Double, self.contenders.len(), PLOT_PT).noted(note);
        for contender in &self.contenders {
            let rows = scene.run.rows(&self.problem, contender);
            let is_asked =
                |row: &&Row| self.sweep.as_ref().is_none_or(|sweep| name::sweep(&row.key.sweep) == *sweep);
            let row = rows.into_iter().find(is_asked).ok_or_else(|| RenderError::NotStored {
                what: format!("a trial of `{contender}` on `{}`", self.problem),
            })?;
            sheet.add(self.panel(scene, row)?);
        }
        Ok(sheet)
    }
}

impl MotionCurves {
    fn panel(&self, scene: &Scene<'_>, row: &Row) -> Result<Panel, RenderError> {
        let found = stored(scene.run, &row.key, self.quantity.exhibit())?;
        let count = found.values.len() / found.width;
        let x = Axis::linear("share of the motion's time", 0.0, 1.0)?;
        let y = Axis::over(self.quantity.axis(), found.values.iter().copied());
        let mut panel = Panel::new(row.key.contender.to_string(), x, y);
        for index in 0..found.width {
            let values = found.values.chunks(found.width).map(|point| point[index]).enumerate();
            let points = values.map(|(k, value)| [k as f64 / (count - 1).max(1) as f64, value]).collect();
            panel.add(Line::through(points, series_stroke(index)).labelled(self.quantity.name(index)));
        }
        Ok(panel)
    }
}
