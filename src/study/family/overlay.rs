//! A TOML file that a problem names, with settings laid over what it says.

use base::settings::{Document, Settings, SettingsError};
use std::path::Path;
use toml::{Table, Value};

/// The document at `file` with `over`, which the settings have under `key`, laid over it: table by table, and in a list by an
/// element's number from 0 or by its `name`.
///
/// # Errors
/// The file cannot be read or is no TOML, reported there; `over` names an element that is not there, reported at the key.
pub(super) fn overlaid(
    settings: &Settings,
    key: &str,
    over: &Table,
    file: &Path,
) -> Result<std::sync::Arc<Document>, SettingsError> {
    let document = Document::open(file)?;
    let mut table: Table = document.read_stored()?;
    lay(&mut table, over, key).map_err(|message| settings.error_at(key, message))?;
    let text = toml::to_string(&table).expect("a table that was read can be written");
    Ok(Document::new(file, text))
}

/// Lays `over`, which stands at `way`, over `table`.
pub fn lay(table: &mut Table, over: &Table, way: &str) -> Result<(), String> {
    for (key, value) in over {
        match (table.get_mut(key), value) {
            (Some(Value::Table(under)), Value::Table(inner)) => lay(under, inner, &format!("{way}.{key}"))?,
            (Some(Value::Array(elements)), Value::Table(inner)) => {
                let way = format!("{way}.{key}");
                for (wanted, value) in inner {
                    match (named(elements, wanted), value) {
                        (Some(Value::Table(under)), Value::Table(inner)) => {
                            lay(under, inner, &format!("{way}.{wanted}"))?;
                        }
                        (Some(under), value) if !under.is_table() && !value.is_table() => {
                            *under = value.clone();
                        }
                        _ => {
                            return Err(format!(
                                "{way}: there is no table `{wanted}`; a number from 0 or a `name` is accepted"
                            ));
                        }
                    }
                }
            }
            _ => {
                table.insert(key.clone(), value.clone());
            }
        }
    }
    Ok(())
}

/// The element of this number or `name` among `elements`.
fn named<'e>(elements: &'e mut [Value], wanted: &str) -> Option<&'e mut Value> {
    let is_it = |value: &Value| value.get("name").and_then(Value::as_str) == Some(wanted);
    let at = wanted.parse().ok().or_else(|| elements.iter().position(is_it))?;
    elements.get_mut(at)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn laid(over: &str) -> Result<Table, String> {
        let under = "tool_mm = 1\n[support]\nunder = \"floor\"\nyaw_deg = 0\n[[box]]\nname = \"a\"\nsize = 1\n[[box]]\nname = \"b\"\nmin_mm = [0, 0]\n";
        let mut table: Table = toml::from_str(under).unwrap();
        lay(&mut table, &toml::from_str(over).unwrap(), "with").map(|()| table)
    }

    #[test]
    fn tables_are_laid_over_tables_and_elements_go_by_number_or_name() {
        let table = laid("tool_mm = 2\nsupport.yaw_deg = 9\nbox.a.size = 3\nbox.1.size = 4").unwrap();
        let expected = "tool_mm = 2\n[support]\nunder = \"floor\"\nyaw_deg = 9\n[[box]]\nname = \"a\"\nsize = 3\n[[box]]\nname = \"b\"\nsize = 4\nmin_mm = [0, 0]\n";
        assert_eq!(table, toml::from_str(expected).unwrap());
        let min = |over: &str| laid(over).unwrap()["box"][1]["min_mm"].clone();
        assert_eq!(min("box.b.min_mm.1 = 5"), Value::Array(vec![0.into(), 5.into()]));
        for over in ["box.c.size = 1", "box.2.size = 1", "box.a = 1", "box.b.min_mm.2 = 1"] {
            assert!(laid(over).unwrap_err().contains(": there is no table `"), "{over}");
        }
    }
}
