//! Every draw's own row of solved shares along a sweep, their mean, and the printed row.

use super::success_bands::{Read, Shown};
use super::{Entry, Kind, Scene};
use crate::render::RenderError;
use crate::render::chart::Sheet;
use crate::render::chart::marks::{Line, Points};
use crate::render::style::{GREY, Stroke, VERMILLION, WHITE, Width, series_color, series_marker};
use base::settings::Accepted;
use stats::summary::mean;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "row_draws",
    about: "every draw's own row of solved shares along a sweep, their mean, and the printed row; one panel a contender",
    settings: Accepted::of::<Read>(),
    example: r#"
problems = "cell"
sweep = "samples"
axis = "samples N"
rows = [
    { contender = "Original A*", printed = "t2.original." },
    { contender = "Improved A*", printed = "t2.improved." },
]
"#,
    build: |settings, study, paper| Ok(Box::new(Draws(Shown::new(settings, study, paper)?))),
};

struct Draws(Shown);

/// At most this many draws are drawn, the first ones.
const DRAWN: usize = 60;

impl Kind for Draws {
    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let mut sheet = Sheet::new(Width::Double, self.0.rows.len(), 170.0);
        for row in &self.0.rows {
            let curves = self.0.curves(scene, &row.contender);
            let mut panel = self.0.panel(&row.contender)?;
            let xs = || self.0.points.iter().map(|(x, _)| *x);
            let thin = Stroke::solid(series_color(0).mixed(WHITE, 0.6), 0.35);
            for (draw, curve) in curves.iter().take(DRAWN).enumerate() {
                // Equal rows are moved apart by up to a point and a half, so that they can be told.
                let shift = ((draw as f64 * 0.618_033_988_749_895).fract() - 0.5) * 3.0;
                let line = Line::through(xs().zip(curve).map(|(x, y)| [x, y + shift]).collect(), thin);
                panel.add(line.labelled(if draw == 0 { "one roadmap (first 60)" } else { "" }));
            }
            let average = |cell: usize| mean(&curves.iter().map(|curve| curve[cell]).collect::<Vec<_>>());
            let means = xs().enumerate().filter_map(|(cell, x)| Some([x, average(cell)?])).collect();
            panel.add(Line::through(means, Stroke::solid(GREY, 1.8)).labelled("mean of all draws"));
            panel.add(Points {
                points: row.printed.clone(),
                marker: series_marker(0),
                radius_pt: 2.8,
                color: VERMILLION,
                label: "printed".to_owned(),
            });
            sheet.add(panel);
        }
        Ok(sheet)
    }
}
