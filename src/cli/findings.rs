//! The end of `repro`: the finding, and the headline claims with their verdicts.

use super::Which;
use super::verdicts::{COLUMNS, Lines, coloured, tallied};
use crate::analysis::outcome::Outcome;
use crate::analysis::verdict::{ClaimVerdict, Verdicts};
use crate::analysis::verdict_rule::Verdict;
use crate::render::headline::{Headline, headlines};
use crate::render::prose::{plain, prose};
use study::paper::Paper;

/// How many claims that cannot be true are named.
const IMPOSSIBLE: usize = 6;

/// How many lines of 40 the terminal leaves beside those that `repro` prints before and after.
const LINES: usize = 34;

/// What stands beside verdicts, and its meaning below the claims. An interpretation takes one option for each choice.
const LEGEND: [(&str, &str); 4] = [
    ("for/open/against", "interpretations (one option for each choice) that agree, cannot tell, contradict"),
    ("same under all", "no interpretation changes the result"),
    ("met under", "where our number meets the printed one"),
    ("choices not varied", "other options of these were not tried for the claim"),
];

/// Columns for a verdict.
const VERDICT: usize = 18;

/// Prints the finding and the headline claims, a line for what it says and one for what its verdict rests on.
pub(super) fn print(paper: &Paper, verdicts: &Verdicts, which: &Which) {
    let shapes = [
        (Below::Everything, Choices::Explained),
        (Below::Counts, Choices::Explained),
        (Below::Everything, Choices::Named),
        (Below::Counts, Choices::Named),
        (Below::Nothing, Choices::Named),
    ];
    let mut texts = shapes.map(|shape| text(paper, verdicts, which, shape)).into_iter();
    let fits = |text: &String| text.lines().count() <= LINES;
    let shortest = texts.next_back().unwrap_or_default();
    say!("{}", texts.find(fits).unwrap_or(shortest).trim_end());
}

/// What stands below a headline claim.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Below {
    /// Its id, the counts, on what its verdict depends, and the exceptions.
    Everything,
    /// Its id and the counts.
    Counts,
    /// Nothing: its id stands behind our number.
    Nothing,
}

/// How the choices appear that the lines below claims name.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Choices {
    /// The legend says of each what the paper leaves open.
    Explained,
    /// Their ids alone, and how one is explained.
    Named,
}

fn text(paper: &Paper, verdicts: &Verdicts, which: &Which, (below, choices): (Below, Choices)) -> String {
    let mut text = String::from("\n");
    if let Some(finding) = &paper.report.finding {
        text += &(plain("", &prose(finding, verdicts), 0, COLUMNS) + "\n\n");
    }
    let mut named = String::new();
    for headline in headlines(paper, verdicts) {
        let words = match below {
            Below::Everything => headline.rests_on(verdicts),
            Below::Counts | Below::Nothing => headline.beside(verdicts),
        };
        named += &format!(" {};", words.as_deref().unwrap_or_default());
        text += &lines(&headline, words, below == Below::Nothing);
    }
    let legend = LEGEND.iter().filter(|(words, _)| named.contains(words));
    let mut notes: Vec<String> = legend.map(|(words, meaning)| format!("{words}: {meaning}")).collect();
    let mut open = paper.choices.iter().filter(|choice| names(&named, &choice.id));
    if choices == Choices::Explained {
        notes.extend(open.map(|choice| {
            let clause = choice.why.split([';', ':']).next().unwrap_or_default();
            format!("{}: {}", choice.id, clause.split(". ").next().unwrap_or_default())
        }));
    } else if let (Some(line), Some(choice)) = (notes.last_mut(), open.next()) {
        *line += &format!("; a choice: {} {}", which.command("show"), choice.id);
    }
    if below == Below::Nothing {
        notes = vec![notes.join("; ")];
    }
    notes.extend(impossible(verdicts));
    let notes: String =
        notes.iter().filter(|line| !line.is_empty()).map(|line| plain("", line, 2, COLUMNS) + "\n").collect();
    if !notes.is_empty() {
        text += &format!("\n{notes}");
    }
    text + "\n" + &tallied(Some(paper), verdicts, which, Lines::Few)
}

/// Whether the lines below claims speak of the choice `id`, whose id may be a plain word too.
fn names(lines: &str, id: &str) -> bool {
    let phrases = [format!(" {id} = "), format!(" {id} matters most"), format!(" depends on {id}")];
    phrases.iter().any(|phrase| lines.contains(phrase))
}

/// The claims that a proof refuses, with what they print; of a row its cells.
fn impossible(verdicts: &Verdicts) -> Option<String> {
    let is_proved = |judged: &&ClaimVerdict| {
        let is_whole = verdicts.claims.iter().any(|part| part.part_of.as_ref() == Some(&judged.claim));
        !is_whole && judged.findings.iter().any(|finding| finding.outcome == Some(Outcome::Proved))
    };
    let name = |judged: &ClaimVerdict| {
        let printed = judged.printed.as_ref().map_or_else(String::new, |printed| format!(" ({printed})"));
        judged.claim.clone() + &printed
    };
    let proved = verdicts.claims.iter().filter(|judged| judged.verdict == Verdict::Impossible);
    let names: Vec<String> = proved.filter(is_proved).map(name).collect();
    let more = names.len().saturating_sub(IMPOSSIBLE);
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    let listed = names.iter().take(IMPOSSIBLE).cloned().collect::<Vec<_>>().join(", ");
    (!names.is_empty()).then(|| format!("cannot be true: {listed}{more}"))
}

/// The verdict, what the paper says and our number; below, or with `is_one` behind them, the claim and what its verdict rests on,
/// which names the choices that it depends on.
fn lines(headline: &Headline<'_>, rests_on: Option<String>, is_one: bool) -> String {
    let judged = headline.judged;
    let word = judged.word();
    let pad = " ".repeat((VERDICT + 1).saturating_sub(word.chars().count()));
    let first = coloured(judged.verdict, word) + &pad;
    let ours = headline.ours.as_ref().map_or_else(String::new, |ours| format!(": {ours}"));
    let beside = rests_on.map_or_else(String::new, |words| format!(": {words}"));
    let indent = VERDICT + 2;
    let says = format!("{}{ours}", headline.says);
    let rests = format!("({}{beside})", judged.claim);
    if is_one {
        return plain(&(first + " "), &format!("{says} {rests}"), indent, COLUMNS) + "\n";
    }
    let says = plain(&(first + " "), &says, indent, COLUMNS);
    format!("{says}\n{}\n", plain(&" ".repeat(indent), &rests, indent, COLUMNS))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_choice_is_named_by_an_option_of_it_and_not_by_a_word_in_a_sentence() {
        let lines = " 53/0/9 for/open/against; side_choice matters most: 8 of 15; holds only if end = any; depends on ties;";
        let named = ["side_choice", "end", "ties"].map(|id| names(lines, id));
        assert_eq!(named, [true; 3]);
        assert_eq!(["choice", "most", "side", "against", "any"].map(|id| names(lines, id)), [false; 5]);
    }
}
