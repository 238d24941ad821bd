//! Whether every printed number that is said to be above another is.

use super::{Entry, refused, rule};
use audit::proof;
use base::settings::Accepted;
use schemars::JsonSchema;
use serde::Deserialize;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "printed_above",
    about: "is every printed number that is said to be above another one above it?",
    settings: Accepted::of::<Settings>(),
    example: r#"
above = ["t2.improved.100", "t2.improved.200"]
below = ["t2.original.100", "t2.original.200"]
"#,
    build: |context| {
        let Settings { above, below } = context.settings.read()?;
        if above.len() != below.len() {
            let (above, below) = (above.len(), below.len());
            let message = format!("`above` names {above} claims and `below` {below}; as many are accepted");
            return Err(context.settings.error_at("below", message));
        }
        let print = |id: &String| Ok((id.clone(), context.print_of(id)?.printed.value()));
        let pairs = above.iter().zip(&below).map(|(above, below)| Ok([print(above)?, print(below)?]));
        let pairs = pairs.collect::<Result<Vec<_>, _>>()?;
        Ok(rule(move |_| refused(proof::printed_above(&pairs))))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The claims that print what is said to be higher.
    above: Vec<String>,
    /// The claims that print what each of them is above.
    below: Vec<String>,
}
