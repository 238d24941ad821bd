//! Ways of the tool in a work cell: one column a contender on one query, from two sides.

use super::cell_poses::{VIEWS, add_capsules, furnished, panel};
use super::{Entry, Kind, Scene, Shown, ask};
use crate::analysis::draws::Compared;
use crate::analysis::metric;
use crate::render::RenderError;
use crate::render::chart::{Panel, Sheet};
use crate::render::scene3::Paint;
use crate::render::style::{Dash, GREY, Stroke, WHITE, Width, series_color};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use stats::summary::median;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "cell_paths",
    about: "ways of the tool in a work cell: paths of contenders on one query, from two sides",
    settings: Accepted::of::<CellPaths>(),
    example: r#"
problems = "cell"
query = "1"
contenders = ["Original A*", "Improved A*"]
"#,
    build: |settings, study, _paper| {
        let read: CellPaths = settings.read()?;
        ask::known(settings, study, std::slice::from_ref(&read.problems), &read.contenders)?;
        Ok(Box::new(read))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct CellPaths {
    /// The problem group, by its label.
    problems: String,
    /// The query, by its name.
    query: String,
    /// The contenders, by their labels.
    contenders: Vec<String>,
}

/// What the picked draw's saving is among those of all draws, in words.
fn rank(scene: &Scene<'_>, read: &CellPaths, replicate: u32) -> Option<String> {
    let (first, last) = (read.contenders.first()?, read.contenders.last()?);
    let length = metric::find("path_length_mm")?;
    let contenders = [first.as_str(), last.as_str()];
    let compared = Compared { group: &read.problems, contenders, query: Some(&read.query), whole: false };
    let all: Vec<f64> = compared.savings_percent(scene.run, length).concat();
    let row = |contender: &String| ask::trial(scene, &read.problems, replicate, Some(&read.query), contender);
    let [base, other] = [row(first).ok()?, row(last).ok()?].map(|row| scene.run.value(row, length));
    let own = 100.0 * (1.0 - other? / base?);
    let below = all.iter().filter(|saving| **saving < own).count();
    Some(format!(
        "saving {own:.1} %: {below} of {} roadmaps save less, the median saves {:.1} %",
        all.len(),
        median(&all)?
    ))
}

impl CellPaths {
    fn panel(
        &self,
        scene: &Scene<'_>,
        replicate: u32,
        index: usize,
        view: usize,
    ) -> Result<Panel, RenderError> {
        let draw = ask::draw(scene, &self.problems, replicate)?;
        let (contender, (seen, camera)) = (&self.contenders[index], VIEWS[view]);
        let mut solids = furnished(scene, draw)?;
        let body = ask::exhibit(scene, draw, &format!("body {}/start", self.query))?;
        let pale = Paint { outlined: false, ..Paint::solid(GREY.mixed(WHITE, 0.45)) };
        add_capsules(&mut solids, body, pale);
        let row = ask::trial(scene, &self.problems, replicate, Some(&self.query), contender)?;
        let stops = ask::exhibit(scene, &row.key, "trajectory")?;
        let points: Vec<[f64; 3]> =
            stops.values.chunks(stops.width).map(|stop| [stop[7], stop[8], stop[9]]).collect();
        let color = series_color(ask::series(scene, contender, index));
        for (name, at) in [("start", points.first()), ("goal", points.last())] {
            if let Some(at) = at {
                solids.tag(*at, name);
            }
        }
        solids.overlay(points.clone(), Stroke::solid(color, 0.7).dashed(Dash::Dotted));
        solids.polyline(points, Stroke::solid(color, 1.8));
        let number = |column: &str| row.value(column).unwrap_or(f64::NAN);
        let title = if view == 0 {
            let [length, legs] = ["path_length_mm", "local_paths"].map(number);
            format!("{contender}: {length:.0} mm, {legs} local paths")
        } else {
            format!("the same {seen}")
        };
        panel(&title, solids, camera, Vec::new())
    }
}

impl Kind for CellPaths {
    fn shown(&self) -> Vec<Shown<'_>> {
        Shown::first(&self.problems, &self.contenders)
    }

    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let replicate = ask::shared_draw(scene, &self.problems, &self.query, &self.contenders, "trajectory")?;
        let mut sheet = Sheet::new(Width::Double, self.contenders.len(), 200.0);
        if let Some(rank) = rank(scene, self, replicate) {
            sheet = sheet.titled(rank);
        }
        for view in 0..VIEWS.len() {
            for index in 0..self.contenders.len() {
                sheet.add(self.panel(scene, replicate, index, view)?);
            }
        }
        Ok(sheet)
    }
}
