//! The verdict table and the report's chapter.

use super::case::{Outcome, Paths};
use super::compare::{FRAME_TOLERANCE, Line, TIE_M};
use super::control::Control;
use super::planar::LINK_RADIUS_M;
use super::sample::Kind;
use base::text::listed;
use std::collections::BTreeSet;
use std::fmt::Write as _;

/// The version that `crosscheck/requirements.txt` pins.
pub const MUJOCO: &str = "4.0.0";

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
    let head = ["question", "configurations", "asked", "in contact", "ties", "largest", "differ"];
    row(&mut text, width, "case", &head.map(str::to_owned), "verdict");
    let none = || "–".to_owned();
    for Outcome { case, lines, paths, controls, .. } in outcomes {
        for Line { question, kind, asked, in_contact, ties, largest, disagreements } in lines {
            let contact = in_contact.map_or_else(none, |count| count.to_string());
            let ties = ties.to_string();
            let differ = disagreements.to_string();
            let question = (*question).to_owned();
            let kind = kind.name().to_owned();
            let cells = [question, kind, asked.to_string(), contact, ties, bound(*largest), differ];
            row(&mut text, width, case, &cells, verdict(*disagreements == 0));
        }
        let count = paths.count.to_string();
        let blocked = paths.blocked.len();
        let origin = (if paths.are_stored { "stored" } else { "drawn" }).to_owned();
        let cells = ["free path".to_owned(), origin, count, none(), none(), none(), blocked.to_string()];
        row(&mut text, width, case, &cells, verdict(blocked == 0));
        for control in controls {
            let said = if control.is_caught() { "noticed" } else { "NOT NOTICED" };
            let Control { what, listed, caught } = control;
            line!(text, "{case:<width$}  control: {what}: {caught} of {listed}  {said}");
        }
    }
    text
}

fn row(text: &mut String, width: usize, case: &str, cells: &[String; 7], verdict: &str) {
    let [question, kind, asked, contact, ties, largest, differ] = cells;
    line!(
        text,
        "{case:<width$}  {question:<9} {kind:<24} {asked:>7} {contact:>10} {ties:>5} {largest:>8} {differ:>7}  {verdict}"
    );
}

/// Where the scene's picture is, as seen from the report.
#[derive(Debug, Clone, Copy)]
pub enum Depicted<'a> {
    /// Here, drawn with the rest.
    Now(&'a str),
    /// Here, from an earlier run; the reason why there is no new one.
    Before(&'a str, &'a str),
    /// Nowhere, and why.
    Not(&'a str),
}

impl Depicted<'_> {
    fn paragraph(self) -> String {
        let image = |path: &str| format!("![the scene as MuJoCo sees it]({path})\n\n");
        match self {
            Self::Now(path) => image(path),
            Self::Before(path, why) => image(path) + &format!("The picture is of an earlier run: {why}.\n\n"),
            Self::Not(why) => format!("No picture: {why}.\n\n"),
        }
    }
}

/// The chapter of the paper `paper`: `command` made it, `view` opens the scene in MuJoCo's viewer, and `stand_ins` says
/// that inputs are not the paper's own.
pub fn chapter(
    paper: &str,
    outcomes: &[Outcome],
    command: &str,
    view: &str,
    picture: Depicted<'_>,
    stand_ins: Option<&str>,
) -> String {
    let mut text = String::new();
    line!(text, "# {paper}: the same robots, scenes and paths judged by MuJoCo\n");
    line!(
        text,
        "Made by `{command}`. MuJoCo {MUJOCO} was given the numbers of the robot and scene files and the\n\
         configurations below; it shares no code with us.\n"
    );
    if let Some(note) = stand_ins {
        line!(text, "{note}\n");
    }
    line!(text, "**{}**\n", summary(outcomes));
    text += &picture.paragraph();
    line!(text, "In MuJoCo's own viewer, with keyframes: `{view}`.\n");
    tolerances(&mut text);
    line!(
        text,
        "Contact of each pair that may touch: configurations asked, and in brackets how many are in contact.\n"
    );
    contacts(&mut text, outcomes, "contact");
    if outcomes.iter().flat_map(|outcome| &outcome.lines).any(|line| line.question == "planners") {
        line!(
            text,
            "\nThe same of the check that planners use, which knows no pairs (and for some robots only what stands around them).\n"
        );
        contacts(&mut text, outcomes, "planners");
    }
    numbers(&mut text, outcomes);
    paths(&mut text, outcomes);
    controls(&mut text, outcomes);
    differences(&mut text, outcomes);
    text
}

fn tolerances(text: &mut String) {
    line!(
        text,
        "Tolerances: frames {FRAME_TOLERANCE:e} m and per entry of a rotation, since both sides round a few dozen operations \
         on numbers of the order of 1; distances {TIE_M:e} m, since MuJoCo keeps vertices of meshes in single precision \
         and links without width are given to it {LINK_RADIUS_M:e} m thick. \
         Within {TIE_M:e} m of contact either answer is right: a tie. Depths of penetration are not compared. \
         Obstacles with flat faces are given as meshes, because MuJoCo's capsule–box primitive misses capsules that \
         pierce a box.\n"
    );
}

