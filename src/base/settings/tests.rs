use super::*;
use schemars::JsonSchema;
use serde::Deserialize;
use std::path::Path;
use toml::Table;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Outer {
    #[serde(rename = "part")]
    parts: Vec<Part>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Part {
    #[schemars(with = "AnyTable")]
    settings: Spanned<Table>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[expect(dead_code, reason = "read by the deserializer only")]
struct Inner {
    weight: f64,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Mixed {
    share: f64,
    size: [u32; 2],
    name: String,
    inner: std::collections::BTreeMap<String, f64>,
}

fn second_part(text: &str) -> Settings {
    let document = Document::new(Path::new("a.toml"), text.to_owned());
    let outer: Outer = document.read().unwrap();
    Settings::written(&document, &outer.parts[1].settings)
}

#[test]
fn an_error_in_a_table_read_later_has_the_line_and_column_of_the_key() {
    for (text, line, column, part) in [
        ("[[part]]\nsettings = { weight = 1 }\n[[part]]\nsettings = { wait = 1 }\n", 4, 14, "`wait`"),
        ("[[part]]\n[part.settings]\nweight = 1\n[[part]]\n[part.settings]\nweight = 'x'\n", 6, 10, "\"x\""),
    ] {
        let errors = second_part(text).read::<Inner>().unwrap_err().each();
        let error = errors.last().unwrap();
        let SettingsError::At { line: l, column: c, message, .. } = error else { panic!("{error}") };
        assert_eq!((*l, *c), (line, column), "{error}");
        assert!(message.contains(part), "{error}");
    }
}

#[test]
fn an_overlay_that_changes_nothing_keeps_the_place() {
    let settings = second_part("[[part]]\nsettings = { weight = 1 }\n[[part]]\nsettings = { weight = 2 }\n");
    let same: Table = toml::from_str("weight = 2").unwrap();
    let other: Table = toml::from_str("weight = 'heavy'").unwrap();
    assert_eq!(settings.overlaid(&same, "reading weight"), settings);
    let error = settings.overlaid(&other, "reading weight").read::<Inner>().unwrap_err().to_string();
    assert!(error.starts_with("a.toml:4 with reading weight: "), "{error}");
}

#[test]
fn settings_put_together_may_be_empty_and_read_as_they_were_put_together() {
    #[derive(Debug, Deserialize, JsonSchema)]
    #[serde(deny_unknown_fields)]
    struct Nothing {}
    let Nothing {} = Settings::composed("a task without settings", Table::new()).read().unwrap();
    let text = "share = 0.1\nsize = [3, 4]\nname = \"a\\\"b\"\n[inner]\nleast = 5e-324\n";
    let table: Table = toml::from_str(text).unwrap();
    let read: Mixed = Settings::composed("a sweep", table).read().unwrap();
    assert_eq!(
        (read.share, read.size, read.name.as_str(), read.inner["least"]),
        (0.1, [3, 4], "a\"b", 5e-324)
    );
}

#[test]
fn an_empty_document_and_a_broken_one_say_so() {
    let read = |text: &str| {
        Document::new(Path::new("a.toml"), text.to_owned()).read::<Outer>().unwrap_err().to_string()
    };
    assert!(read(" \n").contains("a.toml:1:1: the file is empty"), "{}", read(" \n"));
    assert!(read("[[part]\n").starts_with("a.toml:1:"), "{}", read("[[part]\n"));
}
