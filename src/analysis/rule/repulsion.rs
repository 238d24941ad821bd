//! Whether a printed repulsive potential falls along the printed force, and has a value at contact.
//!
//! The potential is U(d) = (1/d − 1/d0)² / 2 for d ≤ d0, with the gain left out, and the printed force is
//! f = (1/d0 − 1/d) / d² per unit of distance (Tang et al. 2023, eqs. 21 and 24).

use super::{Entry, Rule};
use crate::analysis::class::Outcome;
use crate::analysis::evidence::Evidence;
use crate::analysis::found::Found;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "repulsion",
    about: "does a printed repulsive potential fall along its printed force, and has it a value at contact?",
    settings: Accepted::of::<Settings>(),
    example: r#"
range_cm = 5.0
question = "falls_along_force"
"#,
    build: |context| {
        let settings: Settings = context.settings.read()?;
        if !(settings.range_cm.is_finite() && settings.range_cm > 0.0) {
            let message = format!("range_cm is {}; more than 0 is accepted", settings.range_cm);
            return Err(context.settings.error_at("range_cm", message));
        }
        Ok(Box::new(settings))
    },
};

/// Distances at which the sign is tried, as shares of the range.
const TRIED: usize = 99;

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The potential's range d0.
    range_cm: f64,
    /// What is asked of the potential as printed.
    question: Question,
}

#[derive(Deserialize, JsonSchema, Clone, Copy)]
#[serde(rename_all = "snake_case")]
enum Question {
    /// Does U fall along f?
    FallsAlongForce,
    /// Is U finite at the distance 0 to which d is clamped?
    FiniteAtContact,
}

impl Settings {
    fn potential(&self, d: f64) -> f64 {
        0.5 * (1.0 / d - 1.0 / self.range_cm).powi(2)
    }

    fn force(&self, d: f64) -> f64 {
        (1.0 / self.range_cm - 1.0 / d) / (d * d)
    }

    /// At how many of the tried distances a small step along the force lowers the potential.
    fn falls(&self) -> usize {
        let step = 1e-6 * self.range_cm;
        let lowers = |k: &usize| {
            let d = self.range_cm * *k as f64 / (TRIED + 1) as f64;
            self.potential(d + step * self.force(d).signum()) < self.potential(d)
        };
        (1..=TRIED).filter(lowers).count()
    }
}

impl Rule for Settings {
    fn find(&self, _evidence: &Evidence<'_>) -> Found {
        let (holds, because, premise) = match self.question {
            Question::FallsAlongForce => {
                let falls = self.falls();
                let text = format!(
                    "a step along f lowers U at {falls} of {TRIED} distances between 0 and d0; f is +∂U/∂X, as eq. 23 says, so U rises along it"
                );
                (falls == TRIED, text, "eqs. 21, 23 and 24 are read as printed")
            }
            Question::FiniteAtContact => {
                let at_contact = self.potential(0.0);
                let text = format!("U(0) is {at_contact}: 1/d has no value where eq. 6 sets d to 0");
                (at_contact.is_finite(), text, "the distance of eq. 6 is the one in eq. 21, as eq. 19 says")
            }
        };
        Found {
            outcome: Some(if holds { Outcome::Holds } else { Outcome::Proved }),
            because: vec![because],
            premises: vec![premise.to_owned()],
            ..Found::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_printed_force_is_the_potentials_slope_so_that_the_potential_rises_along_it() {
        let settings = Settings { range_cm: 5.0, question: Question::FallsAlongForce };
        for d in [0.5, 2.0, 4.9] {
            let slope = (settings.potential(d + 1e-6) - settings.potential(d - 1e-6)) / 2e-6;
            assert!((slope - settings.force(d)).abs() < 1e-6 * slope.abs().max(1.0), "{d}");
        }
        assert_eq!(settings.falls(), 0);
    }
}
