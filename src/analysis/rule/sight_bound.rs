//! Whether a printed length, or a saving, is possible for a straightened path, given the cost of A*'s.

use super::{Entry, refused, rule};
use crate::analysis::context::Context;
use crate::analysis::found::Found;
use audit::lattice::Octile;
use audit::proof::{self, Ends};
use base::settings::{Accepted, SettingsError};
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "sight_bound",
    about: "can a path with free lines of sight be so short, or save so much, where the 8-connected optimum is known?",
    settings: Accepted::of::<Settings>(),
    example: r#"
size = [30, 30]
start = [28, 19]
goal = [13, 16]
optimum = [12, 4]
because = "A*'s path costs 12 + 4√2: no path has the printed 17.56, and 17.65, with two digits swapped, is this cost cut off"
of = "length"
holds_when = { corner_cutting = ["allow"] }
"#,
    build: |context| {
        let Settings { size, start, goal, optimum: [straight, diagonal], because, of, holds_when } =
            context.settings.read()?;
        check_options(context, &holds_when)?;
        let choices = context.point.choices();
        let holds = holds_when.iter().all(|(id, options)| options.contains(&choices[id]));
        let (print, ends, optimum) =
            (context.print()?, Ends { size, start, goal }, Octile { straight, diagonal });
        Ok(rule(move |_| {
            let is_saving = of == Of::SavingPercent;
            let mut found = refused(proof::sight_bound(print, is_saving, ends, optimum, &because));
            found.because.extend((!holds).then(|| "the bound does not hold under this reading".to_owned()));
            let listed = |(id, options): (&String, &Vec<String>)| format!("{id} is {}", options.join(" or "));
            found.premises.extend(holds_when.iter().map(listed));
            Found { without_premises: !holds, ..found }
        }))
    },
};

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Settings {
    /// The map's columns and rows.
    size: [i32; 2],
    /// The column and row of the start cell.
    start: [i32; 2],
    /// The column and row of the goal cell.
    goal: [i32; 2],
    /// Straight and diagonal moves of A*'s path.
    optimum: [u32; 2],
    /// Why A*'s path is taken to have these moves.
    because: String,
    /// What the bound is on.
    of: Of,
    /// Readings with the options under which the bound holds.
    holds_when: BTreeMap<String, Vec<String>>,
}

/// What is printed.
#[derive(Deserialize, JsonSchema, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum Of {
    /// A length in cells.
    Length,
    /// A saving in per cent of the optimum.
    SavingPercent,
}

/// Refuses readings and options that the paper does not have.
fn check_options(
    context: &Context<'_>,
    holds_when: &BTreeMap<String, Vec<String>>,
) -> Result<(), SettingsError> {
    let readings = context.paper.readings();
    for (id, options) in holds_when {
        let reading = readings.iter().find(|reading| reading.id == *id);
        let known: Vec<&String> = reading.iter().flat_map(|reading| reading.options.keys()).collect();
        if let Some(unknown) = options.iter().find(|option| !known.contains(option)) {
            let known = known.iter().map(|option| option.as_str()).collect::<Vec<_>>().join(", ");
            let message = format!("`holds_when` asks for {id}={unknown}; the options are {known}");
            return Err(context.settings.error_at(&format!("holds_when.{id}"), message));
        }
    }
    Ok(())
}
