//! Whether the points that a two-link arm cannot take, takes only stretched or folded, or is kept from by a stop of joint 2 reach
//! as far as stated.

use super::{Entry, decided, rule};
use audit::proof;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "reach_ring",
    about: "can reach, singularity or a stop of joint 2 of a planar two-link arm forbid an inner disc of the radius stated?",
    settings: Accepted::of::<Settings>(),
    example: "
links_cm = [30.0, 20.0]
radius_cm = 20.0
",
    build: |context| {
        let Settings { links_cm, radius_cm } = context.settings.read()?;
        if !links_cm.iter().all(|link| link.is_finite() && *link > 0.0) {
            let message = format!("links_cm is {links_cm:?}; two lengths above 0 are accepted");
            return Err(context.settings.error_at("links_cm", message));
        }
        Ok(rule(move |_| decided(proof::reach_ring(links_cm, radius_cm))))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The lengths of the two links.
    links_cm: [f64; 2],
    /// The radius that the inner forbidden disc is said to have.
    radius_cm: f64,
}
