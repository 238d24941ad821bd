//! Text: a paper's own words with our numbers put in, Markdown that shows text as it is, and lines of limited length.

use super::effect::{effect, percentage, rounded, side_by_side};
use crate::analysis::across::tested::{FITS, REFUSES};
use crate::analysis::verdict::{ClaimVerdict, Estimate, Verdicts};
use base::text::shown;
use study::paper::filled;

/// Paragraphs and lists are broken into lines of this many characters.
pub const COLUMNS: usize = 120;

/// `text` with every `{claim}` replaced by our number beside that claim, and every `{claim:form}` by the text that the form names; a
/// dash where there is none.
pub fn prose(text: &str, verdicts: &Verdicts) -> String {
    let beside = |parts: Vec<(&Estimate, Option<&str>)>| side_by_side(&parts).map(|[numbers, _]| numbers);
    filled(text, |claim, form| {
        let judged = verdicts.claim(claim);
        let ours = judged.and_then(|judged| judged.ours());
        let interval = ours.and_then(|ours| ours.interval);
        let found = match form {
            "verdict" => judged.map(ClaimVerdict::verdict_text),
            "interpretations" => judged.and_then(ClaimVerdict::rests_on),
            "n" => ours.map(|ours| ours.n.to_string()),
            "cases" => ours.and_then(|ours| ours.solved).map(|[_, all]| all.to_string()),
            "tenths" => ours.map(|ours| rounded(ours.value, 1)),
            "effect" => ours
                .map(|ours| effect(ours).unwrap_or_else(|| number(ours.value)))
                .or_else(|| beside(verdicts.parts_ours(judged?))),
            "shown" => judged.and_then(|judged| beside(judged.shown().map(|ours| (ours, None)).collect())),
            "percent" => ours.map(percentage),
            "percent_low" => interval.map(|[low, _]| format!("{} %", rounded(100.0 * low, 1))),
            "interval" => interval.map(|[low, high]| format!("[{low:.1}, {high:.1}]")),
            "fits" => judged.and_then(|judged| judged.by_option(FITS).next()).map(str::to_owned),
            "refuses" => judged.and_then(|judged| judged.by_option(REFUSES).next()).map(str::to_owned),
            "power" => judged.and_then(ClaimVerdict::power).map(str::to_owned),
            "low" => interval.map(|[low, _]| three_digits(low)),
            "high" => interval.map(|[_, high]| three_digits(high)),
            _ => ours.map(|ours| number(ours.value)),
        };
        found.unwrap_or_else(|| "–".to_owned())
    })
}

/// `name` with a capital first letter.
pub fn capital(name: &str) -> String {
    let mut letters = name.chars();
    let first = letters.next().map(|letter| letter.to_ascii_uppercase());
    first.into_iter().chain(letters).collect()
}

/// A number with three significant digits, those before the point kept.
fn three_digits(value: f64) -> String {
    let digits = libm::floor(libm::log10(value.abs()));
    if digits.is_finite() { rounded(value, (2.0 - digits).max(0.0) as usize) } else { number(value) }
}

