use super::*;
use schemars::JsonSchema;
use serde::Deserialize;
use std::path::Path;
use toml::Table;

mod rest;

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
    assert_eq!(settings.overlaid(&same, "option weight"), settings);
    let error = settings.overlaid(&other, "option weight").read::<Inner>().unwrap_err().to_string();
    assert!(error.starts_with("a.toml:4:23: with option weight: `weight` is \"heavy\""), "{error}");
}

/// Line and column of an error.
fn place(error: &SettingsError) -> (usize, usize) {
    let SettingsError::At { line, column, .. } = error else { panic!("{error}") };
    (*line, *column)
}

#[test]
fn a_name_at_fault_stands_in_its_own_table_under_its_own_key_in_its_own_part() {
    let settings = second_part(
        "[[part]]\nsettings = { of = \"A*\" }\n[[part]]\n[part.settings]\nproblems = [\"A*\"]\nof = \"A*\"\n\
         sets = [{ problems = [\"x\"] }, { problems = [\"x\"] }]\n",
    );
    for (paths, word, expected) in [
        (&["of"][..], "A*", (6, 6)),
        (&["problems", "of"], "A*", (5, 13)),
        (&["against", "of"], "A*", (6, 6)),
        (&["sets.problems"], "x", (7, 23)),
        (&["sets.1.problems"], "x", (7, 45)),
        (&["sets.0.of", "of"], "absent", (7, 9)),
    ] {
        let error = settings.error_about(paths, word, "wrong");
        assert_eq!(place(&error), expected, "{paths:?} {word}: {error}");
    }
}

#[test]
fn an_entry_without_a_table_is_at_fault_where_it_is_named() {
    let document = Document::new(Path::new("a.toml"), "planner = \"astar\"\n".to_owned());
    let error = Settings::absent(&document, 10..17, "planner `astar`").read::<Inner>().unwrap_err();
    assert_eq!(place(&error), (1, 11));
    assert!(error.to_string().contains("planner `astar`: missing key `weight`"), "{error}");
}

