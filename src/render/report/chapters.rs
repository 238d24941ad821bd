//! Chapters between markers: one is put in its place, and everything else in the file stays as it is.

use std::collections::BTreeSet;
use std::ops::Range;

const BEGIN: &str = "<!-- replan begin ";
const END: &str = "<!-- replan end ";
const CLOSE: &str = " -->";

/// Markers that do not pair up: nothing is written then, since text could be lost.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "line {line}: {found}; every chapter stands once, between `{BEGIN}NAME{CLOSE}` and `{END}NAME{CLOSE}`"
)]
pub struct MarkerError {
    /// The line, from 1.
    pub line: usize,
    /// What stands there.
    pub found: String,
}

/// A chapter with its markers: its name, the line and bytes it takes.
struct Chapter<'a> {
    name: &'a str,
    line: usize,
    bytes: Range<usize>,
}

/// What a line of a report is.
enum Line<'a> {
    Begin(&'a str),
    End(&'a str),
    Text,
}

/// `report` with the chapter called `name` in the place of its former one. A new chapter stands before the first with a
/// later name, or behind the last. `opening` is the text with which an empty report begins.
///
/// # Errors
/// [`MarkerError`] if the markers in `report` do not pair up.
pub fn with_chapter(report: &str, opening: &str, name: &str, chapter: &str) -> Result<String, MarkerError> {
    let chapters = chapters(report)?;
    let safe = chapter.trim().replace("<!-- replan ", "&lt;!-- replan ");
    let written = format!("{BEGIN}{name}{CLOSE}\n\n{safe}\n\n{END}{name}{CLOSE}\n");
    if let Some(former) = chapters.iter().find(|chapter| chapter.name == name) {
        let Range { start, end } = former.bytes.clone();
        return Ok(format!("{}{written}{}", &report[..start], &report[end..]));
    }
    if let Some(later) = chapters.iter().find(|chapter| chapter.name > name) {
        let (before, after) = report.split_at(later.bytes.start);
        return Ok(format!("{before}{written}\n{after}"));
    }
    let at = chapters.last().map_or(report.len(), |last| last.bytes.end);
    let (before, after) = report.split_at(at);
    let before = if before.trim().is_empty() { opening } else { before };
    let newline = if before.ends_with('\n') { "" } else { "\n" };
    Ok(format!("{before}{newline}\n{written}{after}"))
}

/// The text of the chapter called `name`; empty if there is none.
///
/// # Errors
/// As [`with_chapter`].
pub fn chapter<'a>(report: &'a str, name: &str) -> Result<&'a str, MarkerError> {
    let bytes = chapters(report)?.into_iter().find(|chapter| chapter.name == name).map(|found| found.bytes);
    Ok(&report[bytes.unwrap_or(0..0)])
}

/// The report without the chapter called `name`.
///
/// # Errors
/// As [`with_chapter`].
pub fn without_chapter(report: &str, name: &str) -> Result<String, MarkerError> {
    let chapters = chapters(report)?;
    let bytes = chapters.into_iter().find(|chapter| chapter.name == name).map_or(0..0, |found| found.bytes);
    Ok(format!("{}{}", &report[..bytes.start], &report[bytes.end..]))
}

