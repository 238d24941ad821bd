//! The choices that the paper leaves open, with their options; a script lets readers choose an interpretation.

use super::html::escaped;
use crate::analysis::across::by_interpretation::{ExploredChoice, ExploredOption, explored_choices};
use crate::analysis::verdict::Verdicts;
use study::paper::Paper;

/// The interpretations of `paper`; `explored` of them can be looked at; empty if it leaves nothing open.
pub fn section(paper: &Paper, verdicts: &Verdicts, explored: usize) -> String {
    let choices = explored_choices(paper);
    if choices.is_empty() {
        return String::new();
    }
    let rows: String = choices.iter().map(row).collect();
    let stale = verdicts.explored.as_ref().map_or(0, |explored| explored.stale.len());
    let mut text = match explored {
        0 => "no other interpretation than the default was explored for this paper.".to_owned(),
        _ => format!(
            "{explored} interpretations were explored: every option by itself, and a sample of combinations. Choose one to see each \
             claim's outcome under it; open a claim to see what each option does to it. A probe is shown and never counted."
        ),
    };
    if stale > 0 {
        text += &format!(
            " {stale} claims or their studies changed since; they stand under the default interpretation alone."
        );
    }
    format!(
        "<div id=\"interpretations\"><p>{}</p><form id=\"interpretation\" aria-label=\"an interpretation\"></form>\
         <details><summary>What the paper leaves open, and why these options</summary><div class=\"wide\">\
         <table class=\"plain\"><thead><tr><th>choice</th><th>what is left open</th><th>options</th></tr></thead>\
         <tbody>\n{rows}</tbody></table></div></details></div>\n",
        escaped(&text)
    )
}

fn row(choice: &ExploredChoice) -> String {
    let options: String = choice.options.iter().map(|option| option_marks(choice, option)).collect();
    format!(
        "<tr><th scope=\"row\"><code>{}</code></th><td>{}</td><td><ul>{options}</ul></td></tr>\n",
        escaped(&choice.id),
        escaped(&choice.why)
    )
}

fn option_marks(choice: &ExploredChoice, option: &ExploredOption) -> String {
    let mut marks = Vec::new();
    if option.name == choice.default {
        marks.push("the default");
    }
    if !option.is_meant {
        marks.push("a probe");
    }
    if option.cannot_run.is_some() {
        marks.push("cannot be run here");
    }
    marks.extend(option.cannot_run.as_deref());
    marks.extend(option.cites.as_deref());
    let marks = if marks.is_empty() { String::new() } else { format!(": {}", escaped(&marks.join("; "))) };
    format!("<li><code>{}</code>{marks}</li>", escaped(&option.name))
}
