//! What stands in a cell: a number, a number with its spread, or nothing.

use proofs::printed::Printed;

/// What a cell of a column of numbers holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Number {
    /// Nothing: empty, a dash, `n/a`.
    Missing,
    /// A number, and what stands after `±` or in brackets.
    Plain {
        /// The number.
        value: Printed,
        /// What stands after `±` or in brackets.
        spread: Option<Printed>,
    },
}

/// Units that may stand behind a number in its cell.
const UNITS: [&str; 34] = [
    "s", "ms", "us", "µs", "μs", "ns", "min", "h", "m", "dm", "cm", "mm", "km", "px", "cells", "rad", "deg",
    "°", "Hz", "kHz", "MHz", "GHz", "kB", "KB", "MB", "GB", "J", "W", "N", "kg", "m/s", "rad/s", "x", "×",
];

/// Whether a text is a unit that is known.
pub fn is_unit(text: &str) -> bool {
    UNITS.contains(&text)
}

/// A text that is a number and its unit: the two; the unit is empty where there is none.
pub fn unit(text: &str) -> (&str, &str) {
    let text = text.trim();
    let end = text.rfind(|c: char| c.is_ascii_digit() || c == ')').map_or(0, |at| at + 1);
    let (number, behind) = text.split_at(end);
    let unit = behind.trim_start_matches(['\\', ',', '~', ' ', '\u{a0}', '\u{2009}', '\u{202f}']);
    if UNITS.contains(&unit) && !number.is_empty() { (number, unit) } else { (text, "") }
}

/// What marks a cell without a number.
const MISSING: [&str; 8] = ["", "-", "–", "—", "n/a", "na", "nan", "none"];

/// A cell's text without emphasis and mathematics, and whether it was bold.
pub fn plain(text: &str) -> (String, bool) {
    let mut text = text.trim();
    let mut is_bold = false;
    loop {
        let inner = [
            ("**", "**", true),
            ("__", "__", true),
            ("<b>", "</b>", true),
            ("\\textbf{", "}", true),
            ("$", "$", false),
            ("*", "*", false),
            ("_", "_", false),
            ("<u>", "</u>", false),
            ("\\underline{", "}", false),
        ]
        .into_iter()
        .find_map(|(open, close, bold)| Some((text.strip_prefix(open)?.strip_suffix(close)?, bold)));
        let Some((inner, bold)) = inner else { return (text.replace("\\|", "|"), is_bold) };
        text = inner.trim();
        is_bold |= bold;
    }
}

/// Reads a number, `1.2 ± 0.07`, `1.2 (0.07)`, with or without `%` or a unit.
///
/// # Errors
/// What is wrong and what is accepted, in words.
pub fn number(text: &str) -> Result<Number, String> {
    let text = text.trim();
    if MISSING.contains(&text.to_lowercase().as_str()) {
        return Ok(Number::Missing);
    }
    let (text, behind) = unit(text);
    let bracketed = || text.strip_suffix(')').and_then(|text| text.split_once('('));
    let pair = ["±", "+/-", "+-", "\\pm"].iter().find_map(|mark| text.split_once(mark)).or_else(bracketed);
    match pair {
        Some((value, spread)) => {
            let (value, before) = unit(value);
            if !before.is_empty() && before != behind {
                return Err(format!(
                    "`{text} {behind}` has two units; accepted: one for both, best in the header"
                ));
            }
            Ok(Number::Plain { value: one(value, text)?, spread: Some(one(spread, text)?) })
        }
        None => Ok(Number::Plain { value: one(text, text)?, spread: None }),
    }
}

/// One number; `cell` is the whole text, for the message.
fn one(text: &str, cell: &str) -> Result<Printed, String> {
    let text = text.trim();
    let text = text.strip_suffix("\\%").or_else(|| text.strip_suffix('%')).unwrap_or(text).trim();
    let text = text.strip_prefix('+').unwrap_or(text);
    text.parse().map_err(|_| {
        let shown: String = cell.chars().take(40).collect();
        format!(
            "`{shown}` {}; accepted: 14.65, -0.5, 1.2 ± 0.07, 1.2 (0.07), or - for nothing",
            complaint(text)
        )
    })
}

/// What is wrong with a text that is no number.
fn complaint(text: &str) -> &'static str {
    let is_number =
        |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.');
    let without = |marks: &[char]| text.trim_start_matches(['-', '−']).replace(marks, "");
    if text.bytes().filter(u8::is_ascii_digit).count() > 15 && is_number(&without(&[])) {
        return "has more than 15 digits";
    }
    let commas = text.matches(',').count();
    if commas > 0 && is_number(&without(&[','])) {
        let (_, rest) = text.rsplit_once(',').unwrap_or_default();
        return match (commas, text.contains('.'), rest.len()) {
            (1, false, 3) => "may have a thousands separator or a decimal comma; write 1234 or 1.234",
            (1, false, _) => "has a decimal comma; write a point",
            _ => "has thousands separators; write the number without",
        };
    }
    if is_number(&without(&[' ', '\u{a0}', '\u{2009}', '\u{202f}', '\'', '’', '_'])) {
        return "has thousands separators; write the number without";
    }
    if text.parse::<f64>().is_ok_and(f64::is_finite) && text.contains(['e', 'E']) {
        return "has an exponent, which hides digits; write the number out";
    }
    if text.starts_with(['<', '>', '≤', '≥']) {
        return "is a bound and no printed value; write - for it, or ask about a p-value by a relation `p_value`";
    }
    let shortened = text.strip_suffix(['k', 'K', 'M', 'G', 'B']).is_some_and(|text| is_number(text.trim()));
    if shortened {
        return "leaves digits out; write the number out";
    }
    let digits = text.trim_end_matches(|c: char| !c.is_ascii_digit());
    if digits.len() < text.len() && is_number(digits.trim_start_matches(['-', '−'])) {
        return "has a unit that is not known; write it in the header, as in `time [mean s]`";
    }
    "is no number"
}
