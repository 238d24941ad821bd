//! Whether a printed distance is that between the two printed points.

use super::{Entry, decided, rule};
use crate::analysis::criterion_result::CriterionResult;
use crate::analysis::verdict::Estimate;
use base::settings::Accepted;
use proofs::proof;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "point_distance",
    about: "is a printed distance that between two printed points?",
    revision: |_| 1,
    question: |_| None,
    settings: Accepted::shape::<Settings>(),
    example: "
from = [2.5, 2.5]
to = [36.5, 30.5]
",
    build: |context| {
        let Settings { from, to } = context.settings.read()?;
        let print = context.print()?;
        Ok(rule(move |_, _| {
            let (distance, proof) = proof::point_distance(print, from, to);
            let ours = Estimate::bare(distance, "computed from the printed points", 1);
            CriterionResult { ours: Some(ours), ..decided(proof) }
        }))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// x and y of the first point as printed.
    from: [f64; 2],
    /// x and y of the second point as printed.
    to: [f64; 2],
}
