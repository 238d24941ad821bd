//! The details of a chapter: the evidence on each claim under an anchor, what holds together, interpretations, the inventory, studies. What two
//! claims have in common stands once.

use super::chapter::Page;
use super::interpretations::across_lines;
use super::{SECTIONS, anchor, is_in_chapter, item, link, linked, links, paragraph, place, with_caption};
use crate::analysis::citation::version_in;
use crate::analysis::verdict::{ClaimVerdict, CriterionFinding, POWER, Together, Verdicts};
use crate::render::prose::{COLUMNS, markdown, wrapped};
use crate::render::results;
use crate::render::tables::{self, short};
use std::collections::{BTreeMap, BTreeSet};
use study::paper::{InventoryRow, Paper, cells_named};
use study::record::Status;
use study::recorded_mark;

/// How many sets of claims that hold together are listed with those that fail.
const LISTED_SETS: usize = 5;
/// What is shorter than this is repeated where it holds again.
const SHORT: usize = 60;

impl Page<'_> {
    /// The details; `back` leads to the report from where they lie.
    pub fn details(&self, back: &str) -> String {
        let paper = self.evidence.paper;
        let verdicts = self.verdicts;
        let id = markdown(&paper.id);
        let mut text = format!("# {id}: evidence and details\n\n[The chapter]({back}#{})", anchor(&paper.id));
        for (name, to) in SECTIONS {
            text += &format!(" · [{name}](#{to})");
        }
        text += "\n\n";
        text += &paragraph(&format!("Made by `{}`.", verdicts.command));
        text.extend(paper.source.notes.iter().map(|note| item(0, &markdown(note))));
        section(&mut text, 0);
        let mut known = BTreeMap::new();
        text.extend(verdicts.claims.iter().map(|judged| evidence(judged, paper, verdicts, &mut known)));
        section(&mut text, 1);
        self.together(&mut text);
        section(&mut text, 2);
        self.interpretations(&mut text);
        section(&mut text, 3);
        self.changes(&mut text);
        section(&mut text, 4);
        self.shown_besides(&mut text);
        section(&mut text, 5);
        text.extend(paper.inventory.iter().map(|row| self.inventory(row)));
        section(&mut text, 6);
        self.studies(&mut text);
        text.trim_end().to_owned() + "\n"
    }

    fn together(&self, text: &mut String) {
        let sets = &self.verdicts.together;
        if sets.is_empty() {
            *text += "No group of claims was searched for.\n";
            return;
        }
        *text += &paragraph(&format!(
            "Claims met exactly under one interpretation by one choice of contenders, each environment on one map of ours. Every such \
             choice of maps was looked at. Of the {} sets that lie within no other the {} largest are listed, and the largest of each \
             further interpretation; all stand in `verdicts.toml` beside the stored run.",
            sets.len(),
            sets.len().min(LISTED_SETS)
        ));
        let (first, rest) = sets.split_at(LISTED_SETS.min(sets.len()));
        let mut seen: BTreeSet<&str> = first.iter().map(|set| set.interpretation.as_str()).collect();
        let further = rest.iter().filter(|set| seen.insert(&set.interpretation));
        let all = first.iter().map(|set| (set, true)).chain(further.map(|set| (set, false)));
        for (set, with_fail) in all {
            *text += &together(set, with_fail);
        }
    }

    /// Claims that were changed after their data had been seen, and why.
    fn changes(&self, text: &mut String) {
        let mut claims: BTreeMap<String, Vec<&str>> = BTreeMap::new();
        for judged in &self.verdicts.claims {
            if let Some(why) = judged.changed() {
                claims.entry(why).or_default().push(&judged.claim);
            }
        }
        let withdrawn = &self.verdicts.withdrawn;
        if claims.is_empty() && withdrawn.is_empty() && self.verdicts.history.is_some() {
            *text += "No claim was changed after its data had been seen.\n";
        }
        text.extend(
            withdrawn
                .iter()
                .map(|claim| item(0, &format!("{claim}: withdrawn after its data had been seen."))),
        );
        for (why, claims) in claims {
            *text += &item(0, &format!("{}: {}.", links(&claims), markdown(&why)));
        }
        for withdrawn in &self.evidence.paper.withdrawn {
            let ids: Vec<String> = withdrawn.claims.iter().map(|id| format!("`{}`", id.get_ref())).collect();
            *text += &item(0, &format!("Withdrawn, {}: {}.", ids.join(", "), markdown(&withdrawn.why)));
        }
    }

    /// Figures and tables that the chapter does not show.
    fn shown_besides(&self, text: &mut String) {
        let paper = self.evidence.paper;
        for figure in self.further() {
            *text += &self.figure(figure, "");
        }
        for table in paper.tables.iter().filter(|table| !is_in_chapter(paper, table)) {
            let verdict = |judged: &ClaimVerdict| link(judged, &judged.verdict_text(), "");
            let shown = tables::markdown(self.evidence, table, self.verdicts, verdict);
            *text += &with_caption(table, &shown.unwrap_or_else(|error| paragraph(&error.to_string())));
        }
        let is_shown = |id: &String| paper.report.tables.iter().any(|shown| shown.get_ref() == id);
        for table in paper.results.iter().filter(|table| !is_shown(table.id.get_ref())) {
            let shown = results::markdown(self.evidence, table);
            *text += &shown.unwrap_or_else(|error| paragraph(&error.to_string()));
            *text += "\n";
        }
        *text += "Every number as a macro of LaTeX: [numbers.tex](numbers.tex).";
        let tables: Vec<String> = paper.table_ids().map(|id| format!("[{id}.tex]({id}.tex)")).collect();
        if !tables.is_empty() {
            *text += &format!(" Tables in LaTeX: {}.", tables.join(",\n"));
        }
        *text += "\n";
    }

    fn inventory(&self, row: &InventoryRow) -> String {
        let paper = self.evidence.paper;
        let names = |ids: &[base::settings::Spanned<String>]| {
            let named = ids.iter().flat_map(|id| cells_named(id.get_ref(), &paper.cells));
            named.map(str::to_owned).collect::<Vec<String>>()
        };
        let mut answers = Vec::new();
        // Those that answer a number stand beside it.
        let numbered: Vec<Vec<(String, Option<String>)>> =
            row.numbers.iter().map(|numbers| paper.numbers(numbers)).collect();
        let with_number: BTreeSet<&String> =
            numbered.iter().flatten().filter_map(|(_, claim)| claim.as_ref()).collect();
        let claims: Vec<String> =
            names(&row.claims).into_iter().filter(|claim| !with_number.contains(claim)).collect();
        if !claims.is_empty() {
            answers.push(links(&claims));
        }
        answers.extend(names(&row.figures).iter().map(|id| self.file(id)));
        answers.extend(names(&row.studies).iter().map(|study| format!("study `{study}`")));
        answers.extend(row.none.iter().map(|none| format!("nothing: {}", markdown(none))));
        let answers = if answers.is_empty() { String::new() } else { format!(" → {}", answers.join(", ")) };
        let mut text =
            item(0, &format!("**{}**: {}{answers}", markdown(row.item.get_ref()), markdown(&row.says)));
        for (numbers, all) in row.numbers.iter().zip(&numbered) {
            let is_joint = !numbers.printed.is_empty() || all.len() == 1;
            let number = |(printed, claim): &(String, Option<String>)| {
                let own = claim.as_ref().filter(|_| !is_joint).map(|claim| links(&[claim]));
                markdown(printed) + &own.map_or_else(String::new, |own| format!(" {own}"))
            };
            let inputs = numbers.inputs.as_ref().map(|inputs| format!("{} numbers", inputs.get_ref()));
            let listed: Vec<String> = all.iter().map(number).chain(inputs).collect();
            let answer = all.first().and_then(|(_, claim)| claim.as_ref()).filter(|_| is_joint);
            let why = match (&numbers.none, answer) {
                (Some(none), _) => format!(": {}", markdown(none)),
                (None, Some(claim)) => format!(": {}", links(&[claim])),
                (None, None) => String::new(),
            };
            text += &item(1, &format!("{}{why}", listed.join(", ")));
        }
        text
    }

    /// A figure or table of ours, as a link to its file.
    fn file(&self, id: &str) -> String {
        let is_figure = self.evidence.paper.figure_ids().any(|figure| figure == id);
        if self.undrawn.iter().any(|undrawn| undrawn.id == id) {
            return format!("{id} (not drawn)");
        }
        format!("[{id}]({id}.{})", if is_figure { "png" } else { "tex" })
    }

    fn studies(&self, text: &mut String) {
        for run in self.evidence.runs() {
            let study = run.study;
            let trials = run.records.batch.rows.len();
            let seed = run.manifest.seed;
            let spec = &study.spec_hash()[..12];
            let mark = recorded_mark(study.clock_bound());
            let about = format!(
                "**`{}`**: {} {trials} trials, seed {seed}, spec `{spec}`.{}",
                study.name,
                markdown(&study.question),
                mark.map_or_else(String::new, |mark| format!(" {}", markdown(&mark)))
            );
            *text += &item(0, &about);
            for group in &study.groups {
                let counted = study.labels().into_iter().map(|label| {
                    let rows = run.rows(&group.label, &label);
                    let of = |status: &Status| rows.iter().filter(|row| row.status == *status).count();
                    let counts =
                        Status::ALL.iter().map(|status| (of(status), status)).filter(|(count, _)| *count > 0);
                    let counts: Vec<String> =
                        counts.map(|(count, status)| format!("{count} {status}")).collect();
                    (markdown(&label), counts.join(", "))
                });
                let counted: Vec<(String, String)> =
                    counted.filter(|(_, counts)| !counts.is_empty()).collect();
                *text += &item(1, &format!("{}: {}", markdown(&group.label), alike(&counted)));
            }
        }
    }
}

