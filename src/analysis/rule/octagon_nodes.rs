//! Whether any regular octagon about a lattice point holds a stated number of other lattice points.

use super::{Entry, Rule};
use crate::analysis::class::Outcome;
use crate::analysis::evidence::Evidence;
use crate::analysis::found::Found;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;
use std::f64::consts::FRAC_PI_8;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "octagon_nodes",
    about: "is there a regular octagon about a lattice point that holds as many other lattice points as stated?",
    settings: Accepted::of::<OctagonNodes>(),
    example: "
nodes = 48
",
    build: |context| {
        let settings: OctagonNodes = context.settings.read()?;
        if settings.nodes == 0 || settings.nodes > 10_000 {
            let message = format!("nodes is {}; 1 to 10000 is accepted", settings.nodes);
            return Err(context.settings.error_at("nodes", message));
        }
        Ok(Box::new(settings))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct OctagonNodes {
    /// How many lattice points beside the middle.
    nodes: usize,
}

/// The least circumradius of an octagon about the origin that holds the point; with corners on the axes, or with sides
/// square to them.
fn circumradius([x, y]: [i32; 2], is_cornered: bool) -> f64 {
    let (s, c) = libm::sincos(FRAC_PI_8);
    let (x, y) = (f64::from(x.abs()), f64::from(y.abs()));
    let apothem = if is_cornered {
        f64::max(x * c + y * s, x * s + y * c)
    } else {
        x.max(y).max((x + y) / std::f64::consts::SQRT_2)
    };
    apothem / c
}

/// How many points octagons of rising size hold, with the circumradius from which each does.
fn counts(nodes: usize, is_cornered: bool) -> Vec<(usize, f64)> {
    // An octagon of apothem a holds the block of side 2 ⌊a/√2⌋ + 1, so that this reach is enough.
    let reach = libm::sqrt(nodes as f64) as i32 + 3;
    let axis = || -reach..=reach;
    let points = axis().flat_map(|x| axis().map(move |y| [x, y])).filter(|point| *point != [0, 0]);
    let mut radii: Vec<f64> = points.map(|point| circumradius(point, is_cornered)).collect();
    radii.sort_by(f64::total_cmp);
    let is_last = |k: &usize| radii.get(k + 1).is_none_or(|next| next - radii[*k] > 1e-9);
    let steps = (0..radii.len()).filter(is_last).map(|k| (k + 1, radii[k]));
    let mut kept = Vec::new();
    for step in steps {
        kept.push(step);
        if step.0 >= nodes {
            break;
        }
    }
    kept
}

impl Rule for OctagonNodes {
    fn find(&self, _evidence: &Evidence<'_>) -> Found {
        let mut all = Found { existential: true, ..Found::default() };
        let mut exists = false;
        for (is_cornered, how) in
            [(true, "with corners on the axes"), (false, "with sides square to the axes")]
        {
            let found = counts(self.nodes, is_cornered);
            let listed: Vec<String> = found.iter().map(|(count, _)| count.to_string()).collect();
            let hit = found.iter().find(|(count, _)| *count == self.nodes);
            let said = match hit {
                Some((_, radius)) => format!("{} from a circumradius of {radius:.4} on", self.nodes),
                None => format!("never {}", self.nodes),
            };
            all.because.push(format!(
                "regular octagons of any size about a lattice point, {how}, hold {} others: {said}",
                listed.join(", ")
            ));
            exists |= hit.is_some();
        }
        all.outcome = Some(if exists { Outcome::Holds } else { Outcome::Proved });
        all.premises.push(
            "the octagon is regular, centred on the node, and turned in one of these two ways".to_owned(),
        );
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_those_of_pointing_at_every_lattice_point() {
        let at = |is_cornered: bool, radius: f64| {
            let all = (-9..=9).flat_map(|x| (-9..=9).map(move |y| [x, y]));
            all.filter(|p| *p != [0, 0] && circumradius(*p, is_cornered) <= radius + 1e-9).count()
        };
        assert_eq!([1.0, 2.0, 3.0, 4.0, 5.0].map(|r| at(true, r)), [4, 12, 28, 48, 72]);
        let apothems = [1.0, 2.0, 3.0, 4.0, 5.0].map(|a: f64| at(false, a / libm::cos(FRAC_PI_8)));
        assert_eq!(apothems, [4, 12, 36, 56, 96]);
        assert!(counts(48, true).iter().any(|(count, radius)| *count == 48 && (radius - 4.0).abs() < 1e-9));
        assert!(counts(47, true).iter().chain(&counts(47, false)).all(|(count, _)| *count != 47));
    }
}
