//! Whether a formula of the paper, evaluated as it is printed, gives what the text says of it.
//!
//! What is one paper's mathematics is no rule of its own: it stands under a name in [`proofs::formula::REGISTRY`].

use super::{Entry, decided, rule};
use crate::analysis::criterion_result::CriterionResult;
use base::settings::Accepted;
use proofs::formula;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "formula",
    about: "does a formula of the paper, evaluated as printed, give what the text says of it?",
    revision: |_| 1,
    question: |_| None,
    settings: Accepted::shape::<Settings>(),
    example: r#"
name = "forbidden_disc"
with = { l1 = 25.0, l2 = 15.0, radius = 10.0 }
"#,
    build: |context| {
        let Settings { name, with } = context.settings.read()?;
        let Some(formula) = formula::find(&name) else {
            let known: Vec<&str> = formula::REGISTRY.iter().map(|formula| formula.name).collect();
            let message = format!("no formula is called `{name}`; the formulas are {}", known.join(", "));
            return Err(context.settings.error_at("name", message));
        };
        let numbers = formula.numbers(&with).map_err(|message| context.settings.error_at("with", message))?;
        let existential = formula.is_existential;
        Ok(rule(move |_, _| CriterionResult { existential, ..decided((formula.prove)(&numbers)) }))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The formula, by its name in the package of audits.
    name: String,
    /// What it is evaluated with, by the names that the formula gives.
    with: BTreeMap<String, f64>,
}
