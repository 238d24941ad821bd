//! `replan show`: one claim with its evidence, a choice, or the claims that hold some words.

use super::places::Places;
use super::verdicts::{COLUMNS, coloured, print};
use super::{Failure, Which, list, places::check_stored};
use crate::analysis::history::History;
use crate::analysis::verdict::{ClaimVerdict, CriterionFinding, Verdicts};
use crate::render::prose::{plain, wrapped};
use crate::render::report::across_lines;
use crate::render::tables::in_full;
use base::settings::did_you_mean;
use clap::Args;
use std::path::PathBuf;
use study::Choice;
use study::paper::{Paper, Reply};

/// Shows a claim with its evidence, a choice, or the claims whose names or sentences hold some words.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Show {
    /// A paper's name, a folder that holds a paper.toml, or a stored run
    paper: String,
    /// A claim, a choice or an option of one, or words to search for; lists all claims if absent
    #[arg(value_name = "CLAIM OR WORDS")]
    words: Vec<String>,
    /// Read from this folder instead of the committed places
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

const EXAMPLES: &str = "Examples:
  replan show zhang t1.improved.cost
  replan show zhang bidirectional nodes
  replan show zhang side_choice       what the paper leaves open, and the options";

impl Show {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        let which = Which { paper: self.paper, out: self.out };
        let runs = Places::runs(&which)?;
        let verdicts = History::verdicts(&runs)?;
        check_stored(&runs)?;
        if self.words.is_empty() {
            print(None, &verdicts, &which);
            return Ok(());
        }
        let words = self.words.join(" ");
        let found = if let Some(judged) = verdicts.claim(&words) {
            vec![judged]
        } else {
            let choices = choices(&which);
            let found = holding(&verdicts, &words);
            let is_named = |choice: &Choice| choice.id == words || choice.options.contains_key(&words);
            let named: Vec<&Choice> = choices.iter().filter(|choice| is_named(choice)).collect();
            if named.is_empty() && found.is_empty() {
                return Err(none_holds(&verdicts, &choices, &words, &which));
            }
            for choice in named {
                say!("{}", list::choice_alone(choice));
            }
            found
        };
        match &found[..] {
            [] => {}
            [judged] => {
                let citation = History::read(&runs)?.citation(&verdicts, judged);
                let replies = verdicts.replies_to(&judged.claim).map(Reply::line);
                let cite = citation.map(|citation| format!("cite as: {citation}"));
                let more = replies.chain(cite).map(|line| wrapped("  ", &line, 4, COLUMNS) + "\n");
                say!("{}{}", shown(judged), more.collect::<String>().trim_end());
            }
            several => {
                let lines: String = several.iter().map(|judged| line(judged)).collect();
                let count = several.len();
                say!("{lines}{count} claims hold “{words}”; one in full: {} CLAIM", which.command("show"));
            }
        }
        Ok(())
    }
}

/// The claims whose id, place or sentence holds every one of `words`, in any case.
fn holding<'v>(verdicts: &'v Verdicts, words: &str) -> Vec<&'v ClaimVerdict> {
    let words = words.to_lowercase();
    let holds = |judged: &&ClaimVerdict| {
        let text = searched(judged);
        words.split_whitespace().all(|word| text.contains(word))
    };
    verdicts.claims.iter().filter(holds).collect()
}

/// The id, the place and the sentences of a claim, in small letters.
fn searched(judged: &ClaimVerdict) -> String {
    let own = [Some(&judged.claim), Some(&judged.at)];
    let sentences = [&judged.says, &judged.short, &judged.quote].map(Option::as_ref);
    let texts = own.into_iter().chain(sentences).flatten();
    texts.map(|text| text.to_lowercase()).collect::<Vec<_>>().join(" ")
}

/// What the paper leaves open; nothing if the paper cannot be read.
fn choices(which: &Which) -> Vec<Choice> {
    let places = Places::stored(which).ok();
    let paper = places.and_then(|places| Paper::load(&places.folder, &places.inputs).ok());
    paper.map_or_else(Vec::new, |paper| paper.choices)
}

