//! Whether any regular octagon about a lattice point holds a stated number of other lattice points.

use super::{Entry, decided, rule};
use crate::analysis::found::Found;
use audit::proof;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "octagon_nodes",
    about: "is there a regular octagon about a lattice point that holds as many other lattice points as stated?",
    settings: Accepted::of::<Settings>(),
    example: "
nodes = 48
",
    build: |context| {
        let Settings { nodes } = context.settings.read()?;
        if nodes == 0 || nodes > 10_000 {
            return Err(context
                .settings
                .error_at("nodes", format!("nodes is {nodes}; 1 to 10000 is accepted")));
        }
        Ok(rule(move |_| Found { existential: true, ..decided(proof::octagon_nodes(nodes)) }))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// How many lattice points beside the middle.
    nodes: usize,
}
