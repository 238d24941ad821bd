//! What stands in a cell.

use replan_audit::reader::cells::{Number, number, plain};

fn read(text: &str) -> String {
    match number(text) {
        Ok(Number::Missing) => "missing".to_owned(),
        Ok(Number::Plain { value, spread }) => {
            spread.map_or_else(|| value.to_string(), |spread| format!("{value} ± {spread}"))
        }
        Err(message) => message,
    }
}

#[test]
fn numbers_keep_their_trailing_zeros_and_spreads() {
    for (text, said) in [
        ("14.650", "14.650"),
        ("−0.5", "-0.5"),
        ("99.7%", "99.7"),
        ("1.2 ± 0.07", "1.2 ± 0.07"),
        ("1.2±0.07 %", "1.2 ± 0.07"),
        ("1.20 +/- 0.07", "1.20 ± 0.07"),
        ("1.2 (0.07)", "1.2 ± 0.07"),
        ("1.20 ms", "1.20"),
        ("1.20ms ± 0.07ms", "1.20 ± 0.07"),
        ("1.20 (0.07) s", "1.20 ± 0.07"),
        ("1.20\\,m/s", "1.20"),
        ("2.0×", "2.0"),
        ("−90°", "-90"),
        ("—", "missing"),
        ("N/A", "missing"),
    ] {
        assert_eq!(read(text), said, "{text}");
    }
    assert_eq!(plain(" **$1.2$** "), ("1.2".to_owned(), true));
    assert_eq!(plain("\\textbf{3}"), ("3".to_owned(), true));
}

#[test]
fn what_is_no_number_says_why() {
    for (text, said) in [
        ("1,234", "thousands separator or a decimal comma"),
        ("1,234,567", "has thousands separators"),
        ("1,234.5", "has thousands separators"),
        ("1 234", "has thousands separators"),
        ("1\u{2009}234", "has thousands separators"),
        ("12,5", "has a decimal comma"),
        ("1e-3", "has an exponent"),
        ("1234567890123456", "more than 15 digits"),
        ("12k", "leaves digits out"),
        ("1.20 s ± 70 ms", "has two units"),
        ("3 apples", "has a unit that is not known"),
        ("fast", "is no number"),
        ("1.2 ± ", "is no number"),
        ("(", "is no number"),
    ] {
        let found = number(text).unwrap_err();
        assert!(found.contains(said) && found.contains("accepted"), "{text}: {found}");
    }
}
