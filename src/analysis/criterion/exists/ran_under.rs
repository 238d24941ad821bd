//! Under which interpretations the trials of a contender count.

use study::paper::Paper;
use study::{Choice, Contender, Interpretation, Study};

/// Whether trials of `contender` are what they would be under all of `point`; `study` runs it as far as it inherits the
/// choices. A choice that the contender departs from is taken as it departs. A choice that the study does not inherit
/// is at its default or cannot touch it.
pub(super) fn ran_under(paper: &Paper, study: &Study, contender: &Contender, point: &Interpretation) -> bool {
    let groups: Vec<_> = study.groups.iter().collect();
    let inherits = |choice: &Choice| study.choices.iter().any(|own| own.id == choice.id);
    paper.choices.iter().all(|choice| {
        let Some(taken) = point.options().get(&choice.id) else { return true };
        match contender.departs.get(&choice.id) {
            Some(own) => own == taken,
            None => inherits(choice) || !choice.moves(taken, &groups, &[contender]),
        }
    })
}
