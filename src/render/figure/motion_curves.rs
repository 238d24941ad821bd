//! How tip, posture or joints change along a motion: over its time or its way, one panel a contender or a joint.

use super::{Entry, Kind, Scene, Shown, ask};
use crate::render::RenderError;
use crate::render::chart::marks::Line;
use crate::render::chart::{Axis, Panel, Sheet};
use crate::render::style::{Width, series_stroke};
use base::settings::{Accepted, Faults};
use engine::planner::Trace;
use schemars::JsonSchema;
use serde::Deserialize;
use study::key::SweepKey;
use study::record::Row;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "motion_curves",
    about: "how tip, posture or joints change along a motion, over its time or the tip's way; one panel a contender or joint",
    statistic: "Single trials.",
    settings: Accepted::shape::<Read>(),
    example: r#"
panels = [{ problem = "C1", contenders = ["Open list, smoothed (ours)"] }]
quantity = "joints"
sweep = "delta_deg=10.0"
"#,
    build: |settings, study, _paper| {
        let read: Read = settings.read()?;
        let mut faults = Faults::default();
        for panel in &read.panels {
            if let Some(query) = &read.query {
                faults.keep(ask::query(settings, study, &panel.problem, query, ("query", query)));
            }
        }
        let sweep = read.sweep.as_ref().and_then(|text| faults.keep(ask::sweep(settings, study, text)));
        Ok(Box::new(faults.or(Some(MotionCurves { read, sweep }))?))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Read {
    /// The problem groups and contenders whose motions are shown, in their order.
    panels: Vec<PanelSetting>,
    /// What is drawn.
    quantity: Quantity,
    /// The sweeps' values of the trial that is shown, as `setting=value,…`; the first trial if absent.
    sweep: Option<String>,
    /// The query, where an instance has several; the first instance on which every contender's motion is kept is shown.
    query: Option<String>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PanelSetting {
    /// The problem group; its first instance is shown.
    problem: String,
    /// Whose motions, of the first seed: one panel each, or all in one panel a joint.
    contenders: Vec<String>,
}

struct MotionCurves {
    read: Read,
    /// The point of the sweeps that is shown; the first trial if absent.
    sweep: Option<SweepKey>,
}

#[derive(Deserialize, JsonSchema, Clone, Copy, PartialEq)]
#[serde(rename_all = "snake_case")]
enum Quantity {
    /// The tip's coordinates over the motion's time.
    Tip,
    /// The arm's posture over the motion's time.
    Posture,
    /// The joint angles over the motion's time.
    Joints,
    /// The joint angles over the motion's time in seconds.
    TimedJoints,
    /// The joint angles along the way of the tip, one panel a joint with all contenders.
    JointsAlong,
}

/// A curve with the contender it belongs to.
type Curves<'a> = Vec<(&'a String, Vec<[f64; 2]>)>;

impl Quantity {
    /// The trace, the first of its columns and what stands along the axis.
    fn shown(self) -> (&'static str, usize, &'static str) {
        match self {
            Self::Tip => ("tip_trail", 0, "tip (cm)"),
            Self::Posture => ("posture_trail", 0, "turn from tool down (rad)"),
            Self::Joints => ("path", 0, "joint angle (rad)"),
            Self::TimedJoints => ("trajectory", 1, "joint angle (°)"),
            Self::JointsAlong => ("stations", 0, "θ"),
        }
    }

    fn name(self, index: usize) -> String {
        match self {
            Self::Tip => ["x", "y", "z"][index].to_owned(),
            Self::Posture => ["about x", "about y", "about z"][index].to_owned(),
            Self::Joints => format!("joint {}", index + 1),
            Self::TimedJoints | Self::JointsAlong => format!("θ{}", index + 1),
        }
    }

    /// How many columns of a trace this wide are drawn.
    fn columns(self, width: usize) -> usize {
        if self == Self::TimedJoints { 6 } else { width }
    }
}

impl Kind for MotionCurves {
    fn shown(&self) -> Vec<Shown<'_>> {
        self.read.panels.iter().map(|panel| Shown::first(&panel.problem, &panel.contenders)).collect()
    }

    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        if self.read.quantity == Quantity::JointsAlong {
            return self.along(scene);
        }
        let mut found = Vec::new();
        for panel in &self.read.panels {
            for contender in &panel.contenders {
                let row = self.row(scene, panel, contender)?;
                found.push((row, ask::trace(scene, &row.key, self.read.quantity.shown().0)?));
            }
        }
        let timed = self.read.quantity == Quantity::TimedJoints;
        let mut sheet = Sheet::new(Width::Double, found.len(), if timed { 170.0 } else { 150.0 });
        if !timed {
            sheet = sheet.noted("Stored configurations follow each other at equal times.");
        }
        for (row, trace) in &found {
            // Motions are compared, on one scale.
            let all: Vec<&Trace> = found.iter().map(|(_, trace)| *trace).collect();
            sheet.add(self.panel(row, trace, &all)?);
        }
        Ok(sheet)
    }
}

