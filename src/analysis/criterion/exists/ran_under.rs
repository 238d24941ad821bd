//! Under which readings the trials of a contender count.

use study::paper::Paper;
use study::{Contender, Reading, ReadingChoice, Study};

/// Whether trials of `contender`, of `study` run as far as it has the readings of `point`, are what they would be under all of
/// `point`: what it departs from is taken as it departs, and what the study does not have is at its default or cannot touch it.
pub(super) fn ran_under(paper: &Paper, study: &Study, contender: &Contender, point: &ReadingChoice) -> bool {
    let entries = || contender.stages.iter().map(|stage| stage.entry.name);
    let has = |axis: &Reading| study.readings.iter().any(|own| own.id == axis.id);
    let agrees = |axis: &Reading| {
        let Some(taken) = point.choices().get(&axis.id) else { return true };
        match contender.departs.get(&axis.id) {
            Some(own) => own == taken,
            None => has(axis) || !axis.touches(taken, entries()),
        }
    };
    // Each study says what a reading's options do to the planners that it runs.
    paper.studies.iter().flat_map(|study| &study.readings).all(agrees)
}
