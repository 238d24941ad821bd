//! The text of a page: findings, claims with their evidence, the paper's tables beside ours, and places for drawings.

use super::html::{escaped, prose as inline};
use super::{interpretations, replies};
use crate::analysis::evidence::Evidence;
use crate::analysis::outcome::Outcome;
use crate::analysis::tabulated::{grid, table_caption};
use crate::analysis::tally::Counts;
use crate::analysis::verdict::{ClaimVerdict, CriterionFinding, Effect, Verdicts};
use crate::analysis::verdict_rule::Verdict;
use crate::render::RenderError;
use crate::render::figure::caption;
use crate::render::headline::{Headline, evidence, headlines, ours};
use crate::render::prose::prose;
use crate::render::tables::{Beside, beside, in_full, short};
use study::paper::PrintedTable;

/// What the text is made of.
pub struct Body<'a> {
    /// The records.
    pub evidence: &'a Evidence<'a>,
    /// What was found.
    pub verdicts: &'a Verdicts,
    /// The trials that have a replay.
    pub replayed: &'a [&'a str],
    /// How many interpretations can be looked at.
    pub explored: usize,
    /// Whether the index of all papers lies beside the page.
    pub has_index: bool,
}

/// Where replays are drawn.
const REPLAYS: &str = "<p>Stored trials, step by step; contenders on one problem stand side by side. \
    Arrow keys step, the space bar plays.</p>\n<div id=\"player\"></div>\n";

/// A part of the page that folds.
fn part(id: &str, title: &str, text: &str) -> String {
    format!(
        "<section id=\"{id}\"><details open><summary><h2>{title}</h2></summary>\n{text}</details></section>\n"
    )
}

/// A verdict or an outcome, by its name, as a word on its colour.
fn badge(name: &str, word: &str) -> String {
    format!("<span class=\"class {}\">{}</span>", name.replace(' ', "-"), escaped(word))
}

/// How many sentences and rows have each verdict, in the verdicts' colours.
pub(super) fn coloured(counts: &Counts) -> String {
    let of_each = counts.of_each.iter();
    let badges =
        of_each.map(|(count, verdict)| badge(verdict.name(), &format!("{count} {}", verdict.name())));
    format!("{}: {}", escaped(&counts.whole), badges.collect::<Vec<_>>().join(" "))
}

