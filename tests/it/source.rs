//! The project's own source as tests read it: comments and the insides of strings blanked out, lines kept.

use std::fs;
use std::path::{Path, PathBuf};

/// Folders of `src` that are packages of their own; what is in none of them belongs to the package `replan`.
pub const PACKAGES: [&str; 10] =
    ["audit", "base", "engine", "export", "external", "proofs", "stats", "study", "verify", "world"];

/// One file below `src`.
pub struct File {
    /// Its path, from `src` on.
    pub path: PathBuf,
    /// Its code; comments and the insides of strings are spaces.
    pub code: String,
}

impl File {
    pub fn new(path: &str, text: &str) -> Self {
        Self { path: PathBuf::from(path), code: code(text) }
    }

    /// The package it belongs to: a folder of `src`, or `replan`.
    pub fn package(&self) -> &str {
        let first = self.path.iter().next().and_then(|part| part.to_str()).unwrap_or_default();
        if PACKAGES.contains(&first) { first } else { "replan" }
    }

    /// The modules on the way to it from its package's root: `base/grid/mod.rs` is `["grid"]`.
    pub fn modules(&self) -> Vec<String> {
        let parts = self.path.with_extension("");
        let parts = parts.iter().map(|part| part.to_string_lossy().into_owned());
        let mut parts: Vec<String> = parts.skip(usize::from(self.package() != "replan")).collect();
        if parts.last().is_some_and(|last| ["mod", "lib", "main"].contains(&last.as_str())) {
            parts.pop();
        }
        parts
    }
}

/// Every Rust file below `src`, in the order of their paths.
pub fn files() -> Vec<File> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut found = Vec::new();
    visit(&root, &mut found);
    found.sort();
    let file = |path: PathBuf| {
        let text = fs::read_to_string(&path).unwrap();
        File::new(path.strip_prefix(&root).unwrap().to_str().unwrap(), &text)
    };
    found.into_iter().map(file).collect()
}

fn visit(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            visit(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            found.push(path);
        }
    }
}

/// `text` with comments and the insides of string and character literals turned into spaces.
fn code(text: &str) -> String {
    let mut code = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let (length, is_code) = token(rest, first, code.chars().last());
        let (taken, left) = rest.split_at(length);
        code.extend(taken.chars().map(|c| if is_code || c == '\n' { c } else { ' ' }));
        rest = left;
    }
    code
}

/// How many bytes the token at the start of `rest` has, and whether it is code.
fn token(rest: &str, first: char, before: Option<char>) -> (usize, bool) {
    let after_name = before.is_some_and(|c| c.is_alphanumeric() || c == '_');
    if rest.starts_with("//") {
        return (rest.find('\n').unwrap_or(rest.len()), false);
    }
    if rest.starts_with("/*") {
        return (rest.find("*/").map_or(rest.len(), |at| at + 2), false);
    }
    if first == '"' {
        return (quoted(rest, '"'), false);
    }
    if first == 'r' && !after_name {
        let hashes = rest[1..].chars().take_while(|c| *c == '#').count();
        if rest[1 + hashes..].starts_with('"') {
            let end = format!("\"{}", "#".repeat(hashes));
            let body = 2 + hashes;
            return (rest[body..].find(&end).map_or(rest.len(), |at| body + at + end.len()), false);
        }
    }
    let is_char = first == '\'' && (rest[1..].starts_with('\\') || rest[1..].chars().nth(1) == Some('\''));
    if is_char {
        return (quoted(rest, '\''), false);
    }
    (first.len_utf8(), true)
}

fn quoted(rest: &str, quote: char) -> usize {
    let mut escaped = false;
    for (at, c) in rest.char_indices().skip(1) {
        match c {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            _ if c == quote => return at + 1,
            _ => {}
        }
    }
    rest.len()
}

#[test]
fn comments_and_literals_are_not_code() {
    let text = "a // b \"\n'x' '\\'' 'q: loop \"c // \\\" d\" e /* f\n g */ r#\"h \" i\"# j";
    assert_eq!(code(text).split_whitespace().collect::<Vec<_>>(), ["a", "'q:", "loop", "e", "j"]);
    assert_eq!(code(text).lines().count(), text.lines().count());
}
