//! Text of others: how its bytes become text, and how messages show it.
//!
//! Readers see no byte-order mark, and every line ends in a line feed. Messages show invisible characters by their
//! names, and cut long text.

use std::borrow::Cow;
use std::fmt::Debug;

/// The most characters of a line that a message shows.
const MOST_OF_LINE: usize = 200;
/// The most characters of what a message says.
const MOST_OF_MESSAGE: usize = 1500;
/// The most characters of a word that a message shows.
const MOST_OF_WORD: usize = 60;
/// The most characters of a name: names of files are made of several.
pub const MOST_OF_NAME: usize = 100;

/// The text in `bytes`, without a byte-order mark and with line feeds at the ends of lines.
///
/// # Errors
/// Another encoding than UTF-8, by its name or by the place of the first byte that does not fit.
pub fn decoded(bytes: Vec<u8>) -> Result<String, String> {
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        return Err("it is UTF-16 text; UTF-8 text is accepted".to_owned());
    }
    // Without a mark: of plain letters one byte in two is 0.
    let begin = &bytes[..bytes.len().min(64)];
    let zeros = |from: usize| begin.iter().skip(from).step_by(2).filter(|byte| **byte == 0).count();
    if bytes.len() > 3 && (zeros(0) == 0) != (zeros(1) == 0) && 4 * (zeros(0) + zeros(1)) > begin.len() {
        return Err("it seems to be UTF-16 text without a byte-order mark; UTF-8 text is accepted".to_owned());
    }
    let text = String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let line = error.as_bytes()[..at].split(|byte| *byte == b'\n').count();
        format!("line {line}, byte {at} of the file is not UTF-8; UTF-8 text is accepted")
    })?;
    let is_plain = !text.starts_with('\u{feff}') && !text.contains('\r');
    if is_plain {
        return Ok(text);
    }
    Ok(text.trim_start_matches('\u{feff}').replace("\r\n", "\n").replace('\r', "\n"))
}

/// The name of a character that cannot be seen, or that changes what is seen around it; `None` for all others, and for ends of lines
/// and tabs.
pub fn unseen(c: char) -> Option<Cow<'static, str>> {
    let name = match c {
        '\n' | '\r' | '\t' => return None,
        '\0' => "NUL",
        '\u{1b}' => "escape",
        '\u{a0}' => "no-break space",
        '\u{ad}' => "soft hyphen",
        '\u{200b}' => "zero-width space",
        '\u{200c}' => "zero-width non-joiner",
        '\u{200d}' => "zero-width joiner",
        '\u{202f}' => "narrow no-break space",
        '\u{2060}' => "word joiner",
        '\u{3000}' => "wide space",
        '\u{feff}' => "byte-order mark",
        '\u{2000}'..='\u{200a}' | '\u{205f}' => return Some(format!("space U+{:04X}", c as u32).into()),
        '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2061}'..='\u{206f}' => {
            return Some(format!("U+{:04X}", c as u32).into());
        }
        c if c.is_control() => return Some(format!("control character U+{:04X}", c as u32).into()),
        _ => return None,
    };
    Some(name.into())
}

/// `text` with the name of each character that cannot be seen in its place: `‹byte-order mark›type octile`.
pub fn visible(text: &str) -> Cow<'_, str> {
    if text.chars().all(|c| unseen(c).is_none()) {
        return text.into();
    }
    text.chars().map(|c| unseen(c).map_or_else(|| c.to_string(), |name| format!("‹{name}›"))).collect()
}

/// `text` on one line, with the name of each character that cannot be seen in its place, ends of lines as `\\n`.
pub fn one_line(text: &str) -> String {
    visible(text).replace('\n', "\\n").replace('\r', "\\r").replace('\t', " ")
}

/// Whether `c` does something to what shows it instead of being seen: control characters but for line feeds and tabs, ends of lines of
/// other alphabets, and marks that turn the direction of reading.
pub fn acts(c: char) -> bool {
    match c {
        '\n' | '\t' => false,
        '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}' => true,
        c => c.is_control(),
    }
}

/// `text` as a terminal, a page or a document may show it: what [`acts`] is named in its place.
pub fn shown(text: &str) -> Cow<'_, str> {
    if !text.contains(acts) {
        return text.into();
    }
    let name = |c: char| unseen(c).map_or_else(|| "‹carriage return›".to_owned(), |name| format!("‹{name}›"));
    text.chars().map(|c| if acts(c) { name(c) } else { c.to_string() }).collect()
}

/// The fault of a name that people give, if any: at most [`MOST_OF_NAME`] characters on one line are accepted.
pub fn fault_of_name(name: &str) -> Option<String> {
    let count = name.chars().count();
    if count > MOST_OF_NAME {
        return Some(format!("has {count} characters; at most {MOST_OF_NAME} are accepted"));
    }
    let is_line = !name.contains(|c| c == '\n' || acts(c));
    (!is_line)
        .then(|| "holds a control character or the end of a line; text on one line is accepted".to_owned())
}

/// A message that may hold names of others: made visible, and cut if it is long.
pub fn bounded(message: &str) -> Cow<'_, str> {
    beginning(message, MOST_OF_MESSAGE)
}

