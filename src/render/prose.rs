//! A paper's own words about what was found, with our numbers put in from the verdicts.

use super::tables::number;
use crate::analysis::verdict::Verdicts;
use crate::study::paper::filled;

/// `text` with every `{claim}` replaced by our number beside that claim, every `{claim:tenths}` by it with one decimal, every `{claim:percent}` by it as a
/// percentage,
/// every `{claim:n}` by how many draws it rests on and every `{claim:verdict}` by what was found; a dash where there is
/// none.
pub fn prose(text: &str, verdicts: &Verdicts) -> String {
    filled(text, |claim, form| {
        let judged = verdicts.claim(claim);
        let ours = judged.and_then(|judged| judged.ours());
        let found = match form {
            "verdict" => judged.map(|judged| judged.outcome().to_owned()),
            "n" => ours.map(|ours| ours.n.to_string()),
            "tenths" => ours.map(|ours| format!("{:.1}", ours.value)),
            "percent" => ours.map(|ours| format!("{:.0} %", 100.0 * ours.value)),
            _ => ours.map(|ours| number(ours.value)),
        };
        found.unwrap_or_else(|| "–".to_owned())
    })
}