/// Contenders with their counts, those with equal counts together.
fn alike(counted: &[(String, String)]) -> String {
    let mut groups: Vec<(&str, Vec<&str>)> = Vec::new();
    for (contender, counts) in counted {
        match groups.iter_mut().find(|(known, _)| known == counts) {
            Some((_, contenders)) => contenders.push(contender),
            None => groups.push((counts, vec![contender])),
        }
    }
    let each = |(counts, names): &(&str, Vec<&str>)| {
        if names.len() > 1 {
            format!("{counts} each of {}", names.join(", "))
        } else {
            format!("{counts} of {}", names[0])
        }
    };
    if groups.is_empty() {
        "no trials under this interpretation".to_owned()
    } else {
        groups.iter().map(each).collect::<Vec<_>>().join("; ")
    }
}

fn section(text: &mut String, at: usize) {
    let (name, to) = SECTIONS[at];
    *text += &format!("\n## {name} {}\n\n", place(to));
}

fn together(set: &Together, with_fail: bool) -> String {
    let about =
        format!("{} ({}: {}; {})", set.interpretation.replace(',', ", "), set.study, set.problem, set.under);
    let mut text = item(0, &markdown(&about)) + &item(1, &format!("hold: {}", links(&set.hold)));
    if with_fail && !set.fail.is_empty() {
        text += &item(1, &format!("fail: {}", links(&set.fail)));
    }
    text
}

