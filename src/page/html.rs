//! Text as HTML that shows it literally.

use base::text::shown;

/// `text` in which nothing is taken for a tag, an entity or the end of an attribute, and characters that act are named.
pub fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for character in shown(text).chars() {
        match character {
            '&' => safe += "&amp;",
            '<' => safe += "&lt;",
            '>' => safe += "&gt;",
            '"' => safe += "&quot;",
            '\'' => safe += "&#39;",
            other => safe.push(other),
        }
    }
    safe
}

/// The same; what stands between backticks is code, and leads to a claim where `is_claim` says that it is one.
pub(super) fn prose(text: &str, is_claim: impl Fn(&str) -> bool) -> String {
    let pieces: Vec<&str> = text.split('`').collect();
    if pieces.len().is_multiple_of(2) {
        return escaped(text);
    }
    let piece = |(at, piece): (usize, &&str)| match (at % 2, is_claim(piece)) {
        (0, _) => escaped(piece),
        (_, true) => format!("<a href=\"#claim={0}\"><code>{0}</code></a>", escaped(piece)),
        (_, false) => format!("<code>{}</code>", escaped(piece)),
    };
    pieces.iter().enumerate().map(piece).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_text_becomes_a_tag() {
        let nasty = "<script>alert('x')</script> & \"quoted\" `a<b` `zhang`";
        let html = prose(nasty, |code| code == "zhang");
        assert!(!html.contains("<script") && !html.contains("a<b"), "{html}");
        assert!(html.contains("<a href=\"#claim=zhang\"><code>zhang</code></a>"), "{html}");
        assert_eq!(escaped("a\u{1b}[2J\u{202e}b"), "a‹escape›[2J‹U+202E›b");
        assert!(!escaped(nasty).contains(['<', '>', '"', '\'']), "{}", escaped(nasty));
    }

    #[test]
    fn a_lone_backtick_stays_text() {
        assert_eq!(prose("a ` b", |_| true), "a ` b");
    }
}
