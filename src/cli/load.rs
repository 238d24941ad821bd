//! Loading a paper as the flags ask for it.

use super::file_schema::with_the_rest;
use super::places::Places;
use super::{Failure, How};
use crate::analysis::claims;
use crate::study::StudyError;
use crate::study::paper::Paper;
use base::settings::Faults;

/// The paper as the flags ask for it, with every claim's checks understood.
pub fn load(places: &Places, how: &How) -> Result<Paper, Failure> {
    let paper = Paper::load(&places.folder, &places.inputs).map_err(|error| match error {
        StudyError::Settings(fault) => StudyError::Settings(with_the_rest(fault, &places.folder)),
        other => other,
    })?;
    let paper = how.apply(paper);
    how.check_readings(&paper)?;
    let mut faults = Faults::default();
    faults.keep(claims::validate(&paper));
    faults.keep(crate::render::figure::validate(&paper));
    faults.keep(crate::render::results::validate(&paper));
    faults.done()?;
    Ok(paper)
}
