//! Whether the points that a two-link arm cannot take, or takes only stretched or folded, reach as far as stated.

use super::{Entry, Rule};
use crate::analysis::class::Outcome;
use crate::analysis::evidence::Evidence;
use crate::analysis::found::Found;
use base::settings::Accepted;
use engine::kinematics::planar_2r::Planar2r;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "reach_ring",
    about: "do reach and singularity of a planar two-link arm forbid an inner disc of the radius stated?",
    settings: Accepted::of::<Settings>(),
    example: "
links_cm = [30.0, 20.0]
radius_cm = 20.0
",
    build: |context| {
        let settings: Settings = context.settings.read()?;
        let [l1, l2] = settings.links_cm;
        let arm = Planar2r::new(l1, l2)
            .map_err(|e| context.settings.error_at("links_cm", format!("links_cm: {e}")))?;
        Ok(Box::new(ReachRing { settings, arm }))
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

struct ReachRing {
    settings: Settings,
    arm: Planar2r,
}

impl Rule for ReachRing {
    fn find(&self, _evidence: &Evidence<'_>) -> Found {
        let Settings { links_cm: [l1, l2], radius_cm } = self.settings;
        let inner = (l1 - l2).abs();
        let mut because =
            vec![format!("arms of {l1} and {l2} cm reach every point from |{l1} - {l2}| = {inner} cm on")];
        let between = inner.midpoint(radius_cm);
        if let Ok(both) = self.arm.inverse(&[between, 0.0].into()) {
            let q2 = both.negative[1];
            because.push(format!(
                "at {between} cm from the base, between the two radii, θ2 is {:.1}° and |sin θ2| {:.2}: reached, and not \
                 singular",
                q2.to_degrees(),
                libm::sin(q2).abs()
            ));
        }
        let is_right = (inner - radius_cm).abs() < 1e-9;
        because.push(if is_right {
            format!("the stated {radius_cm} cm are that radius")
        } else {
            format!("the stated {radius_cm} cm are not that radius")
        });
        let premise = "what singularity and different link lengths forbid is what the arm cannot reach or reaches only \
                       stretched or folded";
        Found {
            outcome: Some(if is_right { Outcome::Holds } else { Outcome::Proved }),
            because,
            premises: vec![premise.to_owned()],
            ..Found::default()
        }
    }
}