/// The verdict in a sentence.
fn summary(outcomes: &[Outcome]) -> String {
    let lines = || outcomes.iter().flat_map(|outcome| &outcome.lines);
    let asked = |question: &str| -> usize {
        lines().filter(|line| line.question == question).map(|line| line.asked).sum()
    };
    let differ: usize = lines().map(|line| line.disagreements).sum();
    let blocked: usize = outcomes.iter().map(|outcome| outcome.paths.blocked.len()).sum();
    let missed = outcomes.iter().flat_map(|o| &o.controls).filter(|control| !control.is_caught()).count();
    let verdict = if outcomes.iter().all(Outcome::is_agreed) {
        "MuJoCo agrees with every answer, and every error made on purpose was noticed".to_owned()
    } else {
        format!(
            "MuJoCo DIFFERS: {differ} answers, {blocked} paths that should be free, {missed} errors made on purpose \
             that went unnoticed"
        )
    };
    let parts = [
        ("contact", "for contact"),
        ("planners", "also of the check that planners use"),
        ("frame", "for frames"),
        ("distance", "for distances"),
        ("limit", "for joint limits"),
    ];
    let parts = parts.iter().map(|(question, words)| (asked(question), words));
    let parts: Vec<String> =
        parts.filter(|(count, _)| *count > 0).map(|(count, words)| format!("{count} {words}")).collect();
    format!(
        "{verdict}: {} cases (a robot in a scene), configurations asked {}.",
        outcomes.len(),
        parts.join(", ")
    )
}

/// One row a case that was asked `question`, one column a kind of configuration.
fn contacts(text: &mut String, outcomes: &[Outcome], question: &str) {
    let own = |outcome: &Outcome| {
        outcome.lines.iter().filter(|line| line.question == question).cloned().collect::<Vec<Line>>()
    };
    let kinds: BTreeSet<Kind> = outcomes.iter().flat_map(own).map(|line| line.kind).collect();
    let names: Vec<&str> = kinds.iter().map(|kind| kind.name()).collect();
    line!(text, "| case | {} | ties | differ |", names.join(" | "));
    line!(text, "|---|{}---|---|", "---|".repeat(kinds.len()));
    for (outcome, lines) in outcomes.iter().map(|outcome| (outcome, own(outcome))) {
        let cell = |kind: &Kind| {
            lines.iter().find(|line| line.kind == *kind).map_or_else(
                || "–".to_owned(),
                |line| format!("{} ({})", line.asked, line.in_contact.unwrap_or(0)),
            )
        };
        let cells: Vec<String> = kinds.iter().map(cell).collect();
        let (ties, differ) =
            lines.iter().fold((0, 0), |(t, d), line| (t + line.ties, d + line.disagreements));
        if !lines.is_empty() {
            line!(text, "| {} | {} | {ties} | **{differ}** |", outcome.case, cells.join(" | "));
        }
    }
}

/// Frames, distances and limits: how many configurations were asked, and the largest difference.
fn numbers(text: &mut String, outcomes: &[Outcome]) {
    line!(text, "\nConfigurations asked for numbers, and the largest difference.\n");
    line!(text, "| case | frames | largest | distances | largest, m | joint limits | differ |");
    line!(text, "|---|---|---|---|---|---|---|");
    for outcome in outcomes {
        let of = |question: &'static str| outcome.lines.iter().filter(move |line| line.question == question);
        let asked = |question| of(question).map(|line| line.asked).sum::<usize>();
        let largest = |question| bound(of(question).filter_map(|line| line.largest).reduce(f64::max));
        let differ: usize =
            ["frame", "distance", "limit"].into_iter().flat_map(of).map(|l| l.disagreements).sum();
        line!(
            text,
            "| {} | {} | {} | {} | {} | {} | **{differ}** |",
            outcome.case,
            asked("frame"),
            largest("frame"),
            asked("distance"),
            largest("distance"),
            asked("limit")
        );
    }
}

fn paths(text: &mut String, outcomes: &[Outcome]) {
    line!(text, "\n| case | paths | from | said to be free of | not so for MuJoCo |");
    line!(text, "|---|---|---|---|---|");
    for Outcome { case, paths: Paths { count, are_stored, free_of, blocked }, .. } in outcomes {
        let from = if *are_stored {
            "the stored run, at a quarter of its step"
        } else {
            "drawn: no stored paths of this robot in this scene"
        };
        line!(text, "| {case} | {count} | {from} | {} | **{}** |", free_of.name(), blocked.len());
    }
}

fn controls(text: &mut String, outcomes: &[Outcome]) {
    line!(text, "\nErrors made on purpose, and how many of the answers that must differ do:\n");
    line!(text, "| case | a longer link | a moved obstacle | a path pushed into an obstacle |");
    line!(text, "|---|---|---|---|");
    for outcome in outcomes {
        let cell = |control: &Control| format!("{}: {} of {}", control.what, control.caught, control.listed);
        let cells: Vec<String> = outcome.controls.iter().map(cell).collect();
        line!(text, "| {} | {} |", outcome.case, cells.join(" | "));
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
                "{}, {} of {}, {} configuration {} {}: ours {}, MuJoCo {}",
                outcome.case,
                found.question,
                found.of,
                found.kind.name(),
                found.row,
                listed(&found.q_rad),
                found.ours,
                found.theirs
            ));
        }
        all.extend(outcome.paths.blocked.iter().map(|blocked| format!("{}, {blocked}", outcome.case)));
        let missed = outcome.controls.iter().filter(|control| !control.is_caught());
        all.extend(missed.map(|control| {
            let caught = control.caught;
            let listed = control.listed;
            format!("{}, control not noticed: {} ({caught} of {listed})", outcome.case, control.what)
        }));
    }
    all
}
