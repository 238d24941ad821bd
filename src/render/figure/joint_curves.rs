//! Joint angles along the paths of contenders, over time; one panel a contender.

use super::{Entry, Kind, Scene, Shown, ask};
use crate::render::RenderError;
use crate::render::chart::marks::Line;
use crate::render::chart::{Axis, Panel, Sheet};
use crate::render::style::{Width, series_stroke};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "joint_curves",
    about: "joint angles along the paths of contenders on one query, over time; one panel a contender",
    settings: Accepted::of::<JointCurves>(),
    example: r#"
problems = "cell"
query = "1"
contenders = ["Original A*", "Improved A*"]
"#,
    build: |settings, study, _paper| {
        let read: JointCurves = settings.read()?;
        ask::known(settings, study, std::slice::from_ref(&read.problems), &read.contenders)?;
        Ok(Box::new(read))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct JointCurves {
    /// The problem group, by its label.
    problems: String,
    /// The query, by its name.
    query: String,
    /// The contenders, by their labels.
    contenders: Vec<String>,
}

impl Kind for JointCurves {
    fn shown(&self) -> Vec<Shown<'_>> {
        Shown::first(&self.problems, &self.contenders)
    }

    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let draw = ask::shared_draw(scene, &self.problems, &self.query, &self.contenders, "trajectory")?;
        let mut found = Vec::new();
        for contender in &self.contenders {
            let row = ask::trial(scene, &self.problems, draw, Some(&self.query), contender)?;
            found.push((row, ask::exhibit(scene, &row.key, "trajectory")?));
        }
        let angles =
            || found.iter().flat_map(|(_, e)| e.values.chunks(e.width).flat_map(|stop| &stop[1..7]).copied());
        let [low, high] = Axis::over("", angles()).ends();
        let last_s = found.iter().filter_map(|(_, e)| e.values.chunks(e.width).last()).map(|stop| stop[0]);
        let last_s = last_s.fold(0.0, f64::max);
        let mut sheet = Sheet::new(Width::Double, self.contenders.len(), 170.0);
        for (row, exhibit) in &found {
            let number = |column: &str| row.value(column).unwrap_or(f64::NAN);
            let title = format!(
                "{}: {} local paths, travel {:.0}°, peak {:.0} °/s²",
                row.key.contender,
                number("local_paths"),
                number("joint_travel_deg"),
                number("joint_peak_deg_s2")
            );
            let x = Axis::linear("time (s)", 0.0, last_s)?;
            let mut panel = Panel::new(title, x, Axis::linear("joint angle (°)", low, high)?);
            for joint in 0..6 {
                let stops = exhibit.values.chunks(exhibit.width);
                let line = Line::through(stops.map(|s| [s[0], s[1 + joint]]).collect(), series_stroke(joint));
                panel.add(line.labelled(format!("θ{}", joint + 1)));
            }
            sheet.add(panel);
        }
        Ok(sheet)
    }
}