/// What was found about one claim; `known` has the claims that stated something first.
fn evidence<'a>(
    judged: &'a ClaimVerdict,
    paper: &Paper,
    verdicts: &Verdicts,
    known: &mut BTreeMap<String, &'a str>,
) -> String {
    let mut text = format!("{}\n", place(&judged.claim));
    let interpretations =
        judged.beside_with_seed().map_or_else(String::new, |words| format!(", {}", markdown(&words)));
    let mut about = format!("**`{}`: {}{interpretations}**. ", judged.claim, judged.verdict_text());
    about += &markdown(&format!("{}: {}", judged.at, judged.statement()));
    if let Some(whole) = &judged.part_of {
        about += &format!(". A part of {}", links(&[whole]));
    }
    if judged.changed().is_some() {
        about += ". [Changed after a run](#changes)";
    }
    let version = version_in(paper, verdicts, judged);
    about += &version.map_or_else(String::new, |version| format!(". Version `{version}`"));
    text += &(wrapped("", &about, 0, COLUMNS) + ".\n\n");
    text.extend(verdicts.replies_to(&judged.claim).map(|reply| item(0, &markdown(&reply.line()))));
    let theorem = judged.theorem.iter().map(|theorem| format!("it must hold: {}", markdown(theorem)));
    let findings =
        judged.findings.iter().flat_map(|finding| finding_lines(finding, verdicts, known, &judged.claim));
    let across = across_lines(judged).map(|line| (0, markdown(&line)));
    let lines: Vec<(usize, String)> = theorem.map(|line| (0, line)).chain(across).chain(findings).collect();
    text.extend(lines.iter().map(|(depth, line)| item(*depth, line)));
    text + "\n"
}

/// What one criterion found, as items of a list with their depths.
fn finding_lines<'a>(
    finding: &'a CriterionFinding,
    verdicts: &Verdicts,
    known: &mut BTreeMap<String, &'a str>,
    claim: &'a str,
) -> Vec<(usize, String)> {
    let mut head = format!("`{}`", finding.criterion);
    if let Some(outcome) = finding.outcome {
        head += &format!(": *{}*", outcome.name());
    }
    if let Some(ours) = &finding.ours {
        let solved =
            ours.solved.map_or_else(String::new, |[solved, all]| format!(", {solved} of {all} solved"));
        head += &format!("; ours {} ({}; n = {}{solved})", short(ours), markdown(&ours.what), ours.n);
    }
    let mut lines = vec![(0, head)];
    let because = finding.because.iter().map(String::clone);
    let settles = finding.settles.iter().map(|settles| format!("what would settle it: {settles}"));
    let premises =
        (!finding.premises.is_empty()).then(|| format!("premises: {}", finding.premises.join("; ")));
    for line in because.chain(settles).chain(premises) {
        let first = *known.entry(line.clone()).or_insert(claim);
        let is_known = first != claim && line.len() > SHORT && !line.starts_with(POWER);
        let line = if is_known {
            format!("the same as for {}: see there", links(&[first]))
        } else {
            linked(&line, verdicts, "")
        };
        if !lines.contains(&(1, line.clone())) {
            lines.push((1, line));
        }
    }
    if let Some(trial) = &finding.trial {
        lines.push((1, format!("trial `{trial}`")));
    }
    lines
}
