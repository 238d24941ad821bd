//! Whether a printed repulsive potential falls along the printed force, and has a value at contact.
//!
//! The potential is U(d) = (1/d − 1/d0)² / 2 for d ≤ d0, with the gain left out, and the printed force is
//! f = (1/d0 − 1/d) / d² per unit of distance (Tang et al. 2023, eqs. 21 and 24).

use super::{Entry, decided, rule};
use audit::proof;
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
        let Settings { range_cm, question } = context.settings.read()?;
        if !(range_cm.is_finite() && range_cm > 0.0) {
            let message = format!("range_cm is {range_cm}; more than 0 is accepted");
            return Err(context.settings.error_at("range_cm", message));
        }
        let prove = match question {
            Question::FallsAlongForce => proof::repulsion_along_force,
            Question::FiniteAtContact => proof::repulsion_at_contact,
        };
        Ok(rule(move |_| decided(prove(range_cm))))
    },
};

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
