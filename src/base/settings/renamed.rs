//! Words that were renamed, as data/renamed.toml lists them.

use std::collections::BTreeMap;
use std::sync::OnceLock;
use toml::{Table, Value};

const LIST: &str = include_str!("../../../data/renamed.toml");

/// The old words in `section` of the list, each with what is written now.
///
/// # Panics
/// If there is no such section.
pub fn renamed(section: &str) -> &'static BTreeMap<String, String> {
    static READ: OnceLock<BTreeMap<String, BTreeMap<String, String>>> = OnceLock::new();
    &READ.get_or_init(|| toml::from_str(LIST).expect("the list is words in tables"))[section]
}

/// That `key` of a spec was renamed or moved, if it was.
pub(super) fn renamed_key(key: &str) -> Option<String> {
    let now = renamed("keys").get(key)?;
    let advice = if now.contains(' ') { now.clone() } else { format!("it is `{now}` now") };
    Some(format!("`{key}` is no key here: {advice}"))
}

/// Keys and names of specs, each with the word that it had when what hashes it was first stored.
const FIRST_WORDS: [(&str, &str); 2] = [("families", "of"), ("select", "of")];

/// The word that hashes have for `name`.
pub fn first_word(name: &str) -> &str {
    FIRST_WORDS.iter().find(|(now, _)| *now == name).map_or(name, |(_, first)| first)
}

/// `table`, and the tables in it, with the keys that hashes have.
pub fn in_first_words(table: &Table) -> Table {
    fn inside(value: &Value) -> Value {
        match value {
            Value::Table(table) => Value::Table(in_first_words(table)),
            Value::Array(values) => Value::Array(values.iter().map(inside).collect()),
            other => other.clone(),
        }
    }
    table.iter().map(|(key, value)| (first_word(key).to_owned(), inside(value))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_word_is_renamed_twice_but_where_a_key_moved() {
        for section in ["keys", "names", "command_line", "columns", "parts", "stored"] {
            let words = renamed(section);
            for (old, new) in words {
                assert!(!words.contains_key(new), "{section}: {old} is {new}, which is renamed too");
            }
        }
    }

    #[test]
    fn an_old_key_is_reported_with_the_new_one() {
        let expected = "`replicates` is no key here: it is `instances` now";
        assert_eq!(renamed_key("replicates").as_deref(), Some(expected));
        assert!(renamed_key("ledger").unwrap().ends_with("`inventory` now"));
        assert_eq!(renamed_key("instances"), None);
    }

    #[test]
    fn hashes_have_the_keys_that_were_written_first() {
        let table = |text: &str| toml::from_str(text).unwrap();
        let now = "select = { study = 's' }\nrows = [{ select = { metric = 'm' } }]\nthat = 'select'";
        let first = "of = { study = 's' }\nrows = [{ of = { metric = 'm' } }]\nthat = 'select'";
        assert_eq!(in_first_words(&table(now)), table(first));
        assert_eq!(
            in_first_words(&table("families = [1]\nstage = 'astar'")),
            table("of = [1]\nstage = 'astar'")
        );
    }
}
