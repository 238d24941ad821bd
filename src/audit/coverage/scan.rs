//! A walk through an author's LaTeX, line by line, that finds the numbers a reader sees.

/// Commands whose arguments hold no number of the text, by how many arguments they have.
const SILENT: [(usize, &str); 3] = [
    (
        1,
        "label ref eqref cref Cref autoref pageref cite citep citet nocite includegraphics input include \
     subfile usepackage documentclass end vspace hspace bibliography bibliographystyle url href \
     hypersetup geometry color textcolor def cmidrule",
    ),
    (
        2,
        "setcounter addtocounter setlength addtolength newcommand renewcommand providecommand multicolumn \
     multirow",
    ),
    (3, "begin definecolor"),
];

/// Numbers and ordinals in words; `one` is as often a pronoun, `first` and `second` order sentences and name units.
const WORDS: &str = "zero two three four five six seven eight nine ten eleven twelve thirteen fourteen fifteen sixteen \
     seventeen eighteen nineteen twenty thirty forty fifty sixty seventy eighty ninety hundred thousand \
     million billion dozen half halves quarter twice thrice double triple quadruple twofold threefold \
     fourfold fivefold tenfold hundredfold thirds quarters fifths tenths third fourth fifth sixth \
     seventh eighth ninth tenth eleventh twelfth thirteenth fourteenth fifteenth sixteenth seventeenth \
     eighteenth nineteenth twentieth hundredth thousandth dozens hundreds thousands millions billions \
     doubles doubled triples tripled halved";

/// Commands that divide their first argument by their second.
const FRACTIONS: [&str; 5] = ["frac", "tfrac", "dfrac", "nicefrac", "sfrac"];

/// A number that stands in the text.
pub(super) struct Occurrence {
    /// Line, from 1.
    pub(super) line: usize,
    /// Column in characters, from 1.
    pub(super) column: usize,
    /// Its digits, without marks of thousands, or its word.
    pub(super) number: String,
}

/// The numbers that stand in the text as such, in digits or in words, but for those that a comment on their line excuses
/// (`% typed: 2, twelve`); and every command, with the place of its backslash.
pub(super) struct Scanned {
    pub(super) numbers: Vec<Occurrence>,
    pub(super) commands: Vec<Occurrence>,
}

fn is_among(words: &str, word: &str) -> bool {
    words.split(' ').any(|known| known == word)
}

/// Walks through a text.
pub(super) fn scanned(text: &str) -> Scanned {
    let body = text.find("\\begin{document}").map_or(0, |at| at + "\\begin{document}".len());
    let end = text.find("\\end{document}").unwrap_or(text.len()).max(body);
    let first = text[..body].matches('\n').count();
    let mut scan = Scan { depth: 0, left: 0, behind: 0, found: Vec::new(), commands: Vec::new() };
    for (index, line) in text[body..end].split('\n').enumerate() {
        let offset = if index == 0 {
            text[..body].rsplit('\n').next().map_or(0, |before| before.chars().count())
        } else {
            0
        };
        let written = uncommented(line);
        let known = scan.found.len();
        scan.line(first + index + 1, offset, written);
        let comment = line[written.len()..].trim_start_matches('%').trim();
        if let Some(typed) = comment.strip_prefix("typed:") {
            let excused: Vec<&str> = typed.split(',').map(str::trim).collect();
            let on_line = scan.found.split_off(known);
            scan.found.extend(on_line.into_iter().filter(|found| !excused.contains(&found.number.as_str())));
        }
    }
    Scanned { numbers: scan.found, commands: scan.commands }
}

/// A line without its comment.
pub(super) fn uncommented(line: &str) -> &str {
    let mut is_escaped = false;
    for (at, c) in line.char_indices() {
        if c == '%' && !is_escaped {
            return &line[..at];
        }
        is_escaped = c == '\\' && !is_escaped;
    }
    line
}

struct Scan {
    /// Open brackets of an argument that is not looked at …
    depth: usize,
    /// … and how many such arguments of the command are left.
    left: usize,
    /// Where the name of the last command ends: what follows is no part of a word.
    behind: usize,
    found: Vec<Occurrence>,
    commands: Vec<Occurrence>,
}

impl Scan {
    fn line(&mut self, line: usize, offset: usize, text: &str) {
        let chars: Vec<char> = text.chars().collect();
        let mut at = 0;
        self.behind = usize::MAX;
        while at < chars.len() {
            let c = chars[at];
            let start = at;
            let number = if self.depth > 0 {
                at = self.silent(&chars, at);
                None
            } else if let Some((number, end)) = fraction(&chars, at) {
                at = end;
                Some(number)
            } else if c == '\\' {
                at = self.command(&chars, at + 1);
                self.name(&chars, start, line, offset);
                None
            } else if c.is_ascii_digit() {
                let (number, end) = digits(&chars, at);
                at = end;
                (!is_part_of_more(&chars, start, end, start == self.behind)).then_some(number)
            } else if c.is_alphabetic() {
                at = (at..chars.len()).find(|at| !chars[*at].is_alphanumeric()).unwrap_or(chars.len());
                let word = chars[start..at].iter().collect::<String>();
                is_among(WORDS, &word.to_lowercase()).then_some(word)
            } else {
                at += 1;
                None
            };
            let column = offset + start + 1;
            self.found.extend(number.map(|number| Occurrence { line, column, number }));
        }
    }

