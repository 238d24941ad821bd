//! What the paper leaves open, and each way to fill it in; a script lets readers choose one.

use super::html::escaped;
use crate::analysis::across::by_reading::{Axis, AxisOption, axes};
use crate::analysis::verdict::Verdicts;
use study::paper::Paper;

/// The readings of `paper`, of which `explored` can be looked at; empty if it leaves nothing open.
pub fn section(paper: &Paper, verdicts: &Verdicts, explored: usize) -> String {
    let axes = axes(paper);
    if axes.is_empty() {
        return String::new();
    }
    let rows: String = axes.iter().map(row).collect();
    let stale = verdicts.explored.as_ref().map_or(0, |explored| explored.stale.len());
    let mut said = match explored {
        0 => "No other reading than the default was explored for this paper.".to_owned(),
        _ => format!(
            "{explored} readings were explored: every option by itself, and a sample of combinations. Choose one to see each \
             claim's outcome under it; open a claim to see what each option does to it. A probe is shown and never counted."
        ),
    };
    if stale > 0 {
        said += &format!(
            " {stale} claims or their studies changed since; they stand under the default reading alone."
        );
    }
    format!(
        "<div id=\"readings\"><p>{}</p><form id=\"reading\" aria-label=\"a reading\"></form>\
         <details><summary>What the paper leaves open, and why these options</summary><div class=\"wide\">\
         <table class=\"plain\"><thead><tr><th>reading</th><th>what is left open</th><th>options</th></tr></thead>\
         <tbody>\n{rows}</tbody></table></div></details></div>\n",
        escaped(&said)
    )
}

fn row(axis: &Axis) -> String {
    let options: String = axis.options.iter().map(|option| said(axis, option)).collect();
    format!(
        "<tr><th scope=\"row\"><code>{}</code></th><td>{}</td><td><ul>{options}</ul></td></tr>\n",
        escaped(&axis.id),
        escaped(&axis.why)
    )
}

fn said(axis: &Axis, option: &AxisOption) -> String {
    let mut marks = Vec::new();
    if option.name == axis.default {
        marks.push("the default");
    }
    if !option.votes {
        marks.push("a probe");
    }
    marks.extend(option.cites.as_deref());
    let marks = if marks.is_empty() { String::new() } else { format!(": {}", escaped(&marks.join("; "))) };
    format!("<li><code>{}</code>{marks}</li>", escaped(&option.name))
}
