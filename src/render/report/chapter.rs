//! A paper's chapter: what was found, its tables beside ours, figures, and claims that lead to their evidence.

use super::{SECTIONS, Undrawn, begin_of_line, item, link, linked, paper_statement, paragraph, place};
use crate::analysis::evidence::{Evidence, Run};
use crate::analysis::verdict::{ClaimVerdict, Verdicts};
use crate::analysis::verdict_rule::Column;
use crate::render::figure::caption;
use crate::render::prose::{COLUMNS, markdown, prose, wrapped};
use crate::render::tables::{self, short};
use crate::render::{RenderError, results, state};
use std::collections::BTreeSet;
use study::paper::{CLAIMS, FIGURES, Paper};
use study::spec::FigureSpec;

/// A chapter and the paper's line of the overview.
#[derive(Debug)]
pub struct Chapter {
    /// The chapter.
    pub text: String,
    /// The line.
    pub line: String,
}

/// What a chapter and its details are made of.
pub struct Page<'a> {
    /// The records.
    pub evidence: &'a Evidence<'a>,
    /// What was found.
    pub verdicts: &'a Verdicts,
    /// The folder of the paper's figures, as seen from the report.
    pub plots: String,
    /// Figures that are missing there.
    pub undrawn: &'a [Undrawn],
    /// Files there of which the report speaks: what an independent judge said of robots, scenes and paths.
    pub beside: Vec<&'static str>,
}

/// The chapter of a paper whose stored run cannot be read, for the reason `why`.
pub fn unread(paper: &Paper, why: &str) -> Chapter {
    let why = format!("**Nothing is shown: {}.**", markdown(why));
    let mut text = heading(paper);
    text.insert_str(text.find('\n').unwrap_or(0) + 1, &format!("\n{why}\n"));
    let blank = " – |".repeat(Column::ALL.len() + 1);
    Chapter { text, line: format!("{}{blank} {why} |", begin_of_line(&paper.id)) }
}

fn heading(paper: &Paper) -> String {
    let source = &paper.source;
    let mut text = format!("## {} {}\n\n", markdown(&paper.id), place(&paper.id));
    let about: Vec<&str> = [Some(&source.title), source.authors.as_ref(), source.published.as_ref()]
        .into_iter()
        .flatten()
        .map(String::as_str)
        .collect();
    text += &paragraph(&about.join(". "));
    text
}

