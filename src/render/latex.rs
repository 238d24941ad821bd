//! LaTeX: booktabs tables and files of number macros.
//!
//! What is written compiles in a bare `article` with `booktabs` and `tabularx`. Text is escaped here.

mod table;

pub use table::{Cell, Column, Table};

use super::RenderError;
use super::prose::capital;
use base::text::{one_line, shown};
use std::collections::BTreeMap;

/// `text` as LaTeX shows it literally: special characters escaped, known signs in mathematics mode,
/// characters that act named.
///
/// Signs of Unicode that have no entry here are kept; a UTF-8 source with a rich font shows them.
pub fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for character in shown(text).chars() {
        match literal(character) {
            Some(latex) => safe.push_str(latex),
            None => safe.push(character),
        }
    }
    safe
}

/// How LaTeX writes a character that it would not print as it stands.
fn literal(character: char) -> Option<&'static str> {
    Some(match character {
        '\\' => "\\textbackslash{}",
        '{' => "\\{",
        '}' => "\\}",
        '$' => "\\$",
        '&' => "\\&",
        '#' => "\\#",
        '%' => "\\%",
        '_' => "\\_",
        '^' => "\\textasciicircum{}",
        '~' => "\\textasciitilde{}",
        '<' => "\\ensuremath{<}",
        '>' => "\\ensuremath{>}",
        '|' => "\\ensuremath{|}",
        '−' => "\\ensuremath{-}",
        '×' => "\\ensuremath{\\times}",
        '·' => "\\ensuremath{\\cdot}",
        '±' => "\\ensuremath{\\pm}",
        '≤' => "\\ensuremath{\\leq}",
        '≥' => "\\ensuremath{\\geq}",
        '≠' => "\\ensuremath{\\neq}",
        '∞' => "\\ensuremath{\\infty}",
        '→' => "\\ensuremath{\\to}",
        '√' => "\\ensuremath{\\surd}",
        '°' => "\\ensuremath{^\\circ}",
        '²' => "\\ensuremath{^2}",
        '³' => "\\ensuremath{^3}",
        '½' => "\\ensuremath{\\frac{1}{2}}",
        '–' => "--",
        '—' => "---",
        '…' => "\\ldots{}",
        '\u{2009}' | '\u{202f}' => "\\,",
        '\u{a0}' => "~",
        greek => return greek_letter(greek),
    })
}

fn greek_letter(letter: char) -> Option<&'static str> {
    Some(match letter {
        'α' => "\\ensuremath{\\alpha}",
        'β' => "\\ensuremath{\\beta}",
        'γ' => "\\ensuremath{\\gamma}",
        'δ' => "\\ensuremath{\\delta}",
        'θ' => "\\ensuremath{\\theta}",
        'λ' => "\\ensuremath{\\lambda}",
        'μ' | 'µ' => "\\ensuremath{\\mu}",
        'π' => "\\ensuremath{\\pi}",
        'ρ' => "\\ensuremath{\\rho}",
        'σ' => "\\ensuremath{\\sigma}",
        'φ' => "\\ensuremath{\\varphi}",
        'Δ' => "\\ensuremath{\\Delta}",
        'Σ' => "\\ensuremath{\\Sigma}",
        _ => return None,
    })
}

/// The macro name of a key: words in camel case, digits in words, since TeX takes letters only.
///
/// # Errors
/// [`RenderError::EmptyMacro`] if the key has neither letter nor digit.
pub fn macro_name(key: &str) -> Result<String, RenderError> {
    const DIGITS: [&str; 10] =
        ["Zero", "One", "Two", "Three", "Four", "Five", "Six", "Seven", "Eight", "Nine"];
    let mut name = String::new();
    let mut capital = false;
    for character in key.chars() {
        if let Some(digit) = character.to_digit(10) {
            name.push_str(DIGITS[digit as usize]);
            capital = true;
        } else if character.is_ascii_alphabetic() {
            name.push(if capital { character.to_ascii_uppercase() } else { character });
            capital = false;
        } else {
            capital = !name.is_empty();
        }
    }
    if name.is_empty() { Err(RenderError::EmptyMacro(key.to_owned())) } else { Ok(name) }
}

/// A file of numbers: one `\newcommand` each, so that a text can quote them without copying, and a line on what it is.
#[derive(Clone, Debug, Default)]
pub struct Numbers {
    /// By their names: the key, the value, and what it is.
    macros: BTreeMap<String, [String; 3]>,
}

impl Numbers {
    /// Adds `value` (text; it is escaped) under the macro name of `key`; `what` it is stands behind it.
    ///
    /// # Errors
    /// [`RenderError::EmptyMacro`] if the key gives no name, [`RenderError::DuplicateMacro`] if another
    /// key gave the same.
    pub fn add(&mut self, key: &str, value: &str, what: &str) -> Result<(), RenderError> {
        let name = capital(&macro_name(key)?);
        if let Some([first, ..]) = self.macros.get(&name) {
            let (first, second) = (first.clone(), key.to_owned());
            return Err(RenderError::DuplicateMacro { name, first, second });
        }
        self.macros.insert(name, [key, value, what].map(str::to_owned));
        Ok(())
    }

    /// The file: macros in the order of their names, under a comment that says how it was `made`.
    ///
    /// Names start with that of `prefix`, so that none is a command of LaTeX.
    ///
    /// # Errors
    /// [`RenderError::EmptyMacro`] if the prefix gives no name.
    pub fn latex(&self, prefix: &str, made: &str) -> Result<String, RenderError> {
        let prefix = macro_name(prefix)?;
        let mut text = comment(made);
        for (name, [key, value, what]) in &self.macros {
            let value = escaped(value);
            let what = comment(&format!("{key}: {}", what.replace('\n', " ")));
            text += &format!("\\newcommand{{\\{prefix}{name}}}{{{value}}} {what}");
        }
        Ok(text)
    }
}

/// `text` as comments, a line each: nothing in it ends the comment.
fn comment(text: &str) -> String {
    text.lines().fold(String::new(), |all, line| all + "% " + &one_line(line) + "\n")
}

#[cfg(test)]
mod tests;
