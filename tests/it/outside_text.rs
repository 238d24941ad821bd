//! Text of others is shown and does nothing: to a terminal, in a page, in a document, in a name of a file.

use crate::paper::Bench;
use base::text::{MOST_OF_NAME, acts, shown};
use replan::page;
use replan::render::{latex, prose};

/// What moves a cursor, clears a screen, ends a line elsewhere or turns the direction of reading.
const NASTY: &str = "a\u{1b}[2J\u{7}\u{9b}31m\r\u{8}\u{202e}b\u{2066}c\u{200f}\u{2028}d\u{61c}";

#[test]
fn no_format_lets_a_character_through_that_acts_on_what_shows_it() {
    assert!(NASTY.contains(acts));
    for (format, safe) in [
        ("terminal", shown(NASTY).into_owned()),
        ("HTML", page::escaped(NASTY)),
        ("LaTeX", latex::escaped(NASTY)),
        ("Markdown", prose::markdown(NASTY)),
        ("Markdown code", prose::markdown(&format!("`{NASTY}`"))),
    ] {
        assert!(!safe.contains(acts), "{format}: {safe:?}");
        assert!(safe.contains("‹escape›") && safe.contains('d'), "{format}: {safe}");
    }
}

#[test]
fn no_comment_of_latex_ends_before_its_line() {
    let mut numbers = latex::Numbers::default();
    numbers.add("a.b", "1", "x\r\\input{secret}\u{2028}\\input{secret}\n\\input{secret}").unwrap();
    let text = numbers.latex("p", "made\u{85}\\input{secret}").unwrap();
    for line in text.split(['\n', '\r', '\u{85}', '\u{2028}']) {
        let comment = line.find('%').unwrap_or(line.len());
        assert!(!line[..comment].contains("input"), "{text:?}");
    }
}

#[test]
fn names_are_short_and_on_one_line() {
    let bench = Bench::new();
    let long = "x".repeat(MOST_OF_NAME + 1);
    for (file, from, to, fault) in [
        (
            "draws",
            "label = \"drawn\"",
            "label = \"drawn\\nreplan: all is well\"".to_owned(),
            "the end of a line",
        ),
        ("draws", "label = \"drawn\"", "label = \"drawn\\u202e\"".to_owned(), "holds a control character"),
        ("draws", "label = \"drawn\"", format!("label = \"{long}\""), "`label` has 101 characters"),
        (
            "paper",
            "[choice.option.allow]",
            "[choice.option.\"a\\u001b\"]".to_owned(),
            "the key `a‹escape›` holds",
        ),
        ("paper", "[choice.option.allow]", format!("[choice.option.{long}]"), "has 101 characters"),
        ("paper", "id = \"cost\"", "id = \"co\\u0085st\"".to_owned(), "holds a control character"),
    ] {
        let file = format!("mini/{file}.toml");
        let before = std::fs::read(bench.at(&file)).unwrap();
        bench.edit(&file, from, &to);
        let refused = bench.run(&["check", "./mini"]);
        assert_eq!(refused.code, Some(2), "{to}: {}", refused.out);
        assert!(refused.err.contains(fault), "{to}: {}", refused.err);
        assert!(!refused.err.contains("\nreplan: all is well"), "{}", refused.err);
        bench.write(&file, &before);
    }
    std::fs::rename(bench.at("mini/draws.toml"), bench.at(&format!("mini/{long}.toml"))).unwrap();
    let refused = bench.run(&["check", "./mini"]);
    assert_eq!(refused.code, Some(2), "{}", refused.out);
    assert!(refused.err.contains("the study is called"), "{}", refused.err);
}