    /// Notes the command whose backslash stands at `start`.
    fn name(&mut self, chars: &[char], start: usize, line: usize, offset: usize) {
        let letters = chars[start + 1..].iter().take_while(|c| c.is_ascii_alphabetic());
        let number: String = letters.collect();
        self.behind = start + 1 + number.len();
        if !number.is_empty() {
            self.commands.push(Occurrence { line, column: offset + start + 1, number });
        }
    }

    /// Passes a character of an argument that is not looked at.
    fn silent(&mut self, chars: &[char], at: usize) -> usize {
        match chars[at] {
            '{' | '[' => self.depth += 1,
            '}' | ']' => self.depth -= 1,
            _ => {}
        }
        if self.depth > 0 {
            return at + 1;
        }
        self.left -= usize::from(chars[at] == '}').min(self.left);
        self.enter(chars, at + 1)
    }

    /// Enters the argument that starts here, if one is left.
    fn enter(&mut self, chars: &[char], at: usize) -> usize {
        let opens = self.left > 0 && matches!(chars.get(at), Some('{' | '['));
        self.depth = usize::from(opens);
        at + usize::from(opens)
    }

    /// Passes a command's name and, if it is a silent one, enters its arguments.
    fn command(&mut self, chars: &[char], start: usize) -> usize {
        let name_end = |start: usize| {
            (start..chars.len()).find(|at| !chars[*at].is_ascii_alphabetic()).unwrap_or(chars.len())
        };
        let mut end = name_end(start);
        let name: String = chars[start..end].iter().collect();
        let Some((arguments, _)) = SILENT.iter().find(|(_, known)| is_among(known, &name)) else {
            return end.max(start + usize::from(end == start));
        };
        while chars.get(end) == Some(&'*') {
            end += 1;
        }
        // `\def\name{…}` has its name outside of brackets.
        if name == "def" && chars.get(end) == Some(&'\\') {
            end = name_end(end + 1);
        }
        self.left = *arguments;
        self.enter(chars, end)
    }
}

/// The number that starts at `start`, without marks between its thousands, and where it ends.
fn digits(chars: &[char], start: usize) -> (String, usize) {
    let is_digit = |at: usize| chars.get(at).is_some_and(char::is_ascii_digit);
    let mut number = String::new();
    let mut at = start;
    while is_digit(at) || chars.get(at) == Some(&'.') && is_digit(at + 1) {
        number.push(chars[at]);
        at += 1;
        let mark = ["{,}", "\\,", ","].into_iter().find(|mark| {
            mark.chars().enumerate().all(|(index, c)| chars.get(at + index) == Some(&c))
                && (0..3).all(|digit| is_digit(at + mark.len() + digit))
                && !is_digit(at + mark.len() + 3)
        });
        if let Some(mark) = mark.filter(|_| !number.contains('.') && !is_digit(at)) {
            at += mark.len();
        }
    }
    (number, at)
}

/// The fraction of two numbers that starts here, as `1/2`, and where it ends: `\frac12`, `\frac{1}{2}`, `\tfrac{3}5`.
fn fraction(chars: &[char], start: usize) -> Option<(String, usize)> {
    let rest: String = chars[start..].iter().take(60).collect();
    let name = FRACTIONS.iter().find(|name| {
        let behind = rest.strip_prefix('\\').and_then(|rest| rest.strip_prefix(**name));
        behind.is_some_and(|behind| !behind.starts_with(|c: char| c.is_ascii_alphabetic()))
    })?;
    let mut at = start + 1 + name.len();
    let mut argument = || {
        while chars.get(at) == Some(&' ') {
            at += 1;
        }
        let inner: String = if chars.get(at) == Some(&'{') {
            let end = chars[at..].iter().position(|c| *c == '}')?;
            let inner = chars[at + 1..at + end].iter().collect();
            at += end + 1;
            inner
        } else {
            at += 1;
            chars.get(at - 1)?.to_string()
        };
        let is_number = inner.contains(|c: char| c.is_ascii_digit())
            && inner.chars().all(|c| c.is_ascii_digit() || ".-".contains(c));
        is_number.then_some(inner)
    };
    let (above, below) = (argument()?, argument()?);
    Some((format!("{above}/{below}"), at))
}

/// Whether digits are part of a word, a length, or a script; right behind a command's name they are no part of it.
fn is_part_of_more(chars: &[char], start: usize, end: usize, is_behind_a_command: bool) -> bool {
    let before = start.checked_sub(1).map(|at| chars[at]).filter(|_| !is_behind_a_command);
    let in_script = before == Some('{') && start >= 2 && matches!(chars[start - 2], '_' | '^');
    let in_word = before.is_some_and(|c| c.is_alphanumeric() || matches!(c, '_' | '^'));
    let after: String = chars[end..].iter().take(4).collect();
    let follows = |units: &[&str]| units.iter().any(|unit| after.starts_with(unit));
    // A centimetre in a sentence is a result; in brackets it is the size of something on the page.
    let in_brackets = matches!(before, Some('{' | '[' | '='));
    let is_length = follows(&["pt", "em", "ex", "\\tex", "\\lin", "\\col"])
        || in_brackets && follows(&["cm}", "cm]", "mm}", "mm]", "in}", "in]"]);
    in_word || in_script || is_length
}
