//! The effect of each choice on each claim when it alone departs from its default.

use super::{Entry, Kind, Scene};
use crate::analysis::verdict::{Across, ClaimVerdict, Effect, Fit, SettingFit};
use crate::render::RenderError;
use crate::render::chart::legend::cell_key;
use crate::render::chart::marks::Cells;
use crate::render::chart::{Axis, Key, Panel, Sheet, Trim};
use crate::render::style::{BLUE, GREY, GRID, Rgb, Stroke, VERMILLION, WHITE, Width, YELLOW};
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeSet;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "claims_by_choices",
    about: "which choice moves which claim: the greatest effect of an axis's voting options, one at a time",
    statistic: "Voting options, one at a time; a cell shows the greatest effect. Claims whose outcome none changes are absent; {interpretations}.",
    settings: Accepted::shape::<ClaimsByChoices>(),
    example: r#"
fitted = "threshold"
"#,
    build: |settings, _study, _paper| Ok(Box::new(settings.read::<ClaimsByChoices>()?)),
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct ClaimsByChoices {
    /// Instead of claims: which settings of the choices agree with what the studies were fitted to, and under which options of
    /// the fitted choice, which stands along the axis in these words.
    fitted: Option<String>,
}

/// Height of a row, in points.
const ROW_PT: f64 = 9.5;

/// So many characters of a setting's name stand beside its row.
const NAME: usize = 40;

/// What an effect is called and drawn as, the least first.
const LOOKS: [(Effect, &str, Rgb); 4] = [
    (Effect::Number, "moves the number", GRID),
    (Effect::Outcome, "changes the outcome, not the direction", YELLOW),
    (Effect::Opens, "opens or decides it", BLUE),
    (Effect::Turns, "turns it", VERMILLION),
];

/// What a fit is called and drawn as.
const FITS: [(Fit, &str, Rgb); 3] = [
    (Fit::Best, "agrees, and counts", BLUE),
    (Fit::Less, "agrees less than another", GRID),
    (Fit::Refused, "refused", VERMILLION),
];

/// What a figure of settings shows of how many.
const SETTINGS: &str = "The defaults, every other option that votes, alone, and a random sample of their combinations; {interpretations}. A white cell was not run.";

/// Which settings agree with what the studies were fitted to: one a row, the options of the fitted choice side by side, with
/// `words` along the axis.
fn settings(scene: &Scene<'_>, words: &str) -> Sheet {
    let rows: &[SettingFit] = scene.verdicts.explored.as_ref().map_or(&[], |explored| &explored.fits);
    let choices = &scene.evidence.paper.choices;
    let Some(fitted) = choices.iter().find(|choice| choice.fitted).filter(|_| !rows.is_empty()) else {
        return Sheet::new(Width::Double, 1, ROW_PT).titled("No interpretation was explored.");
    };
    let options: Vec<&str> = fitted.options.keys().map(String::as_str).collect();
    let names = Axis::names("", named(rows).into_iter().rev());
    let across = Axis::names(words, options.iter().copied());
    let mut panel = Panel::new("", across, names).trimmed(Trim::Frame);
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
        keys: keys(&FITS, &rows.iter().flat_map(|row| row.fits.values().copied()).collect()),
    });
    Sheet::new(Width::Double, 1, (rows.len() + 3) as f64 * ROW_PT).with([panel])
}

/// The rows' names, from above; those that are too long to stand beside a row are numbers, which the details explain.
pub fn named(rows: &[SettingFit]) -> Vec<String> {
    let mut long = 0;
    let name = |row: &SettingFit| {
        if row.setting.chars().count() <= NAME {
            return row.setting.clone();
        }
        long += 1;
        format!("setting {long}")
    };
    rows.iter().map(name).collect()
}

fn color(across: &Across, axis: &str) -> Option<Rgb> {
    let effect = across.effects.get(axis)?.effect;
    LOOKS.iter().find(|(own, ..)| *own == effect).map(|(_, _, color)| color.mixed(WHITE, 0.25))
}

