//! Curves along a sweep, with values under the pointer.

use super::PageError;
use crate::analysis::evidence::Evidence;
use crate::analysis::verdict::Verdicts;
use crate::render::figure::{Curves, Scene, build};

/// The curves of every figure that has some.
///
/// # Errors
/// A figure that cannot be built.
pub fn all(evidence: &Evidence<'_>, verdicts: &Verdicts) -> Result<Vec<Curves>, PageError> {
    let mut found = Vec::new();
    for run in evidence.runs() {
        for spec in &run.study.figures {
            let kind = build(spec, run.study, evidence.paper).map_err(crate::render::RenderError::from)?;
            found.extend(kind.curves(&Scene { evidence, run, verdicts }, &spec.caption));
        }
    }
    Ok(found)
}
