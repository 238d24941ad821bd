//! Both postures of a planar two-link arm at one point.

use super::{Entry, Kind, Scene, Shown, ask};
use crate::render::RenderError;
use crate::render::canvas::{Align, Stand, Type};
use crate::render::chart::marks::{Line, Note, Points};
use crate::render::chart::{Axis, Panel, Sheet, Trim};
use crate::render::style::{BLUE, GREEN, INK, Marker, Stroke, TextSize, VERMILLION, Width};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "arm_postures",
    about: "both postures of a planar two-link arm at the goal of a problem",
    settings: Accepted::of::<ArmPostures>(),
    example: r#"
problem = "case 1"
"#,
    build: |settings, study, _paper| {
        let read: ArmPostures = settings.read()?;
        ask::known(settings, study, std::slice::from_ref(&read.problem), &[])?;
        Ok(Box::new(read))
    },
};

/// Height of a panel's plot, in points.
const PLOT_PT: f64 = 150.0;

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct ArmPostures {
    /// The problem group.
    problem: String,
}

impl Kind for ArmPostures {
    fn shown(&self) -> Vec<Shown<'_>> {
        Shown::prepared(&self.problem)
    }

    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let both = ask::exhibit(scene, ask::draw(scene, &self.problem, 0)?, "branches")?;
        let stations: Vec<&[f64]> = both.values.chunks(both.width).collect();
        let mut sheet = Sheet::new(Width::Double, 2, PLOT_PT);
        for (name, station) in [("elbow down", stations[1]), ("elbow up", stations[0])] {
            sheet.add(panel(name, station, &stations)?);
        }
        Ok(sheet)
    }
}

/// Room beside and above the arm for the names of its joints, which must reach neither the frame nor the ticks.
const MARGINS_CM: [f64; 2] = [22.0, 12.0];

/// A station is θ1, θ2 in degrees, elbow and tip in centimetres.
fn panel(name: &str, station: &[f64], all: &[&[f64]]) -> Result<Panel, RenderError> {
    let coordinates = |axis: usize| all.iter().flat_map(move |s| [0.0, s[2 + axis], s[4 + axis]]);
    let (low, high) = (
        [0, 1].map(|axis| coordinates(axis).fold(f64::INFINITY, f64::min) - MARGINS_CM[axis]),
        [0, 1].map(|axis| coordinates(axis).fold(f64::NEG_INFINITY, f64::max) + MARGINS_CM[axis]),
    );
    let title = format!("{name}: θ1 = {:.2}°, θ2 = {:.2}°", station[0], station[1]).replace('-', "−");
    let (x, y) = (Axis::linear("x (cm)", low[0], high[0])?, Axis::linear("y (cm)", low[1], high[1])?);
    let mut panel = Panel::new(title, x, y).trimmed(Trim::Grid).with_equal_scales();
    let (elbow, tip) = ([station[2], station[3]], [station[4], station[5]]);
    panel.add(Line::through(vec![[0.0, 0.0], elbow], Stroke::solid(BLUE, 2.6)).labelled("link 1"));
    panel.add(Line::through(vec![elbow, tip], Stroke::solid(VERMILLION, 2.6)).labelled("link 2"));
    // The elbow's name stands on the side to which the arm bends, where no link is.
    let bends_right = elbow[0] > tip[0].midpoint(0.0);
    for (text, at, color, to_right) in
        [("base", [0.0, 0.0], INK, true), ("elbow", elbow, INK, bends_right), ("tip", tip, GREEN, true)]
    {
        let (marker, label) = (Marker::Circle, String::new());
        panel.add(Points { points: vec![at], marker, radius_pt: 3.0, color, label });
        let (align, shift) = if to_right { (Align::Start, 6.0) } else { (Align::End, -6.0) };
        let set = Type::of(TextSize::TICK).aligned(align, Stand::Centre);
        panel.add(Note { at, shift_pt: [shift, 0.0], text: text.to_owned(), set });
    }
    Ok(panel)
}
