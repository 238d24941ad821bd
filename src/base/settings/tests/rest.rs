//! What documents are like, and where their keys stand.

use super::*;

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[expect(dead_code, reason = "a name says nothing of what a file is")]
struct Arm {
    name: String,
    tool: Tool,
    #[serde(default)]
    joint: Vec<Joint>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[expect(dead_code, reason = "read by the deserializer only")]
struct Tool {
    name: String,
    length: f64,
}

#[derive(Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Joint {
    lower: f64,
    #[schemars(range(min = 0.0))]
    speed: Option<f64>,
}

fn document(text: &str) -> std::sync::Arc<Document> {
    Document::new(Path::new("a.toml"), text.to_owned())
}

#[test]
fn a_document_is_like_a_schema_by_its_tables_and_lists_alone() {
    let likeness = |text: &str| document(text).likeness(&schema_of::<Arm>());
    for text in ["name = 'a'\n", "[tool.ruff]\nline = 3\n", "[tool]\nname = 'x'\n", "joint = 3\n", "= 3\n"] {
        assert_eq!(likeness(text), 0, "{text}");
    }
    assert_eq!(likeness("[tool]\nlength = 'x'\n"), 1);
    assert_eq!(likeness("[tool]\nlength = 1\n[[joint]]\nuper = 1\n[[joint]]\nspeed = 2\n"), 2);
}

#[test]
fn a_key_is_found_by_the_steps_to_it_whatever_is_in_them() {
    let document = document("[[claim]]\n[claim.check.\"a.b\"]\nof = 3\n");
    let place = |steps: &[&str]| document.error_at_key(steps, "x").to_string();
    assert!(place(&["claim", "0", "check", "a.b"]).starts_with("a.toml:2:14:"));
    assert!(place(&["claim", "0", "check", "a.b", "of"]).starts_with("a.toml:3:1:"));
    assert!(place(&["claim", "0", "says"]).starts_with("a.toml:1:1:"));
}

#[test]
fn a_number_too_large_is_reported_with_the_limit_and_without_the_way_it_is_written() {
    let message = |text: &str| document(text).read::<Joint>().unwrap_err().to_string();
    assert!(message("lower = 1e308\n").contains("`lower` is 1e308; a number from -1e9 to 1e9 is accepted"));
    assert!(
        message("lower = 1\nspeed = 2_000_000_000\n").contains("is 2000000000; a number from 0 to 1e9 is")
    );
    assert!(message("lower = 1\nspeed = -1.50\n").contains("is -1.5; a number of 0 or more is accepted"));
    assert!(message("lower = -nan\n").contains("is nan; a finite number is accepted"));
}

#[test]
fn a_spec_too_large_is_refused_with_its_limit() {
    let message = document(&"# no key\n".repeat(300_000)).read::<Joint>().unwrap_err().to_string();
    assert!(message.contains("has 2700000 bytes; a spec of at most 2000000 is accepted"), "{message}");
    let message = document(&"# no key\n".repeat(200_000)).read::<Joint>().unwrap_err().to_string();
    assert!(message.contains("lower"), "{message}");
}

#[test]
fn a_file_of_any_format_that_is_no_text_is_refused_at_its_first_bad_byte() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["a.toml", "a.json", "a.yaml", "a.urdf", "a.srdf"] {
        let path = folder.path().join(name);
        std::fs::write(&path, b"{\n\"a\": \"\xff\"}").unwrap();
        let message = Document::open(&path).unwrap_err().to_string();
        let place = "line 2, byte 8 of the file is not UTF-8; UTF-8 text is accepted";
        assert!(message.ends_with(place) && message.contains(name), "{message}");
    }
}