/// A number with four decimals at most; what these would show as zero stands as a power of ten.
pub fn number(value: f64) -> String {
    if value != 0.0 && value.abs() < 5e-5 {
        return format!("{value:.1e}");
    }
    let text = format!("{value:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.').to_owned();
    if text == "-0" { "0".to_owned() } else { text }
}

/// `text` as Markdown that shows it literally, on one line, characters that act named; what stands between backticks is code.
pub fn markdown(text: &str) -> String {
    let text = shown(text).split_whitespace().collect::<Vec<_>>().join(" ");
    let pieces: Vec<&str> = text.split('`').collect();
    let is_code = pieces.len() % 2 == 1 && pieces.iter().skip(1).step_by(2).all(|code| !code.is_empty());
    if !is_code {
        return literal(&text);
    }
    // A bar would end a table's cell, in code as well.
    let piece = |(at, piece): (usize, &&str)| {
        if at % 2 == 1 { format!("`{}`", piece.replace('|', "\\|")) } else { literal(piece) }
    };
    pieces.iter().enumerate().map(piece).collect()
}

/// Text without code, its marks escaped where Markdown, its tables, mathematics or HTML would take them for more than text.
fn literal(text: &str) -> String {
    let characters: Vec<char> = text.chars().collect();
    let mut safe = String::with_capacity(text.len());
    for (at, character) in characters.iter().enumerate() {
        let before = at.checked_sub(1).and_then(|before| characters.get(before));
        let is_in_word = before.is_some_and(|before| before.is_alphanumeric());
        let (has_next, has_word_next) = characters
            .get(at + 1)
            .map_or((false, false), |next| (!next.is_whitespace(), next.is_alphanumeric()));
        match character {
            '<' => safe += "&lt;",
            '&' if has_word_next || characters.get(at + 1) == Some(&'#') => safe += "&amp;",
            '*' if has_word_next || has_next && !is_in_word => safe += "\\*",
            '_' if has_next && !is_in_word => safe += "\\_",
            '\\' | '`' | '|' | '$' | '~' => safe.extend(['\\', *character]),
            ']' if matches!(characters.get(at + 1), Some('(' | '[' | ':')) => safe += "\\]",
            other => safe.push(*other),
        }
    }
    safe
}

/// `first` and then the words of `text`, on lines of at most `columns` characters where words allow it, those after the first
/// indented by `indent`. No line begins with what Markdown would take for the beginning of a list or a heading.
pub fn wrapped(first: &str, text: &str, indent: usize, columns: usize) -> String {
    broken(first, text, [indent, columns], begins_a_block)
}

/// As [`wrapped`], for a terminal: any word may begin a line.
pub fn plain(first: &str, text: &str, indent: usize, columns: usize) -> String {
    broken(first, text, [indent, columns], |_| false)
}

/// `rows` as lines: each column is as wide as its widest cell of at most `most` characters. After a wider cell the rest
/// of its row stands on a line of its own.
pub fn columns<const N: usize>(rows: &[[String; N]], most: [usize; N]) -> Vec<String> {
    let width = |at: usize| {
        rows.iter().map(|row| row[at].chars().count()).filter(|&wide| wide <= most[at]).max().unwrap_or(0)
    };
    let mut places = [0; N];
    for at in 1..N {
        places[at] = places[at - 1] + width(at - 1) + 2;
    }
    let line = |row: &[String; N]| {
        let mut text = String::new();
        let mut at = 0;
        for (cell, place) in row.iter().zip(places) {
            if at > 0 && at + 2 > place {
                text += "\n";
                at = 0;
            }
            text += &format!("{}{cell}", " ".repeat(place - at));
            at = place + cell.chars().count();
        }
        text + "\n"
    };
    rows.iter().map(line).collect()
}

/// The words on lines; none begins with a word that `stays` with the one before.
fn broken(first: &str, text: &str, [indent, columns]: [usize; 2], stays: fn(&str) -> bool) -> String {
    let mut lines = Vec::new();
    let mut line = first.to_owned();
    let mut is_fresh = true;
    for word in text.split_whitespace() {
        if !is_fresh && line.chars().count() + 1 + word.chars().count() > columns && !stays(word) {
            lines.push(std::mem::replace(&mut line, " ".repeat(indent)));
            is_fresh = true;
        }
        if !is_fresh {
            line.push(' ');
        }
        line += word;
        is_fresh = false;
    }
    lines.push(line);
    lines.join("\n")
}

fn begins_a_block(word: &str) -> bool {
    let number = word.trim_end_matches(['.', ')']);
    matches!(word, "-" | "+" | "*" | ">")
        || word.starts_with(['#', '=', '>'])
        || number.len() < word.len() && number.bytes().all(|byte| byte.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_of_markdown_tables_mathematics_and_html_stay_text() {
        for (text, safe) in [
            ("a | b <script> $x$ & c", "a \\| b &lt;script> \\$x\\$ & c"),
            ("A* and A*'s (A*)", "A* and A*'s (A*)"),
            ("*bold* _slanted_ snake_case 2*3", "\\*bold* \\_slanted_ snake_case 2\\*3"),
            ("see [27.0, 30.1] and [a](b)", "see [27.0, 30.1] and [a\\](b)"),
            ("one `tick", "one \\`tick"),
            ("code `a|*b*<i>` ends", "code `a\\|*b*<i>` ends"),
            ("&lt; and\nmore", "&amp;lt; and more"),
        ] {
            assert_eq!(markdown(text), safe);
        }
    }

    #[test]
    fn lines_break_at_words_and_never_before_what_would_begin_a_list() {
        assert_eq!(wrapped("- ", "one two three", 2, 8), "- one\n  two\n  three");
        assert_eq!(wrapped("", "it is 9 + 4 = 13. or more", 0, 7), "it is 9 +\n4 = 13.\nor more");
        assert_eq!(plain("", "it is 9 + 4 = 13. or more", 0, 7), "it is 9\n+ 4 =\n13. or\nmore");
    }
}
