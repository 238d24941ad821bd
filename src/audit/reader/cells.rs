//! The content of a cell: a number, a number with its spread, or nothing.

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
    /// `29/30`, alone or with its percentage.
    Fraction {
        /// The two counts, k first.
        k_of_n: [u64; 2],
        /// The percentage beside it.
        percent: Option<Printed>,
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
        .find_map(|(open, close, bold)| {
            let inner = text.strip_prefix(open)?.strip_suffix(close)?;
            is_pair(inner, close).then_some((inner, bold))
        });
        let Some((inner, bold)) = inner else { return (text.replace("\\|", "|"), is_bold) };
        text = inner.trim();
        is_bold |= bold;
    }
}

/// Whether the marks around `inner` are of each other: those around `$t$ [ms] $x$` are of two formulas.
fn is_pair(inner: &str, close: &str) -> bool {
    let mut depth = 0_i32;
    let mut is_inside = |c: char| {
        depth += i32::from(c == '{') - i32::from(c == '}');
        depth >= 0
    };
    if close == "}" { inner.chars().all(&mut is_inside) } else { !inner.contains(close) }
}

/// Reads a number, `1.2 ± 0.07`, `1.2 (0.07)`, with or without `%` or a unit, or a fraction `29/30`, `29/30 (96.7%)`.
///
/// # Errors
/// What is wrong and what is accepted, in words.
pub fn number(text: &str) -> Result<Number, String> {
    let text = text.trim();
    if MISSING.contains(&text.to_lowercase().as_str()) {
        return Ok(Number::Missing);
    }
    if let Some(fraction) = fraction(text)? {
        return Ok(fraction);
    }
    let (alone, behind) = unit(text);
    let pair = ["±", "+/-", "+-", "\\pm"].iter().find_map(|mark| alone.split_once(mark)).or(bracketed(alone));
    match pair {
        Some((value, spread)) => {
            let (value, before) = unit(value);
            if !before.is_empty() && before != behind {
                return Err(format!("`{text}` has two units; accepted: one for both, best in the header"));
            }
            Ok(Number::Plain { value: one(value, text)?, spread: Some(one(spread, text)?) })
        }
        None => Ok(Number::Plain { value: one(alone, text)?, spread: None }),
    }
}

/// What stands before and in the bracket that a text ends in.
fn bracketed(text: &str) -> Option<(&str, &str)> {
    text.strip_suffix(')')?.split_once('(')
}

/// The fraction that a text is, with a percentage before or behind it; `None` if it is no fraction.
fn fraction(text: &str) -> Result<Option<Number>, String> {
    let parts = |text: &str| {
        let (k, n) = text.trim().split_once('/')?;
        Some([k.trim().parse().ok()?, n.trim().parse().ok().filter(|n| *n > 0)?])
    };
    let pair = bracketed(text).or(text.split_once('='));
    let (found, percent) = match (parts(text), pair) {
        (Some(k_of_n), _) => (Some(k_of_n), None),
        (None, Some((first, second))) => match (parts(first), parts(second)) {
            (Some(k_of_n), None) => (Some(k_of_n), Some(second)),
            (None, Some(k_of_n)) => (Some(k_of_n), Some(first)),
            _ => (None, None),
        },
        (None, None) => (None, None),
    };
    let Some(k_of_n) = found else { return Ok(None) };
    let percent = percent.map(|percent| one(percent, text)).transpose()?;
    Ok(Some(Number::Fraction { k_of_n, percent }))
}

/// One number; `cell` is the whole text, for the message.
fn one(text: &str, cell: &str) -> Result<Printed, String> {
    let text = text.trim();
    let text = text.strip_suffix("\\%").or_else(|| text.strip_suffix('%')).unwrap_or(text).trim();
    let text = text.strip_prefix('+').unwrap_or(text);
    // The 0 before a point may be left out: `.042`.
    let digits = text.trim_start_matches(['-', '−']);
    let with_0 = digits.starts_with('.').then(|| format!("{}0{digits}", &text[..text.len() - digits.len()]));
    with_0.as_deref().unwrap_or(text).parse().map_err(|_| {
        let shown: String = cell.chars().take(40).collect();
        // Where the text was taken for a number and its unit, what is wrong may be of both.
        let whole = if cell.starts_with(text) && bracketed(cell).is_none() { cell } else { text };
        let why = several_units(whole).unwrap_or_else(|| complaint(text));
        format!("`{shown}` {why}; accepted: 14.65, -0.5, 1.2 ± 0.07, 1.2 (0.07), or - for nothing")
    })
}