/// A word as messages show it: visible, and its beginning if it is long.
pub fn brief(word: &str) -> Cow<'_, str> {
    beginning(word, MOST_OF_WORD)
}

fn beginning(text: &str, most: usize) -> Cow<'_, str> {
    match text.char_indices().nth(most) {
        Some((end, _)) => format!("{}…", visible(&text[..end])).into(),
        None => visible(text),
    }
}

/// A line as messages show it: visible, and no more of a long one than stands around its character number `column`, from 0.
pub fn around(line: &str, column: usize) -> String {
    let count = line.chars().count();
    let first = column.saturating_sub(MOST_OF_LINE / 2).min(count.saturating_sub(MOST_OF_LINE));
    let shown: String = line.chars().skip(first).take(MOST_OF_LINE).collect();
    let [before, after] =
        [first > 0, first + MOST_OF_LINE < count].map(|is_cut| if is_cut { "…" } else { "" });
    format!("{before}{}{after}", visible(&shown))
}

/// A word as a POSIX shell reads it.
pub fn shell_word(word: &str) -> Cow<'_, str> {
    let is_plain =
        !word.is_empty() && word.chars().all(|c| c.is_ascii_alphanumeric() || "-_./=,:".contains(c));
    if is_plain { word.into() } else { format!("'{}'", word.replace('\'', r"'\''")).into() }
}

/// A command of replan with these arguments, as it can be pasted into a shell.
pub fn command(arguments: &[String]) -> String {
    arguments.iter().fold("replan".to_owned(), |line, word| line + " " + &shell_word(word))
}

/// A number as messages list it.
pub trait Number: Debug {}

impl Number for f64 {}
impl Number for i32 {}
impl Number for u32 {}

/// Numbers as messages list them: `[1.0, 2.5]`, and `[1, 2]` for whole ones.
pub fn listed<N: Number>(numbers: impl AsRef<[N]>) -> String {
    let numbers: Vec<String> = numbers.as_ref().iter().map(written).collect();
    format!("[{}]", numbers.join(", "))
}

/// A number that was computed from written ones, without the digits that rounding left behind: twelve count.
pub fn computed(value: f64) -> String {
    let rounded = format!("{value:.11e}").parse().unwrap_or(value);
    format!("{rounded}")
}

/// A number in its fewest digits, and with an exponent where those would be many.
pub fn written<N: Number>(number: &N) -> String {
    format!("{number:?}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_computed_number_is_written_without_what_rounding_left_behind() {
        for (value, text) in [
            (100.0 * 0.949, "94.9"),
            (1.302 - 1.1837, "0.1183"),
            (100.0 * 0.57, "57"),
            (-0.1 - 0.2, "-0.3"),
            (1.0 / 3.0, "0.333333333333"),
            (123_456_789.125, "123456789.125"),
            (0.0, "0"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(computed(value), text);
        }
    }

    #[test]
    fn marks_and_ends_of_lines_of_every_system_become_plain_text_and_other_encodings_are_named() {
        for text in ["a\nb\n", "\u{feff}a\nb\n", "a\r\nb\r\n", "\u{feff}a\rb\r"] {
            assert_eq!(decoded(text.into()).unwrap(), "a\nb\n", "{text:?}");
        }
        let utf16: Vec<u8> = "\u{feff}a".encode_utf16().flat_map(u16::to_le_bytes).collect();
        assert_eq!(decoded(utf16).unwrap_err(), "it is UTF-16 text; UTF-8 text is accepted");
        let bare: Vec<u8> = "größe: 1\n".encode_utf16().flat_map(u16::to_be_bytes).collect();
        let unmarked = "it seems to be UTF-16 text without a byte-order mark; UTF-8 text is accepted";
        assert_eq!(decoded(bare).unwrap_err(), unmarked);
        assert_eq!(decoded(b"a\0\0\0b".to_vec()).unwrap(), "a\0\0\0b");
        let latin = decoded(b"type\nm\xfcller".to_vec()).unwrap_err();
        assert_eq!(latin, "line 2, byte 6 of the file is not UTF-8; UTF-8 text is accepted");
    }

    #[test]
    fn what_cannot_be_seen_is_named_and_what_is_long_is_cut() {
        assert_eq!(
            visible("a\u{feff}b\u{a0}\t\u{7}"),
            "a‹byte-order mark›b‹no-break space›\t‹control character U+0007›"
        );
        assert!(matches!(visible("größer"), Cow::Borrowed(_)));
        assert_eq!(brief(&"x".repeat(61)), format!("{}…", "x".repeat(60)));
        let line: String = ('a'..='z').cycle().take(10_000).collect();
        for column in [0, 5000, 9999] {
            let shown = around(&line, column);
            let inner = shown.trim_matches('…');
            let from = line.find(inner).unwrap();
            assert_eq!(inner.chars().count(), 200, "{column}");
            assert!(
                (from..from + 200).contains(&(column % 26)) || column > 25 && shown.starts_with('…'),
                "{shown}"
            );
        }
        assert_eq!(around("short", 3), "short");
    }
}
