//! What stands on everything drawn or written of records that are not the study's own: quick runs, other readings.

use crate::analysis::evidence::default_point;
use crate::analysis::verdict::Verdicts;
use crate::study::ReadingChoice;
use crate::study::paper::Paper;

/// What every output of a quick run says.
pub const QUICK: &str = "Quick run: few replicates, not the study's result.";

/// The sentences that every output of these verdicts carries; none for a full run under the default readings.
pub fn marks(paper: &Paper, verdicts: &Verdicts) -> Vec<String> {
    let quick = verdicts.quick.then(|| QUICK.to_owned());
    let point = ReadingChoice::new(&paper.readings(), &verdicts.reading).ok();
    let other = point.filter(|point| *point != default_point(paper));
    let reading = other.map(|point| {
        format!(
            "Reading: {}; what captions and notes say of results holds for the default readings.",
            point.name()
        )
    });
    quick.into_iter().chain(reading).collect()
}