#[test]
fn a_key_that_no_overlay_gave_is_at_fault_where_the_table_below_has_it() {
    let settings =
        second_part("[[part]]\nsettings = { weight = 1 }\n[[part]]\nsettings = { wait = 3, weight = 2 }\n");
    let over: Table = toml::from_str("weight = 4").unwrap();
    let error = settings.overlaid(&over, "option weight").read::<Inner>().unwrap_err();
    assert_eq!(place(&error), (4, 14), "{error}");
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

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[expect(dead_code, reason = "read by the deserializer only")]
struct Many {
    /// How many there are.
    count: u8,
    /// How far it is.
    #[schemars(range(min = 1, max = 3))]
    reach_cm: Option<f64>,
    /// What it weighs.
    weight: Option<Weight>,
    /// What stands there.
    #[serde(default)]
    solid: Vec<Solid>,
    /// Its name.
    #[serde(default = "plain")]
    name: String,
    /// Whether it is there.
    #[serde(default)]
    there: bool,
    /// Where draws begin.
    seed: Option<u64>,
}

fn plain() -> String {
    "plain".to_owned()
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(untagged)]
#[expect(dead_code, reason = "read by the deserializer only")]
enum Weight {
    /// The same everywhere.
    Constant(f64),
    /// By a rule.
    Ruled(Rule),
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum Rule {
    /// Less and less.
    Falling,
    /// More and more.
    Rising,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(tag = "shape", rename_all = "snake_case", deny_unknown_fields)]
enum Solid {
    /// A ball.
    Ball {
        /// Its radius.
        #[expect(dead_code, reason = "read by the deserializer only")]
        radius: f64,
    },
    /// A box.
    Box {
        /// Its sides.
        #[expect(dead_code, reason = "read by the deserializer only")]
        sides: [f64; 3],
    },
}

/// Line, column and message of everything that is wrong with `text`.
fn faults_of(text: &str) -> Vec<(usize, usize, String)> {
    let document = Document::new(Path::new("a.toml"), text.to_owned());
    let errors = document.read::<Many>().unwrap_err().each();
    let place = |error| match error {
        SettingsError::At { line, column, message, .. } => (line, column, message),
        other => panic!("{other}"),
    };
    errors.into_iter().map(place).collect()
}

/// What is written; the line and the column of the message about it; the message.
const FAULTS: &[(&str, usize, usize, &str)] = &[
    (
        "name = 'x'",
        1,
        1,
        "missing key `count` (How many there are); a whole number from 0 to 255 is accepted",
    ),
    ("count = 256", 1, 9, "`count` is 256; a whole number from 0 to 255 is accepted"),
    ("count = 0x100", 1, 9, "`count` is 0x100; a whole number from 0 to 255 is accepted"),
    ("count = 1.0", 1, 9, "`count` is 1.0; a whole number from 0 to 255 is accepted"),
    ("count = 1\nreach_cm = 4", 2, 12, "`reach_cm` is 4; a number from 1 to 3 is accepted"),
    ("count = 1\nreach_cm = inf", 2, 12, "`reach_cm` is inf; a finite number from 1 to 3 is accepted"),
    ("count = 1\nthere = 'yes'", 2, 9, "`there` is \"yes\"; true or false is accepted"),
    ("count = 1\nweight = true", 2, 10, "`weight` is true; a number, \"falling\" or \"rising\" is accepted"),
    (
        "count = 1\nweight = 'risin'",
        2,
        10,
        "`weight` is \"risin\" (did you mean `rising`?); a number, \"falling\" or \"rising\" is accepted",
    ),
    (
        "count = 1\nseed = 99999999999999999999",
        2,
        8,
        "`seed` is 99999999999999999999; a whole number of 0 or more (no further than 18446744073709551615) is accepted",
    ),
    (
        "count = 1\nseed = 0xfffffffffffffffffffffffffffffffffffff",
        2,
        8,
        "`seed` is 0xfffffffffffffffffffffffffffffffffffff; a whole number of 0 or more (no further than",
    ),
    ("count = 1\n[[solid]]\nradius = 1", 2, 1, "missing key `shape`; accepted: \"ball\", \"box\""),
    (
        "count = 1\n[[solid]]\nshape = 'bal'",
        3,
        9,
        "`shape` is \"bal\" (did you mean `ball`?); \"ball\", \"box\" is accepted",
    ),
    ("count = 1\n[[solid]]\nshape = 'ball'", 2, 1, "missing key `radius` (Its radius); a number is accepted"),
    (
        "count = 1\n[[solid]]\nshape = 'box'\nsides = [1, 2]",
        4,
        9,
        "`sides` is an array of 2; an array of 3 (a number each) is accepted",
    ),
    (
        "count = 1\n[[solid]]\nshape = 'box'\nsides = [1, 2, 'c']",
        4,
        16,
        "`sides[2]` is \"c\"; a number is accepted",
    ),
    ("count = 1\nsolids = 3", 2, 1, "unknown key `solids` (did you mean `solid`?); accepted: `count`, "),
];

#[test]
fn each_fault_stands_at_its_own_key_or_value_with_what_is_accepted() {
    for (text, line, column, message) in FAULTS {
        let found = faults_of(text);
        let [(l, c, m)] = found.as_slice() else { panic!("{text}: {found:?}") };
        assert_eq!((*l, *c), (*line, *column), "{text}: {m}");
        assert!(m.starts_with(message), "{text}\ngives: {m}\nshould be: {message}");
    }
}

#[test]
fn all_faults_of_a_file_are_found_at_once_in_the_order_of_their_places() {
    let text = "coumt = 3\nreach_cm = 0\nnmae = 'x'\n[[solid]]\nshape = 'ball'\nradius = 'r'\n[[solid]]\nshape = 'cone'\n";
    let lines: Vec<usize> = faults_of(text).into_iter().map(|(line, ..)| line).collect();
    assert_eq!(lines, [1, 2, 3, 6, 8], "{:?}", faults_of(text));
}

#[test]
fn what_is_accepted_of_a_whole_number_does_not_depend_on_how_far_a_machine_counts() {
    let text = "share = 1\nname = 'x'\nsize = [-1, 4294967296]\n[inner]\n".to_owned();
    let message = Document::new(Path::new("a.toml"), text).read::<Mixed>().unwrap_err().to_string();
    for expected in [
        "`size[0]` is -1; a whole number of 0 or more is accepted",
        "`size[1]` is 4294967296; a whole number of 0 or more (no further than 4294967295) is accepted",
    ] {
        assert!(message.contains(expected), "{message}\nlacks\n{expected}");
    }
}

#[test]
fn one_number_that_several_maps_refuse_is_one_fault() {
    let settings = second_part("[[part]]\nsettings = {}\n[[part]]\nsettings = { weight = 9 }\n");
    let mut faults = Faults::default();
    for (found, most) in [("weight is 9", 5), ("weight is 9", 2), ("weight is odd", 8)] {
        faults.add(settings.error_at("weight", format!("{found}; up to {most} is accepted")));
    }
    let message = faults.error().to_string();
    assert_eq!(message.matches("a.toml").count(), 2, "{message}");
    assert!(message.contains("weight is 9; up to 5") && message.contains("odd; up to 8"), "{message}");
}

#[test]
fn of_very_many_faults_the_first_fifty_are_shown_and_the_others_counted() {
    let entries = "[[solid]]\nshape = 'ball'\nradius = 'r'\n".repeat(60);
    let document = Document::new(Path::new("a.toml"), format!("count = 1\n{entries}"));
    let message = document.read::<Many>().unwrap_err().to_string();
    assert_eq!(message.matches("a number is accepted").count(), 50, "{message}");
    assert!(message.ends_with("a.toml: 10 more faults like these"), "{message}");
}

#[test]
fn a_name_is_compared_with_known_ones_up_to_sixty_four_letters() {
    for (letters, hint) in [(64, true), (65, false)] {
        let known = "n".repeat(letters - 1);
        let refusal = none_called("map", &format!("{known}m"), [known.as_str()]);
        assert_eq!(refusal.contains("did you mean"), hint, "{refusal}");
    }
}

#[test]
fn a_record_of_settings_has_the_values_that_hold_where_keys_are_left_out() {
    let settings = Settings::composed("a test", toml::from_str("count = 1\nreach_cm = 2").unwrap());
    let whole = settings.completed(Accepted::shape::<Many>());
    let expected: Table = toml::from_str("count = 1\nreach_cm = 2\nname = 'plain'").unwrap();
    assert_eq!(*whole.table(), expected);
}

#[test]
fn what_is_described_is_what_is_accepted() {
    let fields = describe::fields(&schema_of::<Many>());
    let line = |name: &str| {
        let field = fields.iter().find(|field| field.name == name).unwrap();
        (field.meaning.as_str(), field.unit, field.accepted.as_str(), field.default.clone())
    };
    assert_eq!(
        line("count"),
        ("How many there are.", None, "a whole number from 0 to 255", describe::Default::Required)
    );
    let reach = ("How far it is.", Some("centimetres"), "a number from 1 to 3", describe::Default::Absent);
    assert_eq!(line("reach_cm"), reach);
    assert_eq!(line("name").3, describe::Default::Value("\"plain\"".to_owned()));
    assert_eq!(line("solid.radius").0, "Its radius.");
    assert_eq!(line("solid.shape").0, "A ball.");
    let weight = fields.iter().find(|field| field.name == "weight").unwrap();
    assert_eq!(weight.words[0], ("falling".to_owned(), "Less and less.".to_owned()));
    assert!(describe::undocumented(&schema_of::<Many>()).is_empty());
    assert_eq!(describe::undocumented(&schema_of::<Inner>()), ["weight"]);
}