impl Body<'_> {
    /// The page's text. `state` stands first: what a reader must know of a run that is not the study's own.
    ///
    /// # Errors
    /// A table for which something is not stored.
    pub fn html(&self, state: &[String], is_without_curves: bool) -> Result<String, RenderError> {
        let note = state.iter().map(|note| format!("<p class=\"state\">{}</p>\n", escaped(note)));
        let mut text: String = note.collect();
        text += &self.head(state.is_empty());
        text += &self.navigation(is_without_curves);
        text += &part("claims", "Claims", &self.claims());
        if self.has_tables() {
            text += &part("tables", "The paper's tables beside ours", &self.tables()?);
        }
        if !is_without_curves {
            text += &part("curves", "Curves", "");
        }
        if !self.replayed.is_empty() {
            text += &part("replays", "Replays", REPLAYS);
        }
        if self.has_figures() {
            text += &part("figures", "Figures", &self.figures());
        }
        Ok(text + "</main>\n")
    }

    fn is_claim(&self, id: &str) -> bool {
        self.verdicts.claim(id).is_some()
    }

    /// Text of ours about the paper, with our numbers in it.
    fn prose_html(&self, text: &str) -> String {
        inline(&prose(text, self.verdicts), |id| self.is_claim(id))
    }

    fn head(&self, is_own: bool) -> String {
        let paper = self.evidence.paper;
        let counts = self.verdicts.counts();
        let source = &paper.source;
        let about: Vec<&str> = [source.authors.as_ref(), source.published.as_ref()]
            .into_iter()
            .flatten()
            .map(String::as_str)
            .collect();
        let up =
            if self.has_index { "<p class=\"up\"><a href=\"index.html\">All papers</a></p>\n" } else { "" };
        let mut text = format!("<main><header>{up}<h1>{}</h1>\n", escaped(&source.title));
        text += &format!("<p>{}</p>\n", escaped(&about.join(". ")));
        // Findings were written on the study's own run; of any other they may be false.
        if is_own {
            text.extend(
                paper
                    .report
                    .finding
                    .iter()
                    .map(|sentence| format!("<p><strong>{}</strong></p>\n", self.prose_html(sentence))),
            );
        }
        text += &format!("<p>{}</p>\n", coloured(&counts));
        text +=
            "<details><summary>What these words mean, and what is counted</summary><dl class=\"words\">\n";
        text.extend(counts.of_each.iter().map(|(_, verdict)| {
            let word = badge(verdict.name(), verdict.name());
            format!("<dt>{word}</dt><dd>{}</dd>\n", escaped(verdict.about()))
        }));
        text += "<dt>50/0/9 for/open/against</dt><dd>50 interpretations agree with the claim, 0 cannot tell and 9 contradict it</dd></dl>";
        let beside = counts.parts.into_iter().chain(counts.asserted);
        text.extend(beside.map(|sentence| format!("<p>{}.</p>", escaped(&sentence))));
        text += "</details>\n";
        text += &self.headlines();
        if is_own && !paper.report.findings.is_empty() {
            text += "<details><summary>More findings, with numbers</summary><ul>\n";
            text.extend(
                paper
                    .report
                    .findings
                    .iter()
                    .map(|sentence| format!("<li>{}</li>\n", self.prose_html(sentence))),
            );
            text += "</ul></details>\n";
        }
        text + "</header>\n"
    }

    /// The headline claims, each with its verdict, and with our number where it has one.
    fn headlines(&self) -> String {
        let line = |headline: &Headline<'_>| {
            let ours = headline.ours.as_ref().map_or_else(String::new, |ours| format!(": {ours}"));
            let beside = headline.beside(self.verdicts).map_or_else(String::new, |text| format!("; {text}"));
            format!(
                "<li>{} <a href=\"#claim={}\">{}</a>{}</li>\n",
                badge(headline.judged.word(), &headline.judged.verdict_text()),
                escaped(&headline.judged.claim),
                escaped(&headline.says),
                escaped(&(ours + &beside))
            )
        };
        let lines: String = headlines(self.evidence.paper, self.verdicts).iter().map(line).collect();
        if lines.is_empty() {
            return lines;
        }
        let evidence = evidence(self.evidence.paper, self.verdicts);
        format!("<ul class=\"headlines\">\n{lines}</ul>\n<p>{}</p>\n", self.prose_html(&evidence))
    }

    fn navigation(&self, is_without_curves: bool) -> String {
        let parts = [
            ("claims", "Claims", true),
            ("interpretations", "Choices", !self.evidence.paper.choices.is_empty()),
            ("tables", "Tables", self.has_tables()),
            ("curves", "Curves", !is_without_curves),
            ("replays", "Replays", !self.replayed.is_empty()),
            ("figures", "Figures", self.has_figures()),
        ];
        let link = |(to, name, _): &(&str, &str, bool)| format!("<a href=\"#{to}\">{name}</a>");
        let mut links: Vec<String> = parts.iter().filter(|(.., is_there)| *is_there).map(link).collect();
        if self.has_index {
            links.push("<a href=\"index.html\">All papers</a>".to_owned());
        }
        format!("<nav aria-label=\"parts of this page\">{}</nav>\n", links.join(" "))
    }

    fn claims(&self) -> String {
        let verdicts: String = Verdict::ALL.iter().map(|verdict| option(verdict.name())).collect();
        let outcomes: String = Outcome::ALL.iter().map(|outcome| option(outcome.name())).collect();
        let mut text = format!(
            "<form class=\"filter\" id=\"filter\" role=\"search\">\
             <label>words <input type=\"search\" name=\"words\"></label>\
             <label>verdict <select name=\"class\"><option value=\"\">any</option>{verdicts}</select></label>\
             <label>depends on <select name=\"hangs\"><option value=\"\">anything</option></select></label>\
             <label hidden>under this interpretation <select name=\"under\"><option value=\"\">any</option>\
             <option value=\"differs\">not as under the default</option>{outcomes}</select></label>\
             <label><input type=\"checkbox\" name=\"parts\"> with parts and cells</label>\
             <output></output></form>\n"
        );
        text += &interpretations::section(self.evidence.paper, self.verdicts, self.explored);
        text += "<div class=\"wide\"><table id=\"claimed\"><thead><tr>";
        for (key, name) in [
            ("claim", "claim"),
            ("paper", "the paper"),
            ("ours", "ours"),
            ("class", "verdict"),
            ("interpretations", "interpretations"),
            ("under", "under this interpretation"),
        ] {
            text += &format!(
                "<th scope=\"col\" data-column=\"{key}\" aria-sort=\"none\"><button type=\"button\" data-sort=\"{key}\">{name}</button></th>"
            );
        }
        text += "</tr></thead>\n";
        text.extend(self.verdicts.claims.iter().map(|judged| self.claim(judged)));
        text + "</table></div>\n"
    }

    /// A claim's line, and below it the evidence that opens.
    fn claim(&self, judged: &ClaimVerdict) -> String {
        let id = escaped(&judged.claim);
        let own = judged.ours().map(|ours| format!("{} ({}; n = {})", short(ours), ours.what, ours.n));
        let ours = own.or_else(|| ours(judged, self.evidence.paper, self.verdicts));
        let ours = ours.unwrap_or_else(|| "–".to_owned());
        let interpretations = judged.rests_on().unwrap_or_default();
        let second = judged.second.map_or_else(String::new, |outcome| {
            format!("<div class=\"second\">second seed: {}</div>", badge(outcome.name(), outcome.name()))
        });
        let reply = replies::mark(self.verdicts, judged);
        let rank = Verdict::ALL.iter().position(|verdict| *verdict == judged.verdict).unwrap_or(0);
        let part = if judged.part_of.is_some() { " data-part" } else { "" };
        format!(
            "<tbody id=\"claim={id}\" data-class=\"{}\" data-rank=\"{rank}\" \
             data-hangs=\"{}\"{part}>\
             <tr><th scope=\"row\"><button type=\"button\" class=\"open\" aria-expanded=\"false\">{}</button></th>\
             <td>{}: {}</td><td>{}</td><td>{}{second}{reply}</td><td class=\"interpretations\">{}</td>\
             <td class=\"under\"></td></tr>\n\
             <tr class=\"evidence\" hidden><td colspan=\"6\">{}</td></tr></tbody>\n",
            escaped(judged.verdict.name()),
            escaped(&hangs_on(judged).join(" ")),
            id.replace('.', ".<wbr>").replace('_', "_<wbr>"),
            escaped(&judged.at),
            escaped(&judged.statement()),
            escaped(&ours),
            badge(judged.verdict.name(), &judged.verdict_text()),
            escaped(&interpretations),
            self.evidence_of(judged)
        )
    }

    fn evidence_of(&self, judged: &ClaimVerdict) -> String {
        let line = |what: &str, value: &Option<String>| {
            value.as_ref().map_or_else(String::new, |value| {
                format!("<p>{what}: {}</p>", inline(value, |id| self.is_claim(id)))
            })
        };
        let whole = judged.part_of.as_ref().map(|whole| format!("`{whole}`"));
        let mut text = line("the paper says", &judged.says);
        text += &line("word for word", &judged.quote);
        text += &line("a part of", &whole);
        text += &line("must hold", &judged.theorem);
        text += &line("changed after a run", &judged.changed());
        text += &replies::lines(self.evidence.paper, self.verdicts, judged);
        text + &judged.findings.iter().map(|finding| self.finding(finding)).collect::<String>()
    }

    fn finding(&self, finding: &CriterionFinding) -> String {
        let outcome =
            finding.outcome.map_or_else(String::new, |outcome| badge(outcome.name(), outcome.name()));
        let mut text = format!(
            "<div class=\"finding\"><p><code>{}</code> {outcome}</p><ul>",
            escaped(&finding.criterion)
        );
        let mut add = |line: &str| text += &format!("<li>{}</li>", inline(line, |id| self.is_claim(id)));
        if let Some(ours) = &finding.ours {
            add(&format!("ours: {}", in_full(ours)));
        }
        finding.because.iter().for_each(|line| add(line));
        finding.settles.iter().for_each(|line| add(&format!("what would settle it: {line}")));
        finding.premises.iter().for_each(|line| add(&format!("premise: {line}")));
        text += &finding
            .trial
            .as_ref()
            .map_or_else(String::new, |trial| format!("<li>{}</li>", self.trial(trial)));
        text + "</ul></div>"
    }

    /// A trial: how to run it again, and its replay if there is one.
    fn trial(&self, trial: &str) -> String {
        let again = format!("replan repro {} --trial '{trial}'", self.evidence.paper.id);
        let replay = if self.replayed.contains(&trial) {
            format!(" <a href=\"#replay={0}\">replay</a>", escaped(trial))
        } else {
            String::new()
        };
        format!("trial <code>{}</code>{replay}; again: <code>{}</code>", escaped(trial), escaped(&again))
    }

    fn has_tables(&self) -> bool {
        let paper = self.evidence.paper;
        !paper.results.is_empty() || paper.tables.iter().any(PrintedTable::has_claims)
    }

    fn has_figures(&self) -> bool {
        self.evidence.runs().any(|run| !run.study.figures.is_empty())
    }

    fn tables(&self) -> Result<String, RenderError> {
        let paper = self.evidence.paper;
        let mut text = String::new();
        for table in paper.tables.iter().filter(|table| table.has_claims()) {
            text += &self.table(table)?;
        }
        for table in &paper.results {
            let found = grid(self.evidence, table).map_err(|what| RenderError::NotStored { what })?;
            let line = |tag: &str, cells: &[String]| {
                let cells: String = cells
                    .iter()
                    .map(|cell| format!("<{tag}>{}</{tag}>", escaped(cell)))
                    .collect::<Vec<_>>()
                    .concat();
                format!("<tr>{cells}</tr>\n")
            };
            text += &format!(
                "<div class=\"wide\"><table class=\"plain\"><caption><span>{}</span></caption><thead>{}</thead>",
                escaped(&table_caption(self.evidence, table)),
                line("th", &found.head)
            );
            for (title, rows) in &found.blocks {
                let rows: String = rows.iter().map(|row| line("td", row)).collect();
                text += &format!(
                    "<tbody><tr><th colspan=\"{}\">{}</th></tr>{rows}</tbody>",
                    found.head.len(),
                    escaped(title)
                );
            }
            text += "</table></div>\n";
        }
        Ok(text)
    }

    /// One of the paper's tables: in each cell what it printed, ours, and the verdict as a word on its colour.
    fn table(&self, table: &PrintedTable) -> Result<String, RenderError> {
        let columns = cells("th", &table.columns);
        let mut text = format!(
            "<div class=\"wide\"><table class=\"plain\"><caption><span>{}</span></caption><thead><tr><th></th>{columns}</tr></thead><tbody>\n",
            escaped(&table.caption)
        );
        for row in &table.rows {
            let shown: String = match beside(self.evidence, table, row, self.verdicts)? {
                None => cells("td", &row.cells.iter().map(|cell| cell.printed.clone()).collect::<Vec<_>>()),
                Some(Beside { printed, ours, claims }) => {
                    let both = printed.iter().zip(&ours).zip(&claims);
                    both.map(|((printed, ours), judged)| cell(printed, ours, *judged)).collect()
                }
            };
            text += &format!("<tr><th scope=\"row\">{}</th>{shown}</tr>\n", escaped(&row.label));
        }
        text += "</tbody></table></div>\n";
        Ok(text + &format!("<p class=\"note\">{}</p>\n", escaped(&table.notes.join(" "))))
    }

    fn figures(&self) -> String {
        let mut text = String::new();
        for run in self.evidence.runs() {
            for figure in &run.study.figures {
                let id = escaped(figure.id.get_ref());
                let about = escaped(&caption(figure, run, self.evidence.paper, self.verdicts));
                text += &format!(
                    "<figure><img data-figure=\"{id}\" alt=\"{about}\"><figcaption>{id}: {about}</figcaption></figure>\n"
                );
            }
        }
        text
    }
}

/// The interpretations one of whose options, departing alone from the default, turns the claim or leaves it open.
fn hangs_on(judged: &ClaimVerdict) -> Vec<&str> {
    let effects = judged.across.iter().flat_map(|across| &across.effects);
    effects.filter(|(_, of)| of.effect >= Effect::Opens).map(|(choice, _)| choice.as_str()).collect()
}

/// Each of `texts` as a cell.
fn cells(tag: &str, texts: &[String]) -> String {
    let cells: Vec<String> = texts.iter().map(|text| format!("<{tag}>{}</{tag}>", escaped(text))).collect();
    cells.concat()
}

fn option(name: &str) -> String {
    format!("<option>{}</option>", escaped(name))
}

fn cell(printed: &str, ours: &str, judged: Option<&ClaimVerdict>) -> String {
    let Some(judged) = judged else { return "<td>–</td>".to_owned() };
    format!(
        "<td class=\"cell\"><b>{}</b><br>ours {}<br><a href=\"#claim={}\">{}</a></td>",
        escaped(printed),
        escaped(ours),
        escaped(&judged.claim),
        badge(judged.verdict.name(), &judged.verdict_text())
    )
}
