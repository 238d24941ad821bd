//! Which settings of what a paper leaves open agree with what its studies were fitted to, and under which option of the fitted
//! reading.

use super::{Entry, Kind, Scene};
use crate::analysis::verdict::{Fit, SettingFit};
use crate::render::RenderError;
use crate::render::chart::legend::cell_key;
use crate::render::chart::marks::Cells;
use crate::render::chart::{Axis, Panel, Sheet};
use crate::render::style::{BLUE, GREY, GRID, Rgb, Stroke, VERMILLION, WHITE, Width};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "fitted_settings",
    about: "which settings of the readings agree with what the studies were fitted to: one a row, the fitted reading's options side by side",
    statistic: "Every option that votes by itself beside the defaults, and a sample of their product, drawn by a seed; {readings}.",
    settings: Accepted::of::<FittedSettings>(),
    example: r#"
axis = "threshold"
"#,
    build: |settings, _study, _paper| {
        let read: FittedSettings = settings.read()?;
        Ok(Box::new(read))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct FittedSettings {
    /// What stands along the axis: the fitted reading in words.
    axis: String,
}

/// Height of a row, in points.
const ROW_PT: f64 = 9.5;

/// So many characters of a setting's name stand beside its row.
const NAME: usize = 40;

/// What a fit is called and drawn as.
const FITS: [(Fit, &str, Rgb); 3] = [
    (Fit::Best, "agrees, and counts", BLUE),
    (Fit::Less, "agrees less than another", GRID),
    (Fit::Refused, "refused", VERMILLION),
];

/// The rows' names, from above, and in a note those that are too long to stand beside a row: there they are numbers.
fn named(rows: &[SettingFit]) -> (Vec<String>, String) {
    let mut long = Vec::new();
    let name = |row: &SettingFit| {
        if row.setting.chars().count() <= NAME {
            return row.setting.clone();
        }
        long.push(format!("{}: {}", long.len() + 1, row.setting));
        format!("setting {}", long.len())
    };
    let names = rows.iter().map(name).collect();
    (names, if long.is_empty() { String::new() } else { format!("Settings {}.", long.join("; ")) })
}

impl Kind for FittedSettings {
    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        let rows: &[SettingFit] = scene.verdicts.explored.as_ref().map_or(&[], |explored| &explored.fits);
        let readings = scene.evidence.paper.readings();
        let Some(fitted) = readings.iter().find(|reading| reading.fitted).filter(|_| !rows.is_empty()) else {
            return Ok(Sheet::new(Width::Double, 1, ROW_PT).titled("No reading was explored."));
        };
        let options: Vec<&str> = fitted.options.keys().map(String::as_str).collect();
        let (names, note) = named(rows);
        let names = Axis::names("", names.into_iter().rev());
        let mut panel = Panel::new("", Axis::names(&self.axis, options.iter().copied()), names);
        let color = |row: &SettingFit, option: &str| {
            let fit = row.fits.get(option)?;
            FITS.iter().find(|(own, ..)| own == fit).map(|(_, _, color)| color.mixed(WHITE, 0.25))
        };
        let of_row = |row: &SettingFit| options.iter().map(|option| color(row, option)).collect::<Vec<_>>();
        panel.add(Cells {
            corner: [-0.5, -0.5],
            cell: [1.0, 1.0],
            columns: options.len(),
            colors: rows.iter().rev().flat_map(of_row).collect(),
            lines: Some(Stroke::solid(GREY.mixed(WHITE, 0.6), 0.4)),
            keys: FITS.map(|(_, label, color)| cell_key(label, color.mixed(WHITE, 0.25))).to_vec(),
        });
        Sheet::new(Width::Double, 1, (rows.len() + 3) as f64 * ROW_PT).noted(note).with([Ok(panel)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    #[test]
    fn no_name_of_a_setting_is_cut() {
        let long = |last: &str| format!("edge_end = whole_turns, ground_obstacle = 200_mm, {last}");
        let rows = ["the defaults".to_owned(), long("jump = 5_deg"), "tool = 110_mm".to_owned(), long("rho")]
            .map(|setting| SettingFit { setting, fits: BTreeMap::new() });
        let (names, note) = named(&rows);
        assert_eq!(names, ["the defaults", "setting 1", "tool = 110_mm", "setting 2"]);
        assert_eq!(note, format!("Settings 1: {}; 2: {}.", long("jump = 5_deg"), long("rho")));
        assert_eq!(named(&rows[..1]).1, "");
    }
}
