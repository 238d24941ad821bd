//! The agreement of two encodings of one paper as Markdown.

use crate::analysis::agreement::Agreement;

/// A sentence, the claims that are judged differently with what differs, and what one side alone has.
pub fn markdown(of: &Agreement) -> String {
    let [first, second] = &of.sides;
    let cell = |text: &str| text.replace('|', "\\|").replace('\n', " ");
    let mut text = format!(
        "{} of {} claims that `{first}` and `{second}` share are judged differently.\n",
        of.differ(),
        of.claims.len()
    );
    if of.differ() > 0 {
        text +=
            &format!("\n| claim | {} | {} | what differs |\n|---|---|---|---|\n", cell(first), cell(second));
    }
    for pair in of.claims.iter().filter(|pair| !pair.is_same) {
        let [own, other] = &pair.ids;
        let name = if own == other { format!("`{own}`") } else { format!("`{own}` and `{other}`") };
        let [before, after] = pair.verdicts;
        text += &format!("| {} | {before} | {after} | {} |\n", cell(&name), cell(&pair.because.join("; ")));
    }
    if !of.defaults.is_empty() {
        text += "\nDefaults that differ:\n\n";
        text +=
            &of.defaults.iter().map(|pair| format!("- {}\n", pair.in_words())).collect::<Vec<_>>().concat();
    }
    for (side, only) in of.sides.iter().zip(&of.only).filter(|(_, only)| !only.is_empty()) {
        text += &format!("\nOnly `{side}` has {}: `{}`.\n", only.len(), only.join("`, `"));
    }
    text
}
