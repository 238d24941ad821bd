//! What stands in a cell.

use replan_audit::reader::cells::{Number, number, plain};

fn read(text: &str) -> String {
    match number(text) {
        Ok(Number::Missing) => "missing".to_owned(),
        Ok(Number::Plain { value, spread }) => {
            spread.map_or_else(|| value.to_string(), |spread| format!("{value} ± {spread}"))
        }
        Ok(Number::Fraction { k_of_n: [k, n], percent }) => {
            percent.map_or_else(|| format!("{k} of {n}"), |percent| format!("{k} of {n}, {percent} %"))
        }
        Err(message) => message,
    }
}

#[test]
fn numbers_keep_their_trailing_zeros_and_spreads() {
    for (text, expected) in [
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
        (".042", "0.042"),
        ("-.5 %", "-0.5"),
        ("29/30", "29 of 30"),
        ("29 / 30 (96.7\\%)", "29 of 30, 96.7 %"),
        ("96.7% (29/30)", "29 of 30, 96.7 %"),
        ("29/30 = 96.7%", "29 of 30, 96.7 %"),
        ("—", "missing"),
        ("N/A", "missing"),
    ] {
        assert_eq!(read(text), expected, "{text}");
    }
    assert_eq!(plain(" **$1.2$** "), ("1.2".to_owned(), true));
    for formulas in ["$t$ [ms] $\\downarrow$", "*a* and *b*", "\\textbf{a} \\textbf{b}"] {
        assert_eq!(plain(formulas), (formulas.to_owned(), false));
    }
    assert_eq!(plain("\\textbf{3}"), ("3".to_owned(), true));
}

#[test]
fn what_is_no_number_says_why() {
    for (text, expected) in [
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
        ("3 apples", "has `apples` behind it, a unit that is not known"),
        ("1.", "ends in a point"),
        ("1.2.3", "has several points"),
        (".", "is no number"),
        ("29/0", "is no k/n"),
        ("fast", "is no number"),
        ("1.2 ± ", "is no number"),
        ("(", "is no number"),
    ] {
        let found = number(text).unwrap_err();
        assert!(found.contains(expected) && found.contains("accepted"), "{text}: {found}");
    }
}