/// That nothing has or holds `words`, with the nearest id, or else the nearest word for the first that no claim holds.
fn none_holds(verdicts: &Verdicts, choices: &[Choice], words: &str, which: &Which) -> Failure {
    let claims = verdicts.claims.iter().map(|judged| &judged.claim);
    let ids = claims.chain(choices.iter().map(|choice| &choice.id)).map(String::as_str);
    let mut hint = did_you_mean(words, ids);
    if hint.is_empty() {
        let texts: Vec<String> = verdicts.claims.iter().map(searched).collect();
        let known = || texts.iter().flat_map(|text| text.split(|c: char| !c.is_alphanumeric()));
        let is_unknown = |word: &&str| !texts.iter().any(|text| text.contains(&word.to_lowercase()));
        let hints = words.split_whitespace().filter(is_unknown).map(|word| did_you_mean(word, known()));
        hint = hints.into_iter().find(|hint| !hint.is_empty()).unwrap_or_default();
    }
    Failure::input(format!(
        "no claim and no choice is called `{words}`, and no claim holds it{hint}; `{}` lists all {} claims",
        which.command("show"),
        verdicts.claims.len()
    ))
}

/// A claim with its verdict, and what the paper says.
fn line(judged: &ClaimVerdict) -> String {
    let verdict = coloured(judged.verdict, &judged.verdict_text());
    let says = judged.says.as_ref().or(judged.quote.as_ref());
    let says = says.map_or_else(|| judged.at.clone(), |says| format!("{}: {says}", judged.at));
    format!("{}  {verdict}\n{}\n", judged.claim, plain("  ", &says, 4, COLUMNS))
}

/// Everything that is known of a claim.
fn shown(judged: &ClaimVerdict) -> String {
    let mut text = wrapped("", &format!("{}: {}", judged.claim, judged.verdict_text()), 2, COLUMNS) + "\n";
    for (what, about) in [
        ("at", Some(judged.at.clone())),
        ("says", judged.says.clone()),
        ("quote", judged.quote.as_ref().map(|quote| format!("“{quote}”"))),
        ("printed", judged.printed_text()),
        ("interpretations", judged.rests_on()),
        // The line of the interpretations begins with the same.
        ("under the defaults", judged.across.is_none().then(|| judged.outcome.name().to_owned())),
        ("second seed", judged.second.map(|outcome| outcome.name().to_owned())),
        ("part of", judged.part_of.clone()),
        ("must hold", judged.theorem.clone()),
        ("changed after a run", judged.changed()),
    ] {
        text += &about
            .map_or_else(String::new, |about| wrapped("  ", &format!("{what}: {about}"), 4, COLUMNS) + "\n");
    }
    text.extend(across_lines(judged).map(|line| wrapped("  ", &line, 4, COLUMNS) + "\n"));
    text + &judged.findings.iter().map(found).collect::<String>()
}

fn found(finding: &CriterionFinding) -> String {
    let outcome = finding.outcome.map_or_else(String::new, |outcome| format!(": {}", outcome.name()));
    let mut lines = vec![format!("{}{outcome}", finding.criterion)];
    if let Some(ours) = &finding.ours {
        lines.push(format!("ours: {}", in_full(ours)));
    }
    lines.extend(finding.because.iter().cloned());
    lines.extend(finding.settles.iter().map(|settles| format!("what would settle it: {settles}")));
    lines.extend(finding.premises.iter().map(|premise| format!("premise: {premise}")));
    lines.extend(finding.trial.iter().map(|trial| format!("trial: {trial}")));
    let line = |(at, line): (usize, &String)| {
        let (first, indent) = if at == 0 { ("\n  ", 4) } else { ("    ", 6) };
        wrapped(first, line, indent, COLUMNS) + "\n"
    };
    lines.iter().enumerate().map(line).collect()
}