fn chapters(report: &str) -> Result<Vec<Chapter<'_>>, MarkerError> {
    let (mut found, mut seen): (Vec<Chapter<'_>>, _) = (Vec::new(), BTreeSet::new());
    let (mut open, mut at): (Option<Chapter<'_>>, _) = (None, 0);
    for (text, line) in report.split_inclusive('\n').zip(1..) {
        let wrong = |found: String| Err(MarkerError { line, found });
        let bytes = at..at + text.len();
        at = bytes.end;
        match (marker(text), open.take()) {
            (None, _) => return wrong(format!("`{}` is no whole marker", text.trim())),
            (Some(Line::Text), before) => open = before,
            (Some(Line::Begin(name)), Some(before)) => {
                return wrong(format!("`{name}` begins within `{}`", before.name));
            }
            (Some(Line::Begin(name)), None) if !seen.insert(name) => {
                return wrong(format!("`{name}` begins a second time"));
            }
            (Some(Line::Begin(name)), None) => open = Some(Chapter { name, line, bytes }),
            (Some(Line::End(name)), Some(before)) if before.name == name => {
                found.push(Chapter { bytes: before.bytes.start..bytes.end, ..before });
            }
            (Some(Line::End(name)), _) => return wrong(format!("`{name}` ends, but has not begun")),
        }
    }
    match open {
        Some(Chapter { name, line, .. }) => {
            Err(MarkerError { line, found: format!("`{name}` begins and has no end") })
        }
        None => Ok(found),
    }
}

/// What `line` is; `None` for a marker that is not alone on its line or not whole.
fn marker(line: &str) -> Option<Line<'_>> {
    let text = line.trim_end();
    if !text.contains(BEGIN) && !text.contains(END) {
        return Some(Line::Text);
    }
    let name = |rest: &'_ str| rest.strip_suffix(CLOSE).is_some_and(|n| !n.is_empty() && !n.contains("--"));
    match (text.strip_prefix(BEGIN), text.strip_prefix(END)) {
        (Some(rest), _) if name(rest) => Some(Line::Begin(&rest[..rest.len() - CLOSE.len()])),
        (_, Some(rest)) if name(rest) => Some(Line::End(&rest[..rest.len() - CLOSE.len()])),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const OPENING: &str = "# Opening\n";

    fn put(report: &str, name: &str, chapter: &str) -> String {
        with_chapter(report, OPENING, name, chapter).unwrap()
    }

    #[test]
    fn chapters_stand_in_the_order_of_their_names_and_are_replaced_alone() {
        let one = put("", "fu", "about fu");
        assert_eq!(one, "# Opening\n\n<!-- replan begin fu -->\n\nabout fu\n\n<!-- replan end fu -->\n");
        let all = put(&put(&put(&one, "zhang", "z"), "arm", "a"), "fu crosscheck", "c");
        let order = ["arm", "fu", "fu crosscheck", "zhang"].map(|name| {
            all.find(&format!("{BEGIN}{name}{CLOSE}\n\n")).unwrap_or_else(|| panic!("{name}\n{all}"))
        });
        assert!(order.is_sorted(), "{all}");
        let other = put(&all, "fu", "more about fu");
        assert_eq!(other, all.replace("about fu", "more about fu"));
        assert_eq!(put(&other, "fu", "about fu"), all);
        assert!(!without_chapter(&all, "fu").unwrap().contains("about fu"));
    }

    #[test]
    fn what_stands_outside_the_markers_stays_byte_for_byte() {
        let whole = put(&put("", "a", "first"), "c", "third");
        let remarked = whole
            .replace("# Opening", "My own opening")
            .replace("<!-- replan begin c", "A remark\u{e9}.\r\n\n<!-- replan begin c")
            + "\nA last word without an end of line";
        let again = put(&remarked, "c", "other");
        assert_eq!(again, remarked.replace("third", "other"));
        let more = put(&again, "b", "second");
        let back = without_chapter(&more, "b").unwrap();
        assert_eq!(back.replace("\n\n\n", "\n\n"), again.replace("\n\n\n", "\n\n"));
        assert!(put("only a remark", "a", "x").starts_with("only a remark\n\n<!-- replan begin a -->"));
    }

    #[test]
    fn markers_that_do_not_pair_up_are_refused_with_their_line() {
        let whole = put(&put("", "a", "first"), "b", "second");
        for (broken, line, found) in [
            (whole.replace("<!-- replan end a -->", ""), 9, "`b` begins within `a`"),
            (whole.replace("<!-- replan end b -->", ""), 9, "`b` begins and has no end"),
            (whole.replace("<!-- replan begin a -->", ""), 7, "`a` ends, but has not begun"),
            (whole.replace("begin b", "begin a").replace("end b", "end a"), 9, "`a` begins a second time"),
            (whole.replace("end a -->", "end a"), 7, "`<!-- replan end a` is no whole marker"),
            (whole.replace("<!-- replan begin a", "x <!-- replan begin a"), 3, "is no whole marker"),
        ] {
            let error = with_chapter(&broken, OPENING, "c", "third").unwrap_err();
            assert!(error.line == line && error.found.contains(found), "{error}\n{broken}");
        }
    }

    #[test]
    fn a_chapter_that_speaks_of_markers_does_not_break_the_report() {
        let text = put("", "a", "it writes `<!-- replan begin x -->` around chapters");
        assert_eq!(put(&text, "a", "it writes `<!-- replan begin x -->` around chapters"), text);
    }
}