/// What is wrong with a time that is written in minutes and seconds: `1:23`, `2m 5s`.
fn several_units(text: &str) -> Option<String> {
    let is_count =
        |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.');
    let is_clock = text.contains(':') && text.split(':').all(is_count);
    let numbers = text.split(|c: char| !c.is_ascii_digit() && c != '.').filter(|part| is_count(part)).count();
    let words =
        text.split(|c: char| c.is_ascii_digit() || c == '.').map(str::trim).filter(|word| !word.is_empty());
    let is_time = |word: &str| ["d", "h", "hr", "m", "min", "s", "sec", "ms"].contains(&word);
    let is_in_units =
        numbers > 1 && text.starts_with(|c: char| c.is_ascii_digit()) && words.clone().all(is_time);
    (is_clock || is_in_units && words.count() > 1)
        .then(|| "is a time in minutes and seconds, or in hours; write it in one unit, as 83 s".to_owned())
}

/// What may stand between thousands.
const SPACES: [char; 7] = [' ', '\u{a0}', '\u{2009}', '\u{202f}', '\'', '’', '_'];

/// What is wrong with a text that is no number.
fn complaint(text: &str) -> String {
    let is_number = |text: &str| {
        text.contains(|c: char| c.is_ascii_digit())
            && text.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.')
    };
    let without = |marks: &[char]| text.trim_start_matches(['-', '−']).replace(marks, "");
    if text.bytes().filter(u8::is_ascii_digit).count() > 15 && is_number(&without(&[])) {
        return "has more than 15 digits".to_owned();
    }
    let commas = text.matches(',').count();
    if commas > 0 && is_number(&without(&[','])) {
        let (_, rest) = text.rsplit_once(',').unwrap_or_default();
        return match (commas, text.contains('.'), rest.len()) {
            (1, false, 3) => "may have a thousands separator or a decimal comma; write 1234 or 1.234",
            (1, false, _) => "has a decimal comma; write a point",
            _ => "has thousands separators; write the number without",
        }
        .to_owned();
    }
    if text.contains(SPACES) && is_number(&without(&SPACES)) {
        return "has thousands separators; write the number without".to_owned();
    }
    if is_number(&without(&[])) {
        return match text.matches('.').count() {
            1 => "ends in a point without digits behind it; write 1 or 1.0, whichever is printed",
            _ => "has several points; write one, and thousands without",
        }
        .to_owned();
    }
    if text.parse::<f64>().is_ok_and(f64::is_finite) && text.contains(['e', 'E']) {
        return "has an exponent, which hides digits; write the number out".to_owned();
    }
    if text.starts_with(['<', '>', '≤', '≥']) {
        return "is a bound and no printed value; write - for it, or ask about a p-value by a relation `p_value`".to_owned();
    }
    if text.starts_with("~~") || text.starts_with("<s>") || text.starts_with("<del>") {
        return "is struck out; write the number alone, or - for nothing".to_owned();
    }
    behind(text).unwrap_or_else(|| "is no number".to_owned())
}

/// What is wrong with the text behind a number; `None` if there is no number before it.
fn behind(text: &str) -> Option<String> {
    let body = text.trim_start_matches(['-', '−']);
    let end = body.find(|c: char| !c.is_ascii_digit() && c != '.').filter(|end| *end > 0)?;
    let tail = body[end..].trim();
    if ["k", "K", "M", "G", "B"].contains(&tail) {
        return Some("leaves digits out; write the number out".to_owned());
    }
    if tail.starts_with('/') {
        return Some("is no k/n; whole numbers with n above 0 are accepted, as 29/30".to_owned());
    }
    let to = tail.trim_start_matches(['-', '−', '–', '—']);
    if to.len() < tail.len() && to.trim_start().starts_with(|c: char| c.is_ascii_digit()) {
        return Some(
            "is a range and no printed value; write - for it, or its ends in columns of their own".to_owned(),
        );
    }
    let times = ["×", "·", "\\times", "\\cdot"].iter().find_map(|times| tail.strip_prefix(times));
    let power = times.map_or("", str::trim_start);
    if ["10^", "10⁻", "10<sup>"].iter().any(|ten| power.starts_with(ten)) {
        return Some("has a power of ten, which hides digits; write the number out".to_owned());
    }
    let shown: String = tail.chars().take(20).collect();
    let is_raised = |c: char| "*†‡§¶#^[¹²³⁴⁵⁶⁷⁸⁹⁰ᵃᵇᶜᵈ".contains(c);
    let is_mark = tail.starts_with(is_raised)
        || ["<sup>", "$^", "\\textsuperscript", "\\dagger", "\\ddagger", "\\ast", "\\footnote"]
            .iter()
            .any(|mark| tail.starts_with(mark));
    Some(if is_mark {
        format!("has the mark `{shown}` behind it, as of a footnote; write the number alone")
    } else {
        format!(
            "has `{shown}` behind it, a unit that is not known; write it in the header, as in `time [mean s]`"
        )
    })
}
