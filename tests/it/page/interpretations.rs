//! What the page lets readers see of interpretations: the class of each claim under one, and what each option does to a claim.

use super::driver::Browser;
use super::{SHOWN, page};
use replan::analysis::across::Stored;
use replan::analysis::across::stored::Exploration;
use replan::analysis::polylines::Polylines;
use replan::analysis::verdict::{ClaimVerdict, Effect, Verdicts};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use study::Inputs;
use study::paper::Paper;

fn runs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("data/runs/zhang")
}

fn explored() -> Exploration {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folder = root.join("experiments/zhang");
    let paper = Paper::load(&folder, &Inputs::below(vec![folder.clone(), root.to_owned()])).unwrap();
    Stored::read(&paper, &runs(), &Polylines::default()).unwrap().first.unwrap()
}

/// The class of each claim under the interpretation that is chosen, by the claim's id.
const UNDER: &str = "return Object.fromEntries([...document.getElementById('claimed').tBodies]
    .map((line) => [line.id.slice('claim='.length), line.dataset.under]))";

#[test]
fn a_reading_that_is_chosen_shows_each_claims_class_under_it() {
    let explored = explored();
    let Some(browser) = Browser::open([1280, 800]) else { return };
    let file = page("zhang");
    let mut moved = 0;
    for place in [3, explored.interpretations.len() / 2, explored.interpretations.len() - 1] {
        let options: Vec<String> =
            explored.interpretations[place].iter().map(|(id, option)| format!("{id}:{option}")).collect();
        browser.go(&file, &format!("interpretation={}", options.join(",")));
        let shown = browser.run(UNDER);
        let shown: Vec<(&String, &str)> = shown
            .as_object()
            .unwrap()
            .iter()
            .map(|(id, class)| (id, class.as_str().unwrap()))
            .filter(|(_, class)| !class.is_empty())
            .collect();
        assert!(shown.len() > 20, "{options:?}: {} claims", shown.len());
        for (id, class) in shown {
            // The default run has more instances than an exploration.
            let Some(result) =
                explored.result(id, place).filter(|result| !result.interpretations.contains(&0))
            else {
                continue;
            };
            assert_eq!(class, result.outcome.name(), "{id} under {options:?}");
            moved += 1;
        }
        browser.run("const f = document.getElementById('filter'); f.elements.under.value = 'differs'; f.dispatchEvent(new Event('input'))");
        let differing = browser
            .run("return document.querySelectorAll('#claimed tbody[data-differs]:not([data-part])').length");
        assert_eq!(browser.run(SHOWN), differing, "{options:?}");
    }
    assert!(moved > 20, "one-sided sample: {moved} results differ from the default's");
    browser.picture("zhang-interpretation-1280");
    assert_eq!(browser.console(), json!([]));
}

#[test]
fn a_combination_that_was_not_explored_is_reported_and_leads_to_those_that_were() {
    let Some(browser) = Browser::open([390, 844]) else { return };
    browser.go(&page("zhang"), "interpretation=meeting:both_closed,ties:lifo,nodes:closed,end:contact");
    let script = "return document.querySelector('#interpretation output').textContent";
    assert!(browser.run(script).as_str().unwrap().starts_with("This combination was not explored."));
    browser.run("document.querySelector('#interpretation output button').click()");
    assert!(browser.run(script).as_str().unwrap().starts_with("Interpretation "), "{}", browser.run(script));
    browser.run("document.querySelector('#interpretation [name=defaults]').click()");
    assert_eq!(browser.run("return location.hash"), json!("#interpretation="));
    browser.picture("zhang-interpretation-390");
    assert_eq!(browser.console(), json!([]));
}

#[test]
fn a_claim_that_is_opened_shows_what_each_option_does_and_lines_filter_by_what_they_hang_on() {
    let verdicts = Verdicts::read(&runs()).unwrap();
    let Some(browser) = Browser::open([1280, 800]) else { return };
    let file = page("zhang");
    let effects =
        |judged: &ClaimVerdict| judged.across.clone().map(|across| across.effects).unwrap_or_default();
    let turns =
        verdicts.claims.iter().find(|judged| effects(judged).values().any(|of| of.effect == Effect::Turns));
    let turned = turns.expect("some interpretation turns some claim");
    browser.go(&file, &format!("claim={}", turned.claim));
    let options = browser.run(&format!(
        "return [...document.getElementById('claim={}').querySelectorAll('.options tbody tr')].map((row) => [...row.cells].map((cell) => cell.textContent))",
        turned.claim
    ));
    for (choice, of) in effects(turned).iter().filter(|(_, of)| of.effect == Effect::Turns) {
        let row = |row: &&Value| row[0] == json!(format!("{choice} = {}", of.option));
        let row =
            options.as_array().unwrap().iter().find(row).unwrap_or_else(|| panic!("{choice}: {options}"));
        assert_eq!((&row[1], &row[2]), (&json!("turns it"), &json!(of.outcome.name())), "{options}");
    }
    for choice in ["meeting", "nodes"] {
        let hangs = |judged: &&ClaimVerdict| {
            judged.part_of.is_none()
                && effects(judged).get(choice).is_some_and(|of| of.effect >= Effect::Opens)
        };
        let count = verdicts.claims.iter().filter(hangs).count();
        browser.go(&file, &format!("hangs={choice}"));
        assert_eq!(browser.run(SHOWN), json!(count), "{choice}");
        assert!(count > 0, "no claim hangs on {choice}");
    }
    assert_eq!(browser.console(), json!([]));
}
