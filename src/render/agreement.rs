//! The agreement of two encodings of one paper as Markdown.

use crate::analysis::agreement::Agreement;

/// A sentence, the claims that are judged differently with what differs, and what one side alone has.
pub fn markdown(agreement: &Agreement) -> String {
    let [first, second] = &agreement.sides;
    let cell = |text: &str| text.replace('|', "\\|").replace('\n', " ");
    let mut text = format!(
        "{} of {} claims that `{first}` and `{second}` share are judged differently.\n",
        agreement.differ(),
        agreement.claims.len()
    );
    if agreement.differ() > 0 {
        text +=
            &format!("\n| claim | {} | {} | what differs |\n|---|---|---|---|\n", cell(first), cell(second));
    }
    for pair in agreement.claims.iter().filter(|pair| !pair.is_same) {
        let [own, other] = &pair.ids;
        let name = if own == other { format!("`{own}`") } else { format!("`{own}` and `{other}`") };
        let [before, after] = pair.verdicts;
        text += &format!("| {} | {before} | {after} | {} |\n", cell(&name), cell(&pair.because.join("; ")));
    }
    if !agreement.defaults.is_empty() {
        text += "\nDefaults that differ:\n\n";
        text += &agreement
            .defaults
            .iter()
            .map(|pair| format!("- {}\n", pair.in_words()))
            .collect::<Vec<_>>()
            .concat();
    }
    for (side, only) in agreement.sides.iter().zip(&agreement.only).filter(|(_, only)| !only.is_empty()) {
        text += &format!("\nOnly `{side}` has {}: `{}`.\n", only.len(), only.join("`, `"));
    }
    text
}
