//! How a path on a grid map was tidied: bends before and after, and the lines of sight that were refused.

use super::grid_search::{add_ends, blocked, centres, map, painted};
use super::{Entry, Kind, Scene, Shown, check_labels};
use crate::render::RenderError;
use crate::render::chart::legend::cell_key;
use crate::render::chart::marks::{Line, Points};
use crate::render::chart::{Panel, Sheet};
use crate::render::style::{BLUE, Dash, GREY, Marker, Stroke, VERMILLION, Width};
use base::settings::Accepted;
use engine::shorten::bends;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "tidying",
    about: "how a path on a grid map was tidied: bends before and after, refused lines of sight; one panel a problem",
    settings: Accepted::of::<Tidying>(),
    example: r#"
problems = ["W1", "W2"]
contender = "Improved A*"
"#,
    build: |settings, study, _paper| {
        let read: Tidying = settings.read()?;
        check_labels(settings, study, [&read.contender], &read.problems)?;
        Ok(Box::new(read))
    },
};

/// Height of a panel's plot, in points.
const PLOT_PT: f64 = 215.0;

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Tidying {
    /// Problem groups; the first draw of each is shown.
    problems: Vec<String>,
    /// The contender, by its label.
    contender: String,
}

impl Kind for Tidying {
    fn shown(&self) -> Vec<Shown<'_>> {
        let one = std::slice::from_ref(&self.contender);
        self.problems.iter().flat_map(|problem| Shown::first(problem, one)).collect()
    }

    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let mut sheet = Sheet::new(Width::Double, self.problems.len(), PLOT_PT);
        for problem in &self.problems {
            sheet.add(self.panel(scene, problem)?);
        }
        Ok(sheet)
    }
}

impl Tidying {
    fn panel(&self, scene: &Scene<'_>, problem: &str) -> Result<Panel, RenderError> {
        let rows = scene.run.rows(problem, &self.contender);
        let row = rows.first().ok_or_else(|| RenderError::NotStored {
            what: format!("a trial of `{}` on `{problem}`", self.contender),
        })?;
        let stored = |name: &str| {
            let missing = || RenderError::NotStored {
                what: format!("the exhibit `{name}` of `{}`", scene.run.trial(row)),
            };
            scene.run.exhibit(&row.key, name).ok_or_else(missing)
        };
        let (raw, path, refused) = (stored("raw_path")?, stored("path")?, stored("refused_sight")?);
        let raw_points: Vec<&[f64]> = raw.values.chunks(raw.width).collect();
        let bent: Vec<[f64; 2]> = bends(&raw_points).into_iter().map(|i| centres(raw)[i]).collect();
        let path = centres(path);
        let title = format!("{problem}: {} bends before, {} after", bent.len() - 2, path.len() - 2);
        let map = map(scene, row)?;
        let mut panel = map.panel_about(title, &centres(raw))?;
        panel.add(painted(&map, &[], vec![cell_key("blocked", blocked())]));
        let lines = refused.values.chunks(refused.width).flat_map(|ends| {
            let [from, to] = [[ends[0] + 0.5, ends[1] + 0.5], [ends[2] + 0.5, ends[3] + 0.5]];
            [from, to, [f64::NAN; 2]]
        });
        let dotted = Stroke::solid(GREY, 0.9).dashed(Dash::Dotted);
        panel.add(Line::through(lines.collect(), dotted).labelled("line of sight refused"));
        let dashed = Stroke::solid(BLUE, 1.0).dashed(Dash::Dashed);
        panel.add(Line::through(centres(raw), dashed).labelled("path as searched"));
        let label = "its bends".to_owned();
        panel.add(Points { points: bent, marker: Marker::Circle, radius_pt: 1.8, color: BLUE, label });
        let kept = Line::through(path.clone(), Stroke::solid(VERMILLION, 1.6)).marked(Marker::Square);
        panel.add(kept.labelled("after deletion"));
        add_ends(&mut panel, &path);
        Ok(panel)
    }
}
