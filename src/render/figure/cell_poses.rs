//! A work cell with its robot at several poses, from two sides.

use super::{Entry, Kind, Scene, Shown, ask};
use crate::render::RenderError;
use crate::render::chart::legend::cell_key;
use crate::render::chart::{Axis, Key, Panel, Sheet, Trim};
use crate::render::latex::{Cell, Column, Table};
use crate::render::scene3::{Camera, Paint, ScaleBar, Scene as Solids, SceneMark};
use crate::render::style::{GREY, Rgb, WHITE, Width, YELLOW, series_color};
use crate::study::key::DrawKey;
use base::settings::Accepted;
use engine::planner::Exhibit;
use schemars::JsonSchema;
use serde::Deserialize;
use std::sync::Arc;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "cell_poses",
    about: "a work cell with its robot at several poses, from two sides",
    settings: Accepted::of::<CellPoses>(),
    example: r#"
problems = "cell"
poses = ["4/start", "1/start", "3/start", "2/goal", "7/start", "9/start"]
names = ["H", "P1", "P2", "P3", "P5", "P6"]
at_once = 3
"#,
    build: |settings, study, _paper| {
        let read: CellPoses = settings.read()?;
        ask::known(settings, study, std::slice::from_ref(&read.problems), &[])?;
        if read.poses.len() != read.names.len() {
            let (poses, names) = (read.poses.len(), read.names.len());
            let message =
                format!("there are {poses} poses and {names} names; as many of either are accepted");
            return Err(settings.error_at("names", message));
        }
        Ok(Box::new(read))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct CellPoses {
    /// The problem group, by its label.
    problems: String,
    /// Ends of queries, as `name/start` or `name/goal`.
    poses: Vec<String>,
    /// What they are called.
    names: Vec<String>,
    /// How many of them are shown in one picture.
    #[schemars(range(max = 1000))]
    at_once: usize,
}

/// From where cells are seen.
pub(super) const VIEWS: [(&str, Camera); 2] = [
    ("from the front right", Camera::parallel(-42.0, 24.0)),
    ("from above left", Camera::parallel(35.0, 48.0)),
];

/// How many parts at the head of a body hardly move from pose to pose.
const FIXED_PARTS: usize = 2;

/// The paint of obstacles.
fn obstacle() -> Rgb {
    YELLOW.mixed(GREY, 0.35).mixed(WHITE, 0.35)
}

/// The cell of a draw: floor and obstacles.
pub(super) fn furnished(scene: &Scene<'_>, draw: &Arc<DrawKey>) -> Result<Solids, RenderError> {
    let mut solids = Solids::default();
    let boxes = ask::exhibit(scene, draw, "boxes")?;
    let floor =
        [[-450.0, -1000.0, 0.0], [1450.0, -1000.0, 0.0], [1450.0, 1000.0, 0.0], [-450.0, 1000.0, 0.0]];
    solids.sheet(floor.to_vec(), Paint { outlined: true, ..Paint::solid(GREY.mixed(WHITE, 0.82)) });
    for corners in boxes.values.chunks(boxes.width) {
        let vertices = corners.chunks(3).map(|p| [p[0], p[1], p[2]]).collect();
        let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        solids.polyhedron(
            vertices,
            faces.iter().map(|face| face.to_vec()).collect(),
            Paint::solid(obstacle()),
        );
    }
    let rounds = ask::exhibit(scene, draw, "rounds")?;
    add_capsules(&mut solids, rounds, Paint::solid(obstacle()));
    Ok(solids)
}

/// Adds capsules given by their ends and radius.
pub(super) fn add_capsules(solids: &mut Solids, capsules: &Exhibit, paint: Paint) {
    for c in capsules.values.chunks(capsules.width) {
        solids.capsule([c[0], c[1], c[2]], [c[3], c[4], c[5]], c[6], paint);
    }
}

/// A panel that shows `solids`.
pub(super) fn panel(
    title: &str,
    solids: Solids,
    camera: Camera,
    keys: Vec<Key>,
) -> Result<Panel, RenderError> {
    let unused = || Axis::linear("", 0.0, 1.0);
    let mut panel = Panel::new(title, unused()?, unused()?).trimmed(Trim::Bare);
    let bar = Some(ScaleBar { length: 500.0, label: "500 mm".to_owned() });
    panel.add(SceneMark { scene: solids, camera, bar, keys });
    Ok(panel)
}

impl CellPoses {}

impl Kind for CellPoses {
    fn shown(&self) -> Vec<Shown<'_>> {
        Shown::prepared(&self.problems)
    }

    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let draw = ask::draw(scene, &self.problems, 0)?;
        let mut sheet = Sheet::new(Width::Double, VIEWS.len(), 200.0);
        let named: Vec<(usize, (&String, &String))> =
            self.poses.iter().zip(&self.names).enumerate().collect();
        for shown in named.chunks(self.at_once.max(1)) {
            for (title, camera) in VIEWS {
                let mut solids = furnished(scene, draw)?;
                let mut keys = vec![cell_key("obstacles", obstacle())];
                for (place, (index, (pose, name))) in shown.iter().enumerate() {
                    let color = series_color(*index).mixed(WHITE, 0.35);
                    let body = ask::exhibit(scene, draw, &format!("body {pose}"))?;
                    // Base and turret stand where they stand at every pose: one of each is drawn.
                    let fixed = if place == 0 { 0 } else { FIXED_PARTS * body.width };
                    let parts = Exhibit { values: body.values[fixed..].to_vec(), ..body.clone() };
                    add_capsules(&mut solids, &parts, Paint { outlined: false, ..Paint::solid(color) });
                    if let Some(tip) = body.values.chunks(body.width).next_back() {
                        solids.tag([tip[3], tip[4], tip[5]], *name);
                    }
                    keys.push(cell_key(format!("robot at {name}"), color));
                }
                sheet.add(panel(title, solids, camera, keys)?);
            }
        }
        Ok(sheet)
    }

    fn table(&self, scene: &Scene<'_>, label: &str, caption: &str) -> Result<Option<Table>, RenderError> {
        let draw = ask::draw(scene, &self.problems, 0)?;
        let kinds = [Column::Left, Column::Left, Column::Right, Column::Right, Column::Right, Column::Right];
        let mut table = Table::new(label, caption, &kinds);
        let heads = ["group", "", "joint angles (°)", "flange (mm)", "tip (mm)", "direction"];
        table.head(heads.map(Cell::from).to_vec());
        for exhibit in scene.run.exhibits(draw) {
            let Some((group, end)) = exhibit.name.strip_prefix("pose ").and_then(|name| name.split_once('/'))
            else {
                continue;
            };
            let numbers = |from: usize, to: usize, decimals: usize| {
                let of = |value: &f64| crate::render::chart::axis::number(*value, decimals);
                exhibit.values[from..to].iter().map(of).collect::<Vec<_>>().join(", ")
            };
            let group = if end == "start" { group } else { "" };
            let cells = [numbers(0, 6, 0), numbers(6, 9, 1), numbers(9, 12, 1), numbers(12, 15, 3)];
            let row = [group.to_owned(), end.to_owned()].into_iter().chain(cells);
            table.row(row.map(Cell::from).collect());
        }
        Ok(Some(table))
    }
}
