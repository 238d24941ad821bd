//! A paper's chapter: what was found, its tables beside ours, figures, and claims that lead to their evidence.

use super::replies::replies;
use super::{
    SECTIONS, Undrawn, anchor, begin_of_row, is_in_chapter, item, link, linked, paragraph, place,
    with_caption,
};
use crate::analysis::across::tested::AGAINST;
use crate::analysis::evidence::{Evidence, Run};
use crate::analysis::verdict::{ClaimVerdict, Verdicts};
use crate::analysis::verdict_rule::Column;
use crate::render::figure::caption;
use crate::render::headline::{Headline, evidence, headlines};
use crate::render::prose::{COLUMNS, capital, markdown, prose, wrapped};
use crate::render::tables;
use crate::render::{RenderError, results, state};
use std::collections::BTreeSet;
use study::paper::{FIGURES, Paper, PrintedTable};
use study::spec::FigureSpec;

/// A chapter, and what opens the report.
#[derive(Debug)]
pub struct Chapter {
    /// The chapter.
    pub text: String,
    /// The finding and the headline claims.
    pub found: String,
    /// The paper's row of the table of counts.
    pub row: String,
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
    /// Files there that the report links to: an independent judge's report on robots, scenes and paths.
    pub beside: Vec<&'static str>,
}

/// The chapter of a paper whose stored run cannot be read, for the reason `why`.
pub fn unread(paper: &Paper, why: &str) -> Chapter {
    let why = format!("**Nothing is shown: {}.**", markdown(why));
    let mut text = heading(paper);
    text.insert_str(text.find('\n').unwrap_or(0) + 1, &format!("\n{why}\n"));
    let blank = " – |".repeat(Column::ALL.len());
    Chapter {
        text,
        found: begin_of_found(paper) + &why + "\n",
        row: format!("{}{blank}", begin_of_row(&paper.id)),
    }
}

/// How what was found in `paper` begins in the report: with a link to its chapter.
fn begin_of_found(paper: &Paper) -> String {
    format!("### [{}](#{})\n\n", markdown(&paper.id), anchor(&paper.id))
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
        let state = state(self.evidence, self.verdicts);
        let mut text = heading(paper);
        let notes: Vec<String> = state.iter().map(|note| format!("\n**{}**\n", markdown(note))).collect();
        text.insert_str(text.find('\n').unwrap_or(0) + 1, &notes.concat());
        // Findings were written on the study's own run; of any other they may be false.
        let findings = if state.is_empty() { self.findings() } else { Vec::new() };
        if let Some((first, others)) = findings.split_first() {
            text += &(wrapped("", first, 0, COLUMNS) + "\n\n");
            text.extend(others.iter().map(|finding| item(0, finding)));
            text += if others.is_empty() { "" } else { "\n" };
        }
        self.headlines(&mut text);
        text += &replies(self.verdicts, &self.details_file());
        self.tables(&mut text)?;
        self.figures(&mut text);
        self.claims(&mut text);
        let counts: Vec<String> = self.verdicts.tally().iter().map(|count| format!(" {count} |")).collect();
        let row = begin_of_row(&paper.id) + &counts.concat();
        Ok(Chapter { text, found: self.found(state.first(), findings.first()), row })
    }

    /// What was found, a sentence or two each: the finding first.
    fn findings(&self) -> Vec<String> {
        let report = &self.evidence.paper.report;
        let texts = report.finding.iter().chain(&report.findings);
        let found = |text: &String| linked(&prose(text, self.verdicts), self.verdicts, &self.details_file());
        texts.map(found).collect()
    }

    /// What opens the report: the finding, and the headline claims in a few words.
    fn found(&self, state: Option<&String>, finding: Option<&String>) -> String {
        let paper = self.evidence.paper;
        let mut text = begin_of_found(paper);
        let first = state.map(|state| format!("**{}**", markdown(state))).or_else(|| finding.cloned());
        text.extend(first.map(|first| wrapped("", &first, 0, COLUMNS) + "\n\n"));
        for headline in headlines(paper, self.verdicts) {
            let ours = headline.ours.as_ref().map_or_else(String::new, |ours| format!(": {ours}"));
            let verdict = capital(&headline.verdict(self.verdicts));
            text += &item(0, &format!("{}. **{}**", markdown(&(headline.says + &ours)), markdown(&verdict)));
        }
        text + "\n" + &paragraph(&evidence(paper, self.verdicts))
    }

    /// The headline claims, a line each: where the paper says it, ours, and the verdict.
    fn headlines(&self, text: &mut String) {
        *text += "| claim | at | ours | verdict |\n|---|---|---|---|\n";
        let details = self.details_file();
        for headline in headlines(self.evidence.paper, self.verdicts) {
            let verdict = headline.verdict_in_full(self.verdicts);
            let Headline { judged, says, ours, .. } = headline;
            let says = link(judged, &markdown(&says), &details);
            let ours = ours.map_or_else(|| "–".to_owned(), |ours| markdown(&ours));
            *text += &format!("| {says} | {} | {ours} | {} |\n", markdown(&judged.at), markdown(&verdict));
        }
        *text += &format!("\n{}", paragraph(&evidence(self.evidence.paper, self.verdicts)));
        for judged in self.verdicts.headlines(self.evidence.paper) {
            let mut against = judged.by_option(AGAINST).peekable();
            if against.peek().is_some() {
                let test = link(judged, &format!("`{}`", judged.claim), &details);
                let about = format!(
                    "Options that {test} refuses, each under the interpretation where its p is greatest, with the printed number \
                     that is farthest from ours there:"
                );
                *text += &(wrapped("", &about, 0, COLUMNS) + "\n\n");
                text.extend(against.map(|line| item(0, &markdown(line))));
                text.push('\n');
            }
        }
    }

    /// The paper's tables that hold claims, and those of our results that the chapter shows.
    fn tables(&self, text: &mut String) -> Result<(), RenderError> {
        let paper = self.evidence.paper;
        let details = self.details_file();
        let verdict = |judged: &ClaimVerdict| link(judged, &judged.verdict_text(), &details);
        for table in paper.tables.iter().filter(|table| is_in_chapter(paper, table)) {
            *text += &with_caption(table, &tables::markdown(self.evidence, table, self.verdicts, verdict)?);
        }
        let further =
            |table: &&PrintedTable| paper.report.in_details.iter().any(|id| *id.get_ref() == table.id);
        let further: Vec<&str> =
            paper.tables.iter().filter(further).map(|table| table.caption.as_str()).collect();
        if !further.is_empty() {
            let captions = markdown(&further.join(". "));
            let line = format!("[In the details]({details}#figures) stand: {captions}.");
            *text += &(wrapped("", &line, 0, COLUMNS) + "\n\n");
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

    /// How many claims have each verdict, and where the evidence stands.
    fn claims(&self, text: &mut String) {
        let details = self.details_file();
        let all = self.verdicts.claims.len();
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
            .map(|counted| format!("{counted}."))
            .collect::<Vec<_>>()
            .join(" ")
    }
}
