//! Replies of authors and others to verdicts, word for word.

use super::{Paper, cells_named};
use base::settings::{Faults, Spanned};
use base::text::one_line;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// The most characters of a reply.
const MOST_OF_TEXT: usize = 2000;

/// The most characters of a name.
const MOST_OF_WHO: usize = 200;

/// A reply as written.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ReplySpec {
    /// Who replies, and as what: `A. Author, first author`.
    who: Spanned<String>,
    /// The day of the reply, as 2026-01-31.
    date: Spanned<String>,
    /// The reply, word for word, in at most 2000 characters.
    text: Spanned<String>,
    /// The claims that it is about; a name that ends in `.*` stands for all cells of tables that begin so.
    #[schemars(length(min = 1))]
    claims: Vec<Spanned<String>>,
}

/// A reply.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reply {
    /// Who replies.
    pub who: String,
    /// The day.
    pub date: String,
    /// The reply.
    pub text: String,
    /// The claims that it is about.
    pub claims: Vec<String>,
}

impl Reply {
    /// Who replied when, and what.
    pub fn line(&self) -> String {
        format!("reply of {}, {}: {}", self.who, self.date, self.text)
    }
}

/// Whether `text` is a day of the calendar, as 2026-01-31.
pub fn is_day(text: &str) -> bool {
    let parts: Vec<&str> = text.split('-').collect();
    let is_number = |part: &&str| part.bytes().all(|byte| byte.is_ascii_digit());
    let lengths: Vec<usize> = parts.iter().map(|part| part.len()).collect();
    if lengths != [4, 2, 2] || !parts.iter().all(is_number) {
        return false;
    }
    let [year, month, day] = [0, 1, 2].map(|at: usize| parts[at].parse::<u32>().unwrap_or(0));
    let is_leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    let last = match month {
        2 => 28 + u32::from(is_leap),
        4 | 6 | 9 | 11 => 30,
        1..=12 => 31,
        _ => 0,
    };
    (1..=last).contains(&day)
}

impl Paper {
    /// The replies of `specs`; days that are none, texts that are empty or too long, and claims that do not exist go to `faults`.
    pub(super) fn read_replies(&mut self, specs: &[ReplySpec], faults: &mut Faults) {
        let claims: BTreeSet<&str> = self.claims.iter().map(|claim| claim.id.as_str()).collect();
        for spec in specs {
            self.check_named(&spec.claims, &claims, faults);
            let date = spec.date.get_ref();
            if !is_day(date) {
                let message = format!("`date` is \"{}\"; a day as 2026-01-31 is accepted", one_line(date));
                faults.add(self.document.error(spec.date.span(), message));
            }
            for (what, text, most) in [("who", &spec.who, MOST_OF_WHO), ("text", &spec.text, MOST_OF_TEXT)] {
                let count = text.get_ref().trim().chars().count();
                if !(1..=most).contains(&count) {
                    let message = format!("`{what}` has {count} characters; 1 to {most} are accepted");
                    faults.add(self.document.error(text.span(), message));
                }
            }
        }
        let reply = |spec: &ReplySpec| Reply {
            who: spec.who.get_ref().trim().to_owned(),
            date: spec.date.get_ref().clone(),
            text: spec.text.get_ref().trim().to_owned(),
            claims: spec
                .claims
                .iter()
                .flat_map(|name| cells_named(name.get_ref(), &self.cells))
                .map(str::to_owned)
                .collect(),
        };
        self.replies = specs.iter().map(reply).collect();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_day_is_one_of_the_calendar() {
        for (text, is) in [
            ("2026-01-31", true),
            ("2024-02-29", true),
            ("2000-02-29", true),
            ("2026-02-29", false),
            ("1900-02-29", false),
            ("2026-04-31", false),
            ("2026-00-10", false),
            ("2026-13-01", false),
            ("2026-01-00", false),
            ("26-01-01", false),
            ("2026-+1-01", false),
            ("31.1.2026", false),
            ("", false),
        ] {
            assert_eq!(is_day(text), is, "{text}");
        }
    }
}
