//! Ways of the tool in a work cell: paths of contenders on one query, from two sides.

use super::cell_poses::{VIEWS, add_capsules, furnished, panel};
use super::{Entry, Kind, Scene, ask};
use crate::render::RenderError;
use crate::render::chart::{Key, Sheet, Swatch};
use crate::render::scene3::Paint;
use crate::render::style::{GREY, Stroke, WHITE, Width, series_color};
use crate::study::slug;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "cell_paths",
    about: "ways of the tool in a work cell: paths of contenders on one query, from two sides",
    build: |settings, study, _paper| {
        let read: CellPaths = settings.read()?;
        ask::known(settings, study, std::slice::from_ref(&read.problems), &read.contenders)?;
        Ok(Box::new(read))
    },
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CellPaths {
    problems: String,
    query: String,
    contenders: Vec<String>,
}

impl Kind for CellPaths {
    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let replicate = ask::shared_draw(scene, &self.problems, &self.query, &self.contenders, "trajectory")?;
        let draw = format!("{}/{replicate}", slug(&self.problems));
        let mut sheet = Sheet::new(Width::Double, VIEWS.len(), 230.0);
        for (title, camera) in VIEWS {
            let mut solids = furnished(scene, &draw)?;
            let body = ask::exhibit(scene, &draw, &format!("body {}/start", self.query))?;
            let pale = Paint { outlined: false, ..Paint::solid(GREY.mixed(WHITE, 0.45)) };
            add_capsules(&mut solids, body, pale);
            let mut keys = Vec::new();
            for (index, contender) in self.contenders.iter().enumerate() {
                let row = ask::trial(scene, &self.problems, replicate, Some(&self.query), contender)?;
                let stops = ask::exhibit(scene, &row.trial, "trajectory")?;
                let points: Vec<[f64; 3]> =
                    stops.values.chunks(stops.width).map(|stop| [stop[7], stop[8], stop[9]]).collect();
                let stroke = Stroke::solid(series_color(index), 1.6);
                let ends = [("start", points.first()), ("goal", points.last())];
                for (name, at) in ends.into_iter().filter(|_| index == 0) {
                    if let Some(at) = at {
                        solids.tag(*at, name);
                    }
                }
                solids.polyline(points, stroke);
                let number = |column: &str| row.value(column).unwrap_or(f64::NAN);
                let label = format!(
                    "{contender}: {:.0} mm, {} local paths",
                    number("path_length_mm"),
                    number("local_paths")
                );
                keys.push(Key { swatch: Swatch::Line(stroke, None), label });
            }
            sheet.add(panel(title, solids, camera, keys)?);
        }
        Ok(sheet)
    }
}
