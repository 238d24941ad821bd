//! Sizes beyond the limits: each number is in its range, but their product would never end or never fit.

use super::super::family::Family;
use super::super::spec::TrialsSpec;
use super::super::task;
use super::{Contender, Group, Study, columns_of, labels_of};
use base::settings::Faults;
use std::sync::Arc;

/// The most trials of a study, all interpretations that it explores counted.
const TRIALS: f64 = 1e7;
/// The most timed runs of a study.
const TIMED: f64 = 1e7;
/// The most cells, samples and the like that the instances of a problem group are made of together.
const CELLS: f64 = 1e12;
/// The most combinations of the sweeps' values.
pub(super) const SWEPT: usize = 10_000;

impl Study {
    /// Refuses sizes beyond the limits, a study without trials, and several seeds for a contender that draws nothing.
    pub(super) fn check_sizes(&self, families: &[(&Group, Arc<dyn Family>)], faults: &mut Faults) {
        for (group, family) in families {
            let cells = f64::from(group.instances) * family.cells() as f64;
            if cells > CELLS {
                let message = format!(
                    "{} instances of {} cells or samples each are {cells:.1e}; at most {CELLS:.0e} are accepted in all",
                    group.instances,
                    family.cells()
                );
                faults.add(self.document.error_at(&format!("problems.{}.instances", group.place), message));
            }
        }
        self.check_runs(faults);
        self.check_trials(families, faults);
        for (index, figure) in self.figures.iter().enumerate() {
            self.check_shown(&figure.shows, &format!("figure.{index}.shows"), faults);
        }
        self.check_shown(&self.keeps, "keep", faults);
    }

    /// Refuses a study that plans nothing: without problems, or without a contender.
    fn check_runs(&self, faults: &mut Faults) {
        let lists = [("problems", self.groups.is_empty()), ("contender", self.contenders.is_empty())];
        for (key, is_empty) in lists {
            if is_empty && self.task.name == task::default().name {
                let message = format!("nothing is planned without `[[{key}]]`; one or more are accepted");
                faults.add(self.document.error_at("", message).about(&columns_of(&self.name)));
            }
        }
    }

    fn check_trials(&self, families: &[(&Group, Arc<dyn Family>)], faults: &mut Faults) {
        let swept = self.contender_points().len();
        let each = families
            .iter()
            .map(|(group, family)| f64::from(group.instances) * family.queries().len().max(1) as f64);
        let problems = each.sum::<f64>();
        let of = |contender: &Contender| problems * f64::from(contender.repeats) * swept as f64;
        let trials: f64 = self.contenders.iter().map(of).sum();
        let largest = self.contenders.iter().max_by_key(|contender| contender.repeats);
        if let Some(largest) = largest.filter(|_| trials > TRIALS) {
            let message = format!(
                "the study has {trials:.1e} trials: {problems:.0} problems by {} contenders, up to {} seeds each, at {swept} \
                 points of the sweeps; at most {TRIALS:.0e} are accepted",
                self.contenders.len(),
                largest.repeats
            );
            let widest = families.iter().max_by_key(|(group, _)| group.instances).map(|(group, _)| *group);
            let place = match widest.filter(|group| group.instances > largest.repeats) {
                Some(group) => format!("problems.{}.instances", group.place),
                None => format!("contender.{}.repeats", largest.place),
            };
            faults.add(self.document.error_at(&place, message));
        }
        let timed = self.timing.map_or(0.0, |timing| f64::from(timing.problems) * f64::from(timing.repeats));
        if timed > TIMED {
            let message = format!("{timed:.1e} runs are timed; at most {TIMED:.0e} are accepted");
            faults.add(self.document.error_at("timing.repeats", message));
        }
    }

    /// Refuses instances and seeds beyond those that there are.
    fn check_shown(&self, shown: &[TrialsSpec], place: &str, faults: &mut Faults) {
        for (index, trials) in shown.iter().enumerate() {
            let group = self.groups.iter().find(|group| group.label == trials.problems);
            let of = |label: &String| self.contenders.iter().find(|contender| contender.label == *label);
            let contender = trials.contender.as_ref().and_then(of);
            let limits = [
                ("instances", Some(trials.instances), group.map(|group| group.instances)),
                (
                    "also",
                    trials.also.iter().max().map(|last| last.saturating_add(1)),
                    group.map(|group| group.instances),
                ),
                ("repeats", trials.repeats, contender.map(|contender| contender.repeats)),
            ];
            for (key, wanted, there_are) in limits {
                if let Some((wanted, there_are)) =
                    wanted.zip(there_are).filter(|(wanted, there)| wanted > there)
                {
                    let message =
                        format!("`{key}` is {wanted}; there are {there_are}, and no more is accepted");
                    let fault = self.document.error_at(&format!("{place}.{index}.{key}"), message);
                    faults.add(fault.about(&labels_of(&self.name)));
                }
            }
        }
    }
}