impl Page<'_> {
    /// The chapter.
    ///
    /// # Errors
    /// A table for which something is not stored.
    pub fn chapter(&self) -> Result<Chapter, RenderError> {
        let paper = self.evidence.paper;
        let verdicts = self.verdicts;
        let state = state(self.evidence, verdicts);
        let mut text = heading(paper);
        if !state.is_empty() {
            let state = state.iter().map(|said| format!("\n**{}**\n", markdown(said)));
            let state = state.collect::<Vec<_>>().concat();
            text.insert_str(text.find('\n').unwrap_or(0) + 1, &state);
        }
        // Findings were written on the study's own run; of any other they may be false.
        let found = |text: &String| linked(&prose(text, verdicts), verdicts, &self.details_file());
        if state.is_empty() {
            text.extend(paper.report.findings.iter().map(|finding| item(0, &found(finding))));
            text += "\n";
        }
        self.tables(&mut text)?;
        self.figures(&mut text);
        self.claims(&mut text);
        let finding = match (&state[..], &paper.report.finding) {
            ([first, ..], _) => format!("**{}**", markdown(first)),
            ([], finding) => finding.as_ref().map_or_else(String::new, found),
        };
        let counts: Vec<String> = verdicts.tally().into_iter().map(|count| format!(" {count} |")).collect();
        let line = format!("{}{} {finding} |", begin_of_line(&paper.id), counts.concat());
        Ok(Chapter { text, line })
    }

    /// The paper's tables that hold claims, and those of our results that the chapter shows.
    fn tables(&self, text: &mut String) -> Result<(), RenderError> {
        let paper = self.evidence.paper;
        let details = self.details_file();
        let verdict = |judged: &ClaimVerdict| link(judged, &judged.verdict_said(), &details);
        for table in paper.tables.iter().filter(|table| table.has_claims() && !table.compares) {
            *text += &paragraph(&table.caption);
            *text += &tables::markdown(self.evidence, table, self.verdicts, verdict)?;
            *text += "\n";
            if !table.notes.is_empty() {
                *text += &paragraph(&table.notes.join(" "));
            }
        }
        for table in paper.report.tables.iter().filter_map(|id| paper.results_called(id.get_ref())) {
            *text += &results::markdown(self.evidence, table)?;
            *text += "\n";
        }
        Ok(())
    }

    fn figures(&self, text: &mut String) {
        for figure in self.shown() {
            *text += &self.figure(figure, &format!("{}/", self.plots));
        }
    }

    /// The figures of the chapter.
    fn shown(&self) -> Vec<&FigureSpec> {
        let paper = self.evidence.paper;
        let all = || self.evidence.paper.figures();
        match &paper.report.figures {
            Some(ids) => ids.iter().filter_map(|id| all().find(|figure| figure.id == *id)).collect(),
            None => all().take(FIGURES).collect(),
        }
    }

    /// The figures that the chapter leaves to the details.
    pub(super) fn further(&self) -> Vec<&FigureSpec> {
        let shown: BTreeSet<&str> = self.shown().iter().map(|figure| figure.id.get_ref().as_str()).collect();
        self.evidence.paper.figures().filter(|figure| !shown.contains(figure.id.get_ref().as_str())).collect()
    }

    /// A figure that lies in `folder`, with its caption.
    pub(super) fn figure(&self, figure: &FigureSpec, folder: &str) -> String {
        let id = figure.id.get_ref();
        let of = |run: &&Run<'_>| run.study.figures.iter().any(|own| own.id == figure.id);
        let own = self.evidence.runs().find(of);
        let caption = own.map_or_else(
            || figure.caption.clone(),
            |run| caption(figure, run, self.evidence.paper, self.verdicts),
        );
        let caption = if caption.starts_with("Fig. ") { caption } else { format!("{id}: {caption}") };
        let image = match self.undrawn.iter().find(|undrawn| undrawn.id == *id) {
            Some(undrawn) => format!("**{id} could not be drawn: {}.**\n\n", markdown(&undrawn.why)),
            None => format!("![{id}]({folder}{id}.png)\n\n"),
        };
        image + &paragraph(&caption)
    }

    fn details_file(&self) -> String {
        format!("{}/details.md", self.plots)
    }

    fn claims(&self, text: &mut String) {
        let paper = self.evidence.paper;
        let verdicts = self.verdicts;
        let mut shown: Vec<&ClaimVerdict> = verdicts.headlines(paper).collect();
        if shown.is_empty() {
            shown.extend(verdicts.claims.iter().filter(|judged| judged.is_counted()).take(CLAIMS));
        }
        *text += "| claim | in the paper | ours | verdict |\n|---|---|---|---|\n";
        let details = self.details_file();
        for judged in &shown {
            let ours = judged.ours().map_or_else(
                || "–".to_owned(),
                |ours| format!("{} ({}; n = {})", short(ours), markdown(&ours.what), ours.n),
            );
            let interpretations = judged.beside_if_other();
            let interpretations =
                interpretations.map_or_else(String::new, |words| format!(" ({})", markdown(&words)));
            let claim = link(judged, &format!("`{}`", judged.claim), &details);
            let said = markdown(&format!("{}: {}", judged.at, paper_statement(judged)));
            let verdict = judged.verdict_said();
            *text += &format!("| {claim} | {said} | {ours} | {verdict}{interpretations} |\n");
        }
        let all = verdicts.claims.len();
        let mut more = format!("{} More: [evidence of all {all} claims]({details})", self.counts());
        for (name, to) in SECTIONS.iter().skip(1) {
            more += &format!(", [{}]({details}#{to})", name.to_lowercase());
        }
        for file in &self.beside {
            more += &format!(", [{}]({}/{file})", file.trim_end_matches(".md"), self.plots);
        }
        *text += &format!("\n{}.\n", wrapped("", &more, 0, COLUMNS));
    }

    fn counts(&self) -> String {
        let counts = self.verdicts.counts();
        std::iter::once(counts.verdicts())
            .chain(counts.parts)
            .chain(counts.asserted)
            .map(|said| format!("{said}."))
            .collect::<Vec<_>>()
            .join(" ")
    }
}
