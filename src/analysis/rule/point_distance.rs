//! Whether a printed distance is that between the two printed points.

use super::{Entry, decided, rule};
use crate::analysis::found::Found;
use crate::analysis::verdict::Estimate;
use audit::proof;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "point_distance",
    about: "is a printed distance that between two printed points?",
    revision: |_| 1,
    settings: Accepted::of::<Settings>(),
    example: "
from = [22.5, 15.5]
to = [26.5, 28.5]
",
    build: |context| {
        let (Settings { from, to }, print) = (context.settings.read()?, context.print()?);
        Ok(rule(move |_| {
            let (distance, proof) = proof::point_distance(print, from, to);
            let ours = Estimate::bare(distance, "computed from the printed points", 1);
            Found { ours: Some(ours), ..decided(proof) }
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