impl MotionCurves {
    fn row<'s>(
        &self,
        scene: &Scene<'s>,
        panel: &PanelSetting,
        contender: &str,
    ) -> Result<&'s Row, RenderError> {
        let problem = &panel.problem;
        let query = self.read.query.as_deref();
        if let Some(query) = query {
            let instance =
                ask::shared_instance(scene, problem, query, &panel.contenders, self.read.quantity.shown().0)?;
            return ask::trial(scene, problem, instance, Some(query), contender);
        }
        let is_there = |row: &Row| self.sweep.as_ref().is_none_or(|sweep| row.key.sweep == *sweep);
        ask::wanted_trial(scene, problem, contender, is_there)
    }

    /// One contender's motion, on the scale of `all`.
    fn panel(&self, row: &Row, trace: &Trace, all: &[&Trace]) -> Result<Panel, RenderError> {
        let quantity = self.read.quantity;
        let (_, first, axis) = quantity.shown();
        let columns = first..first + quantity.columns(trace.width);
        let stops: Vec<&[f64]> = trace.values.chunks(trace.width).collect();
        let shown = all.iter().flat_map(|e| e.values.chunks(e.width)).flat_map(|stop| &stop[columns.clone()]);
        let y = Axis::over(axis, shown.copied());
        let (title, x) = if quantity == Quantity::TimedJoints {
            let number = |column: &str| ask::number(row, column, 0);
            let [legs, travel, peak] = ["local_paths", "joint_travel_deg", "joint_peak_deg_s2"].map(number);
            let last_s = all.iter().filter_map(|e| e.values.chunks(e.width).last()).map(|stop| stop[0]);
            let title =
                format!("{}: {legs} local paths, travel {travel}°, peak {peak} °/s²", row.key.contender);
            (title, Axis::linear("time (s)", 0.0, last_s.fold(0.0, f64::max))?)
        } else {
            (row.key.contender.to_string(), Axis::linear("share of the motion's time", 0.0, 1.0)?)
        };
        let time = |k: usize| match quantity {
            Quantity::TimedJoints => stops[k][0],
            _ => k as f64 / (stops.len() - 1).max(1) as f64,
        };
        let mut panel = Panel::new(title, x, y);
        for (index, column) in columns.enumerate() {
            let points = stops.iter().enumerate().map(|(k, stop)| [time(k), stop[column]]).collect();
            panel.add(Line::through(points, series_stroke(index)).labelled(quantity.name(index)));
        }
        Ok(panel)
    }

    /// Both joints of a planar arm along the way of its tip, side by side.
    fn along(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let mut sheet = Sheet::new(Width::Double, 2, 105.0);
        let mut all = Vec::new();
        for panel in &self.read.panels {
            all.push([self.curves(scene, panel, 0)?, self.curves(scene, panel, 1)?]);
        }
        // One scale for each joint, so that cases can be compared.
        let ranges = [0, 1].map(|joint| {
            let points = all.iter().flat_map(move |both| &both[joint]).flat_map(|(_, points)| points);
            points.map(|point| point[1]).collect::<Vec<f64>>()
        });
        for (setting, both) in self.read.panels.iter().zip(all) {
            for (joint, curves) in both.into_iter().enumerate() {
                let ways = curves.iter().flat_map(|(_, points)| points).map(|point| point[0]);
                let name = self.read.quantity.name(joint);
                let x = Axis::over("way along the path (cm)", ways);
                let y = Axis::over(format!("{name} (°)"), ranges[joint].iter().copied());
                let mut panel = Panel::new(format!("{}, {name}", setting.problem), x, y);
                for (label, points) in curves {
                    let stroke = series_stroke(ask::place(scene, label));
                    panel.add(Line::through(points, stroke).labelled(label.clone()));
                }
                sheet.add(panel);
            }
        }
        Ok(sheet)
    }

    fn curves<'a>(
        &self,
        scene: &Scene<'_>,
        setting: &'a PanelSetting,
        joint: usize,
    ) -> Result<Curves<'a>, RenderError> {
        let mut curves = Vec::new();
        for label in &setting.contenders {
            let row = self.row(scene, setting, label)?;
            // A failed trial has no path and no curve.
            curves.extend(curve(scene, row, joint).map(|points| (label, points)));
        }
        Ok(curves)
    }
}

/// The way along the path and the joint's angle at every station.
fn curve(scene: &Scene<'_>, row: &Row, joint: usize) -> Option<Vec<[f64; 2]>> {
    let stations = scene.run.trace(&row.key, "stations")?;
    let stations: Vec<&[f64]> = stations.values.chunks(stations.width).collect();
    let mut way = 0.0;
    let mut before = [stations[0][4], stations[0][5]];
    let point = |station: &&[f64]| {
        let tip = [station[4], station[5]];
        way += libm::hypot(tip[0] - before[0], tip[1] - before[1]);
        before = tip;
        [way, station[joint]]
    };
    Some(stations.iter().map(point).collect())
}
