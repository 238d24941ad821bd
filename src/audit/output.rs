//! A report for people, a line a finding, and for programs, as JSON.

use super::checks::{REGISTRY, summary};
use super::input::Input;
use super::meaning::{ITEMS, Kind};
use super::reader;
use super::report::{Class, Finding, Report, Unseen};
use super::statistic::Statistic;
use super::table::{Column, Table};
use super::witness::Witness;
use serde_json::{Value, json};

/// A finding in one line: place, class, name, what was found, and how far to trust it.
pub fn line(source: &str, finding: &Finding) -> String {
    let mut line =
        format!("{source}:{}: {}: {}: {}", finding.place, finding.class.name(), finding.name, finding.text);
    let mut notes = vec![finding.check.to_owned()];
    if let Some(power) = finding.power {
        notes.push(power.to_string());
    }
    match &finding.mend {
        Some(mend) => {
            notes.push(format!("least change: {} from {} to {}", mend.name, mend.from, mend.to));
            notes.extend(mend.changes_ranking.map(|changes| {
                if changes { "the ranking changes with it" } else { "the ranking stays" }.to_owned()
            }));
        }
        None if finding.class == Class::Impossible && !finding.is_cut_short => {
            notes.push("no small change of one number mends it".to_owned());
        }
        None => {}
    }
    if !finding.follows.is_empty() {
        notes.push(format!("with that change these are possible too: {}", finding.follows.join(", ")));
    }
    if finding.class != Class::Possible {
        notes.push(format!("if {}", finding.premises.join("; ")));
    }
    line += &format!(" [{}]", notes.join("; "));
    if let Some(witness) = &finding.witness {
        line += &format!(" {}", witness_line(witness));
    }
    line
}

fn witness_line(witness: &Witness) -> String {
    let [taken, budget] = witness.steps;
    if witness.vectors.is_empty() {
        return format!("no data found in {taken} of {budget} steps");
    }
    let how = if witness.is_all { "all" } else { "some" };
    format!("data ({how} of them, {taken} of {budget} steps): {}", witness.vectors.join(" | "))
}

/// Numbers behind `±` or in brackets that no check looks at, with the annotation under which one would.
pub fn unread_spreads(source: &str, input: &Input) -> Vec<String> {
    let columns = input.tables.iter().flat_map(|table| (0..table.columns.len()).map(move |at| (table, at)));
    columns.filter_map(|(table, at)| Some(format!("{source}:{}", unread_spread(table, at)?))).collect()
}

fn unread_spread(table: &Table, at: usize) -> Option<String> {
    let cell = table.rows.iter().filter_map(|row| row.get(at)).find(|cell| cell.spread.is_some())?;
    let Column { name, meaning, .. } = &table.columns[at];
    let has_mean = matches!(meaning.kind, Kind::Share { .. } | Kind::Statistic(Statistic::Mean));
    let what = if table.statistics().is_some() {
        "rows are statistics, so that a deviation has a row of its own"
    } else if matches!(meaning.kind, Kind::Statistic(_)) && !has_mean {
        "it stands beside no mean, so that no check knows it; leave it out, or give it a column of its own"
    } else if !has_mean {
        "say `mean, n=N` and `±sd` or `±se`, if it is a mean with its deviation or standard error"
    } else if meaning.spread.is_none() && is_multiple(table, at) {
        "1.0 is among them, as in multiples of the best; say `±sd` if it is the deviation or `±se` if it is the standard error"
    } else if meaning.spread.is_none() {
        "say `±sd` if it is the deviation or `±se` if it is the standard error"
    } else {
        return None;
    };
    Some(format!(
        "{}: column `{name}`: what stands behind {} is not looked at; {what}",
        cell.place, cell.text
    ))
}

/// Whether what stands in brackets may be multiples of the best.
fn is_multiple(table: &Table, at: usize) -> bool {
    let brackets = table.rows.iter().filter_map(|row| Some(row.get(at)?.spread?.value()));
    reader::are_multiples(&brackets.collect::<Vec<_>>())
}

/// Totals that are means, which their names do not say.
pub fn totals(source: &str, input: &Input) -> Vec<String> {
    let found = summary::totals_that_are_means(input);
    found.iter().map(|found| format!("{source}:{found}; it is taken as one")).collect()
}

/// Columns and samples that no check looked at, each with the annotation that would change that. If no check ran at all, that
/// too.
pub fn unseen(source: &str, report: &Report) -> Vec<String> {
    let line = |unseen: &Unseen| {
        format!("{source}:{}: {}: no check looked at it; {}", unseen.place, unseen.name, unseen.advice)
    };
    let nothing = report.tally.is_empty().then(|| {
        format!("{source}: nothing was looked at, which is no pass: no column says enough for any check")
    });
    let cut_short = (report.cut_short > 0).then(|| {
        format!(
            "{source}: the budget is used up: {} findings have no power or least change; audit the rows in several files",
            report.cut_short
        )
    });
    report.unseen.iter().map(line).chain(nothing).chain(cut_short).collect()
}

