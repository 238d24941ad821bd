//! The whole arm along its path: postures at even intervals, the last one solid, one row a contender, one panel a view.

use super::polyhedra_scene::{View, add_obstacles, panel, points, stored};
use super::{Entry, Kind, Scene, Shown, ask};
use crate::render::RenderError;
use crate::render::chart::legend::cell_key;
use crate::render::chart::{Key, Sheet, Swatch};
use crate::render::scene3::{Paint, Scene as Solids};
use crate::render::style::{GREEN, ORANGE, PURPLE, Rgb, Stroke, VERMILLION, WHITE, Width};
use crate::study::key::SweepKey;
use crate::study::record::{Row, Status};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "arm_poses",
    about: "the whole arm along its path among polyhedra, one row a contender, one panel a view",
    settings: Accepted::of::<Read>(),
    example: r#"
problem = "C1"
contenders = ["Jia's A*, 12 neighbours", "This method"]
views = ["corner"]
sweep = "delta_deg=10.0"
"#,
    build: |settings, study, _paper| {
        let read: Read = settings.read()?;
        super::check_labels(settings, study, &read.contenders, [&read.problem])?;
        let sweep = read.sweep.as_ref().map(|text| ask::sweep(settings, study, text)).transpose()?;
        Ok(Box::new(ArmPoses { read, sweep }))
    },
};

/// Height of a panel's plot, in points.
const PLOT_PT: f64 = 220.0;

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Read {
    /// The problem group; its first draw is shown, or the first that only the first contender solves.
    problem: String,
    /// Whether it is the latter, if there is one whose arm is stored.
    #[serde(default)]
    first_alone: bool,
    /// One row each.
    contenders: Vec<String>,
    /// One panel each.
    views: Vec<View>,
    /// The sweeps' values of the trial that is shown, as `setting=value,…`; the first trial if absent.
    sweep: Option<String>,
}

struct ArmPoses {
    read: Read,
    /// The point of the sweeps that is shown; the first trial if absent.
    sweep: Option<SweepKey>,
}

/// From the first posture to the last.
fn shade(share: f64) -> Rgb {
    ORANGE.mixed(WHITE, 0.6 * (1.0 - share))
}

/// The line of a rod's axis.
fn axis(share: f64) -> Stroke {
    Stroke::solid(shade(share), 2.4)
}

impl Kind for ArmPoses {
    fn shown(&self) -> Vec<Shown<'_>> {
        Shown::first(&self.read.problem, &self.read.contenders)
    }

    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let columns =
            if self.read.views.len() == 1 { self.read.contenders.len() } else { self.read.views.len() };
        let mut sheet = Sheet::new(Width::Double, columns, PLOT_PT).noted("Rod radii are assumed.");
        for contender in &self.read.contenders {
            let row = self.row(scene, contender)?;
            for view in &self.read.views {
                let mut solids = Solids::default();
                add_obstacles(&mut solids, scene.run, &row.key.on, false)?;
                let keys = arm(&mut solids, scene, row)?;
                let end = match row.status {
                    Status::Solved => "goal reached".to_owned(),
                    _ => row.value("followed_share").map_or_else(
                        || row.status.to_string(),
                        |share| format!("stopped after {:.0} % of the path", 100.0 * share),
                    ),
                };
                let seen =
                    if self.read.views.len() > 1 { format!(", {}", view.name()) } else { String::new() };
                let title = format!("{}: {end}{seen}", row.key.contender);
                sheet.add(panel(title, solids, *view, keys)?);
            }
        }
        Ok(sheet)
    }
}

impl ArmPoses {
    /// The first draw with a stored arm that only the first contender solves.
    fn chosen(&self, scene: &Scene<'_>) -> Option<u32> {
        let rows = |contender: &String| scene.run.rows(&self.read.problem, contender).into_iter();
        let (first, others) = self.read.contenders.split_first()?;
        let fails = |replicate: u32, other: &String| {
            rows(other).any(|row| row.draw() == replicate && row.status != Status::Solved)
        };
        let is_chosen = |row: &&Row| {
            row.status == Status::Solved
                && scene.run.exhibit(&row.key, "rods").is_some()
                && others.iter().all(|other| fails(row.draw(), other))
        };
        rows(first).find(is_chosen).map(Row::draw)
    }

    fn row<'a>(&self, scene: &'a Scene<'_>, contender: &str) -> Result<&'a Row, RenderError> {
        let rows = scene.run.rows(&self.read.problem, contender);
        let chosen = if self.read.first_alone { self.chosen(scene) } else { None };
        let is_asked = |row: &&Row| {
            self.sweep.as_ref().is_none_or(|sweep| row.key.sweep == *sweep)
                && chosen.is_none_or(|replicate| row.draw() == replicate)
        };
        rows.into_iter().find(is_asked).ok_or_else(|| RenderError::NotStored {
            what: format!("a trial of `{contender}` on `{}`", self.read.problem),
        })
    }
}

fn arm(solids: &mut Solids, scene: &Scene<'_>, row: &Row) -> Result<Vec<Key>, RenderError> {
    let rods = stored(scene.run, &row.key, "rods")?;
    let last = rods.values.chunks(rods.width).map(|rod| rod[0]).fold(1.0, f64::max);
    for rod in rods.values.chunks(rods.width) {
        let (from, to) = ([rod[1], rod[2], rod[3]], [rod[4], rod[5], rod[6]]);
        // Solid rods of many postures cut each other into more facets than a picture can hold.
        if rod[0] < last {
            solids.polyline(vec![from, to], axis(rod[0] / last));
        } else {
            solids.capsule(from, to, rod[7], Paint::solid(shade(1.0)));
        }
    }
    let along =
        Key { swatch: Swatch::Line(axis(0.0), None), label: "axes of the rods on the way".to_owned() };
    let mut keys = vec![along, cell_key("arm at the end", shade(1.0))];
    for (name, label, color) in
        [("tip_path", "path to be followed", PURPLE), ("tip_trail", "way of the tip", VERMILLION)]
    {
        if let Some(found) = scene.run.exhibit(&row.key, name) {
            let stroke = Stroke::solid(color, 1.3);
            solids.polyline(points(found), stroke);
            keys.push(Key { swatch: Swatch::Line(stroke, None), label: label.to_owned() });
        }
    }
    let trail = points(stored(scene.run, &row.key, "tip_trail")?);
    if let Some(start) = trail.first() {
        solids.capsule(*start, *start, 1.6, Paint::solid(GREEN));
        keys.push(cell_key("start", GREEN));
    }
    Ok(keys)
}