/// The legend's entries: of what some cell has.
fn keys<T: Ord>(looks: &[(T, &str, Rgb)], shown: &BTreeSet<T>) -> Vec<Key> {
    let is_shown = |(own, ..): &&(T, &str, Rgb)| shown.contains(own);
    let key = |(_, label, color): &(T, &str, Rgb)| cell_key(*label, color.mixed(WHITE, 0.25));
    looks.iter().filter(is_shown).map(key).collect()
}

impl ClaimsByChoices {
    /// The sentences and rows whose outcome some option changes, from above.
    fn rows<'s>(scene: &'s Scene<'_>) -> Vec<(&'s ClaimVerdict, &'s Across)> {
        let moved = |judged: &'s ClaimVerdict| {
            let is_moved = |across: &&Across| across.effects.values().any(|of| of.effect > Effect::Number);
            let across = judged.across.as_ref().filter(is_moved)?;
            Some((judged, across))
        };
        scene.verdicts.claims.iter().filter(|judged| judged.part_of.is_none()).filter_map(moved).collect()
    }
}

impl Kind for ClaimsByChoices {
    fn statistic(&self) -> Option<&'static str> {
        self.fitted.as_ref().map(|_| SETTINGS)
    }

    fn draw(&self, scene: &Scene<'_>) -> Result<Sheet, RenderError> {
        if let Some(words) = &self.fitted {
            return Ok(settings(scene, words));
        }
        let rows = Self::rows(scene);
        let choices = &scene.evidence.paper.choices;
        let is_moving = |id: &&str| rows.iter().any(|(_, across)| across.effects.contains_key(*id));
        let axes: Vec<&str> = choices.iter().map(|choice| choice.id.as_str()).filter(is_moving).collect();
        if rows.is_empty() || axes.is_empty() {
            // A quick run, or one that was not explored, has nothing to show; that is no fault of the figure's.
            return Ok(Sheet::new(Width::Double, 1, ROW_PT).titled("No explored choice moves a claim."));
        }
        let columns = axes.iter().copied();
        let named =
            |(judged, _): &(&ClaimVerdict, &Across)| format!("{}: {}", judged.claim, judged.verdict_text());
        let names: Vec<String> = rows.iter().rev().map(named).collect();
        let mut panel = Panel::new("", Axis::names("", columns), Axis::names("", names)).trimmed(Trim::Frame);
        let of_row = |(_, across): &(&ClaimVerdict, &Across)| {
            axes.iter().map(|axis| color(across, axis)).collect::<Vec<_>>()
        };
        let effects = rows.iter().flat_map(|(_, across)| across.effects.values());
        let shown: BTreeSet<Effect> = effects.map(|moved| moved.effect).collect();
        panel.add(Cells {
            corner: [-0.5, -0.5],
            cell: [1.0, 1.0],
            columns: axes.len(),
            colors: rows.iter().rev().flat_map(of_row).collect(),
            lines: Some(Stroke::solid(GREY.mixed(WHITE, 0.6), 0.4)),
            keys: keys(&LOOKS, &shown),
        });
        let height = rows.len() as f64 * ROW_PT + 2.0 * ROW_PT;
        Ok(Sheet::new(Width::Double, 1, height).with([panel]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    #[test]
    fn the_legend_names_the_effects_that_are_drawn_and_no_other() {
        let labels = |shown: &[Effect]| -> Vec<String> {
            keys(&LOOKS, &shown.iter().copied().collect()).into_iter().map(|key| key.label).collect()
        };
        assert_eq!(labels(&[Effect::Turns, Effect::Number]), ["moves the number", "turns it"]);
        assert_eq!(labels(&LOOKS.map(|(effect, ..)| effect)).len(), LOOKS.len());
    }

    #[test]
    fn a_setting_with_a_long_name_is_a_number() {
        let long = |last: &str| format!("edge_end = whole_turns, ground_obstacle = 200_mm, {last}");
        let rows = ["the defaults".to_owned(), long("jump = 5_deg"), "tool = 110_mm".to_owned(), long("rho")]
            .map(|setting| SettingFit { setting, fits: BTreeMap::new() });
        assert_eq!(named(&rows), ["the defaults", "setting 1", "tool = 110_mm", "setting 2"]);
    }
}