/// What each check did, a line a check.
pub fn summary(report: &Report) -> Vec<String> {
    let line = |(name, tally): (&&str, &super::report::Tally)| {
        let power = match tally.powers {
            0 => "power not computed".to_owned(),
            powers => {
                format!("refuses {:.0} % of prints on average", 100.0 * tally.power_sum / powers as f64)
            }
        };
        let mut counts = vec![format!("{} impossible", tally.impossible)];
        if tally.signals > 0 {
            counts.push(format!("{} signals", tally.signals));
        }
        if tally.follows > 0 {
            counts.push(format!("{} listed with another finding", tally.follows));
        }
        if tally.unchecked > 0 {
            counts.push(format!("{} not decided", tally.unchecked));
        }
        format!("{name}: {} looked at, {}; {power}", tally.applied, counts.join(", "))
    };
    report.tally.iter().map(line).collect()
}

/// What was guessed, with a header to correct.
pub fn guesses(source: &str, input: &Input) -> Vec<String> {
    let guessed = input.tables.iter().filter_map(|table| {
        let names: Vec<&str> = table
            .columns
            .iter()
            .filter(|column| column.written.is_none() && column.meaning.kind != Kind::Skip)
            .map(|column| column.name.as_str())
            .collect();
        let header = reader::stub_line(table);
        (!names.is_empty()).then(|| {
            format!(
                "{source}:{}: guessed what {} are; correct the header: {header}",
                table.line,
                names.join(", ")
            )
        })
    });
    guessed.collect()
}

/// The whole report, with the header of every table that has a guessed column.
pub fn json(source: &str, input: &Input, report: &Report) -> Value {
    let findings: Vec<Value> = report.findings.iter().map(finding).collect();
    let checks: Vec<Value> = report
        .tally
        .iter()
        .map(|(name, tally)| {
            json!({
                "check": name,
                "applied": tally.applied,
                "impossible": tally.impossible,
                "signals": tally.signals,
                "told_with_another": tally.follows,
                "not_decided": tally.unchecked,
                "mean_power": (tally.powers > 0).then(|| tally.power_sum / tally.powers as f64),
            })
        })
        .collect();
    let is_guessed = |table: &&Table| table.columns.iter().any(|column| column.written.is_none());
    let guessed = input
        .tables
        .iter()
        .filter(is_guessed)
        .map(|table| json!({ "line": table.line, "header": reader::stub(table) }));
    let guessed: Vec<Value> = guessed.collect();
    let unread = unread_spreads(source, input);
    let unseen = report.unseen.iter().map(|unseen| {
        json!({ "line": unseen.place.line, "cell": unseen.place.cell, "name": unseen.name, "advice": unseen.advice })
    });
    json!({
        "source": source,
        "guessed": guessed,
        "unread_spreads": unread,
        "not_looked_at": unseen.collect::<Vec<_>>(),
        "findings": findings,
        "checks": checks,
    })
}

fn finding(finding: &Finding) -> Value {
    json!({
        "check": finding.check,
        "class": finding.class.name(),
        "line": finding.place.line,
        "cell": finding.place.cell,
        "name": finding.name,
        "text": finding.text,
        "premises": finding.premises,
        "readings": finding.readings,
        "power": finding.power.map(|power| json!({
            "share": power.share(),
            "refused": power.refused,
            "tried": power.tried,
            "from": power.low.to_string(),
            "to": power.high.to_string(),
            "why": power.why,
            "is_beyond": power.is_beyond,
        })),
        "mend": finding.mend.as_ref().map(|mend| json!({
            "name": mend.name,
            "from": mend.from.to_string(),
            "to": mend.to.to_string(),
            "changes_ranking": mend.changes_ranking,
        })),
        "follows": finding.follows,
        "certificate": finding.certificate,
        "witness": finding.witness.as_ref().map(|witness| json!({
            "vectors": witness.vectors,
            "is_all": witness.is_all,
            "steps_taken": witness.steps[0],
            "steps_allowed": witness.steps[1],
        })),
    })
}

/// Every check and every item of an annotation, for `--list`.
pub fn list() -> String {
    let mut text = String::from("Checks:\n");
    for entry in REGISTRY {
        text += &format!("  {}: {}\n", entry.name, entry.about);
        text += &format!(
            "      refuses: {}\n      if: {}\n      source: {}\n",
            entry.example, entry.premises, entry.source
        );
        if let Some(form) = &entry.relation {
            text += &format!(
                "      in TOML: [[relation]] check = \"{}\", {}\n",
                entry.name,
                form.names().join(", ")
            );
        }
    }
    text += "\nItems of an annotation, `name [item, item]`:\n";
    for (item, says) in ITEMS {
        text += &format!("  {item}\n      {says}\n");
    }
    text
}
