//! About how much work a study asks for, before anything runs.

use super::super::choice::Interpretation;
use super::super::error::StudyError;
use super::super::inputs::Inputs;
use super::Study;
use engine::space::WorldKind;
use std::collections::BTreeMap;

/// About what a step takes, in seconds: an opened node or a built edge, with what is checked for it.
const STEP_S: f64 = 1e-6;
/// About what a cell, or an edge of a roadmap, takes while it is searched, in bytes.
const CELL_BYTES: f64 = 72.0;
/// Of all pairs of samples, so many may be edges of a roadmap.
const EDGES_SHARE: f64 = 0.25;

/// The most trials, bytes and seconds of a core that a study may take unless people allow more.
const MOST: Work = Work { trials: 1e6, bytes: 1e9, seconds: 86_400.0 };

/// What a study takes.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Work {
    /// Trials, timed ones among them.
    pub trials: f64,
    /// Memory that one instance takes on each thread, in bytes.
    pub bytes: f64,
    /// Time of one core, in seconds: an upper estimate, as if every search opened all that there is.
    pub seconds: f64,
}

impl Work {
    /// The amounts that must be confirmed before the study runs, in words; `None` if there are none.
    pub fn excess(&self) -> Option<String> {
        let Self { trials, bytes, seconds } = *self;
        let amounts = [
            (trials > MOST.trials, format!("{trials:.1e} trials, above {:.0e}", MOST.trials)),
            (bytes > MOST.bytes, format!("{:.1} GB a thread, above {:.0} GB", bytes / 1e9, MOST.bytes / 1e9)),
            (
                seconds > MOST.seconds,
                format!("{:.1} hours of a core, above {:.0}", seconds / 3600.0, MOST.seconds / 3600.0),
            ),
        ];
        let above: Vec<String> =
            amounts.into_iter().filter(|(is_above, _)| *is_above).map(|(_, text)| text).collect();
        (!above.is_empty()).then(|| format!("asks for about {}", above.join("; ")))
    }
}

impl Study {
    /// About how much work the study is under its defaults.
    ///
    /// # Errors
    /// Families that cannot be built.
    pub fn work(&self, inputs: &Inputs) -> Result<Work, StudyError> {
        let default = Interpretation::new(&self.choices, &BTreeMap::new()).unwrap_or_default();
        let swept = self.contender_points().len() as f64;
        let runs = self.contenders.iter().map(|own| f64::from(own.repeats)).sum::<f64>() * swept;
        let timed = self.timing.map_or(0.0, |timing| {
            let seeds = f64::from(timing.seeds.unwrap_or(1)) * self.contenders.len() as f64 * swept;
            f64::from(timing.problems) * f64::from(timing.repeats) * seeds
        });
        let mut work = Work::default();
        for (group, at) in self.posed() {
            let family = group.family(at, &default, inputs)?;
            let cells = family.cells() as f64;
            let has_roadmap = family.extent().is_some();
            let parts = if has_roadmap { cells * cells * EDGES_SHARE } else { cells };
            let queries = family.queries().len().max(1) as f64;
            let trials = queries * (f64::from(group.instances) * runs + timed);
            work.trials += trials;
            let budget = self.budget.expansions as f64;
            // Where robots have no roadmap, planners sample: nothing but the budget ends their trees.
            let samples = family.world() == WorldKind::Roadmap && !has_roadmap;
            let opened = if samples { budget } else { parts.min(budget) };
            work.bytes = work.bytes.max(parts.max(opened) * CELL_BYTES);
            work.seconds += STEP_S * (f64::from(group.instances) * parts + trials * opened);
        }
        Ok(work)
    }
}
