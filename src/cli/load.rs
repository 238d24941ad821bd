//! Loads a paper as the flags ask for it.

use super::places::Places;
use super::schema::schema_of_any_names;
use super::{Failure, How, Which};
use crate::analysis::claims;
use base::settings::Faults;
use study::paper::Paper;

/// The paper as far as it can be read, with every claim's checks, figure and table understood; everything that is wrong goes
/// to `faults`.
pub fn gather(places: &Places, faults: &mut Faults) -> Result<Option<Paper>, Failure> {
    let paper = Paper::gather(&places.folder, &places.inputs, &schema_of_any_names, faults)?;
    if let Some(paper) = &paper {
        faults.keep(claims::validate(paper));
        faults.keep(crate::render::figure::validate(paper));
        faults.keep(crate::render::results::validate(paper));
    }
    Ok(paper)
}

/// Where the paper that `which` names lies, and the paper, both as the flags ask for them.
pub fn open(which: &Which, how: &How) -> Result<(Places, Paper), Failure> {
    let places = Places::find(which, &how.variant())?;
    let paper = load(&places, how)?;
    Ok((places, paper))
}

/// The paper as the flags ask for it.
pub fn load(places: &Places, how: &How) -> Result<Paper, Failure> {
    let mut faults = Faults::default();
    let paper = gather(places, &mut faults)?;
    let Some(paper) = paper.filter(|_| faults.is_empty()) else { return Err(faults.error().into()) };
    let paper = how.apply(paper);
    how.check_with(&paper)?;
    Ok(paper)
}
