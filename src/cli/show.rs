//! `replan show`: one claim with its evidence.

use super::places::Places;
use super::verdicts::{COLUMNS, print};
use super::{Failure, Which, export::check_stored};
use crate::analysis::history::History;
use crate::analysis::verdict::{ClaimVerdict, CriterionFinding};
use crate::render::prose::wrapped;
use crate::render::report::across_lines;
use crate::render::tables::short;
use base::settings::none_called;
use clap::Args;
use std::path::PathBuf;
use study::paper::Reply;

/// Shows what was found about a claim.
///
/// Example: replan show zhang t1.improved.cost
#[derive(Args)]
pub struct Show {
    /// A paper's name, or a folder that holds a paper.toml
    paper: String,
    /// The claim; lists all claims if absent
    claim: Option<String>,
    /// Read from this folder instead of the committed places
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

impl Show {
    /// Runs the command.
    pub fn run(self) -> Result<(), Failure> {
        let places = Places::find(&Which { paper: self.paper, out: self.out }, "")?;
        let verdicts = History::verdicts(&places.runs)?;
        check_stored(&places.runs)?;
        let Some(id) = self.claim else {
            print(&verdicts);
            return Ok(());
        };
        let claims = || verdicts.claims.iter().map(|judged| judged.claim.as_str());
        let judged =
            verdicts.claim(&id).ok_or_else(|| Failure::input(none_called("claim", &id, claims())))?;
        let citation = History::read(&places.runs)?.citation(&verdicts, judged);
        let replies = verdicts.replies_to(&id).map(Reply::line);
        let cite = citation.map(|citation| format!("cite as: {citation}"));
        let more = replies.chain(cite).map(|line| wrapped("  ", &line, 4, COLUMNS) + "\n");
        say!("{}{}", shown(judged), more.collect::<String>().trim_end());
        Ok(())
    }
}

/// Everything that is known of a claim.
fn shown(judged: &ClaimVerdict) -> String {
    let mut text = wrapped("", &format!("{}: {}", judged.claim, judged.verdict_said()), 2, COLUMNS) + "\n";
    let unit = judged.unit.as_ref().map_or_else(String::new, |unit| format!(" {unit}"));
    let printed = judged.printed.as_ref().map(|printed| format!("{printed}{unit}"));
    for (what, said) in [
        ("at", Some(judged.at.clone())),
        ("says", judged.says.clone()),
        ("quote", judged.quote.as_ref().map(|quote| format!("“{quote}”"))),
        ("printed", printed),
        ("interpretations", judged.said.clone()),
        ("under the defaults", Some(judged.outcome.name().to_owned())),
        ("second seed", judged.second.map(|outcome| outcome.name().to_owned())),
        ("part of", judged.part_of.clone()),
        ("must hold", judged.theorem.clone()),
        ("changed after a run", judged.changed()),
    ] {
        text += &said
            .map_or_else(String::new, |said| wrapped("  ", &format!("{what}: {said}"), 4, COLUMNS) + "\n");
    }
    text.extend(across_lines(judged).map(|line| wrapped("  ", &line, 4, COLUMNS) + "\n"));
    text + &judged.findings.iter().map(found).collect::<String>()
}

fn found(finding: &CriterionFinding) -> String {
    let outcome = finding.outcome.map_or_else(String::new, |outcome| format!(": {}", outcome.name()));
    let mut lines = vec![format!("{}{outcome}", finding.criterion)];
    if let Some(ours) = &finding.ours {
        let solved =
            ours.solved.map_or_else(String::new, |[solved, all]| format!(", {solved} of {all} solved"));
        lines.push(format!("ours: {} ({}; n = {}{solved})", short(ours), ours.what, ours.n));
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
