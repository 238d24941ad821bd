//! The verdict table and the report's chapter.

use super::case::Outcome;
use super::compare::{FRAME_TOLERANCE, Line, TIE_M};
use std::fmt::Write as _;

/// Differences that the chapter lists; the terminal and the file beside the answers hold every one.
const LISTED: usize = 100;

/// Writing to a string cannot fail; this keeps that in one place.
macro_rules! line {
    ($text:expr) => { $text.push('\n') };
    ($text:expr, $($arguments:tt)*) => {{
        let _ = writeln!($text, $($arguments)*);
    }};
}

fn verdict(is_agreed: bool) -> &'static str {
    if is_agreed { "agree" } else { "DIFFER" }
}

/// The power of ten above a difference, at least the twelfth of 1: what is below changes with the processor.
fn bound(largest: Option<f64>) -> String {
    const LEAST: i32 = -12;
    largest.map_or_else(
        || "–".to_owned(),
        |value| format!("< 1e{}", (libm::floor(libm::log10(value)) as i32).saturating_add(1).max(LEAST)),
    )
}

/// The verdict table for the terminal.
pub fn table(outcomes: &[Outcome]) -> String {
    let mut text = String::new();
    let width = outcomes.iter().map(|outcome| outcome.case.len()).max().unwrap_or(0).max(4);
    line!(
        text,
        "{:<width$}  {:<9} {:<24} {:>7} {:>10} {:>5} {:>8} {:>7}  verdict",
        "case",
        "question",
        "configurations",
        "asked",
        "in contact",
        "ties",
        "largest",
        "differ"
    );
    for outcome in outcomes {
        for Line { question, kind, asked, in_contact, ties, largest, disagreements } in &outcome.lines {
            let contact = in_contact.map_or_else(|| "–".to_owned(), |count| count.to_string());
            line!(
                text,
                "{:<width$}  {question:<9} {:<24} {asked:>7} {contact:>10} {ties:>5} {:>8} {disagreements:>7}  {}",
                outcome.case,
                kind.name(),
                bound(*largest),
                verdict(*disagreements == 0)
            );
        }
        let blocked = outcome.paths.blocked.len();
        let origin = if outcome.paths.are_stored { "stored" } else { "drawn" };
        line!(
            text,
            "{:<width$}  {:<9} {origin:<24} {:>7} {:>10} {:>5} {:>8} {blocked:>7}  {}",
            outcome.case,
            "free path",
            outcome.paths.count,
            "–",
            "–",
            "–",
            verdict(blocked == 0)
        );
        for control in &outcome.controls {
            let said = if control.is_caught() { "noticed" } else { "NOT NOTICED" };
            line!(
                text,
                "{:<width$}  control: {}: {} of {}  {said}",
                outcome.case,
                control.what,
                control.caught,
                control.listed
            );
        }
    }
    text
}

/// The chapter of the paper `paper`: `command` made it, `view` opens the scene in MuJoCo's viewer, and `picture` is
/// where its picture is as seen from the report, or why there is none.
pub fn chapter(
    paper: &str,
    outcomes: &[Outcome],
    command: &str,
    view: &str,
    picture: Result<&str, &str>,
) -> String {
    let mut text = String::new();
    line!(text, "## {paper}: the same robots, scenes and paths judged by MuJoCo\n");
    line!(
        text,
        "Made by `{command}`. MuJoCo 4.0.0 was given the numbers of the robot and scene files and the"
    );
    line!(text, "configurations below; it shares no code with us.\n");
    match picture {
        Ok(path) => line!(text, "![the scene as MuJoCo sees it]({path})\n"),
        Err(why) => line!(text, "No picture: {why}.\n"),
    }
    line!(text, "In MuJoCo's own viewer, with keyframes: `{view}`.\n");
    line!(
        text,
        "Tolerances: frames {FRAME_TOLERANCE:e} m and per entry of a rotation, since both sides round a few dozen operations \
         on numbers of the order of 1; distances {TIE_M:e} m, since MuJoCo keeps vertices of meshes in single precision. \
         Within {TIE_M:e} m of contact either answer is right: a tie. Depths of penetration are not compared. \
         Obstacles with flat faces are given as meshes, because MuJoCo's capsule–box primitive misses capsules that \
         pierce a box.\n"
    );
    results(&mut text, outcomes);
    controls(&mut text, outcomes);
    differences(&mut text, outcomes);
    text
}

fn results(text: &mut String, outcomes: &[Outcome]) {
    line!(
        text,
        "| case | question | configurations | asked | in contact | ties | largest difference | differ |"
    );
    line!(text, "|---|---|---|---|---|---|---|---|");
    for outcome in outcomes {
        for Line { question, kind, asked, in_contact, ties, largest, disagreements } in &outcome.lines {
            let contact = in_contact.map_or_else(|| "–".to_owned(), |count| count.to_string());
            line!(
                text,
                "| {} | {question} | {} | {asked} | {contact} | {ties} | {} | **{disagreements}** |",
                outcome.case,
                kind.name(),
                bound(*largest)
            );
        }
    }
    line!(text, "\n| case | paths | from | not free for MuJoCo |");
    line!(text, "|---|---|---|---|");
    for outcome in outcomes {
        let from = if outcome.paths.are_stored {
            "the stored run, at a quarter of its step"
        } else {
            "drawn: no stored paths of this robot in this scene"
        };
        line!(
            text,
            "| {} | {} | {from} | **{}** |",
            outcome.case,
            outcome.paths.count,
            outcome.paths.blocked.len()
        );
    }
}

fn controls(text: &mut String, outcomes: &[Outcome]) {
    line!(text, "\nErrors made on purpose, which must be noticed:\n");
    line!(text, "| case | error | answers that must differ | that do |");
    line!(text, "|---|---|---|---|");
    for outcome in outcomes {
        for control in &outcome.controls {
            line!(text, "| {} | {} | {} | {} |", outcome.case, control.what, control.listed, control.caught);
        }
    }
}

fn differences(text: &mut String, outcomes: &[Outcome]) {
    let all = list(outcomes);
    if all.is_empty() {
        line!(text, "\nNothing differs.");
        return;
    }
    line!(text, "\nEverything that differs, one by one:\n");
    for item in all.iter().take(LISTED) {
        line!(text, "- {item}");
    }
    if all.len() > LISTED {
        line!(text, "\n… and {} more, in `disagreements.txt` beside the answers.", all.len() - LISTED);
    }
}

/// Everything that differs: configuration, pair, both values; unnoticed controls among them.
pub fn list(outcomes: &[Outcome]) -> Vec<String> {
    let mut all = Vec::new();
    for outcome in outcomes {
        for found in &outcome.disagreements {
            all.push(format!(
                "{}, {} of {}, {} configuration {} {:?}: ours {}, MuJoCo {}",
                outcome.case,
                found.question,
                found.of,
                found.kind.name(),
                found.row,
                found.q_rad,
                found.ours,
                found.theirs
            ));
        }
        all.extend(outcome.paths.blocked.iter().map(|blocked| format!("{}, {blocked}", outcome.case)));
        let missed = outcome.controls.iter().filter(|control| !control.is_caught());
        all.extend(missed.map(|control| {
            let (caught, listed) = (control.caught, control.listed);
            format!("{}, control not noticed: {} ({caught} of {listed})", outcome.case, control.what)
        }));
    }
    all
}
