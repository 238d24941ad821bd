//! Lists of tries: which try of an instance is accepted, by the instance's seed.
//!
//! A line `for <fingerprint>` opens the instances that were found under one family's settings and revisions; below it, each
//! line holds a seed and the number of the try that was accepted. Lines that start with `#` say what the file is. Draws
//! under another fingerprint are left alone, so that a changed setting or revision is searched anew.

use std::collections::BTreeMap;
use std::path::Path;

/// Tries by seed in `file`, found under `fingerprint`.
///
/// # Errors
/// A message with the file, the line and what is accepted there.
pub fn read(file: &Path, fingerprint: &str) -> Result<BTreeMap<u64, u64>, String> {
    let text = base::file::read_text(file).map_err(|e| format!("{}: {e}", file.display()))?;
    parsed(&text, fingerprint).map_err(|message| format!("{}, {message}", file.display()))
}

fn parsed(text: &str, fingerprint: &str) -> Result<BTreeMap<u64, u64>, String> {
    let mut found = BTreeMap::new();
    let mut is_ours = false;
    for (number, line) in text.lines().enumerate().filter(|(_, line)| !line.starts_with('#')) {
        if let Some(of) = line.strip_prefix("for ") {
            is_ours = of == fingerprint;
            continue;
        }
        let parts = line.split_once(' ').and_then(|(seed, tries)| seed.parse().ok().zip(tries.parse().ok()));
        let (seed, tries): (u64, u64) = parts.ok_or_else(|| {
            format!(
                "line {}: found `{line}`; `for` and a fingerprint, or a seed and a count are accepted",
                number + 1
            )
        })?;
        if is_ours {
            found.insert(seed, tries);
        }
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn draws_under_another_fingerprint_are_left_alone() {
        let text = "# a list\nfor a\n7 3\nfor b\n7 4\n9 1\n";
        assert_eq!(parsed(text, "b").unwrap(), [(7, 4), (9, 1)].into());
        assert_eq!(parsed(text, "c").unwrap(), BTreeMap::new());
        let refused = parsed("for a\n7 x\n", "a").unwrap_err();
        assert!(refused.starts_with("line 2: found `7 x`"), "{refused}");
    }
}
