//! How the page looks and answers: by keyboard, in the dark, on paper, on a narrow screen, to those who cannot see it.

use super::driver::Browser;
use super::page;
use crate::paper::committed;
use serde_json::{Value, json};
use std::path::Path;

/// How light the colour of an element is, from 0 to 1, as the mean of red, green and blue.
fn lightness(browser: &Browser, property: &str) -> f64 {
    let script = format!(
        "return getComputedStyle(document.body)['{property}'].match(/\\d+/g).slice(0, 3).map(Number)"
    );
    let parts = browser.run(&script);
    parts.as_array().unwrap().iter().map(|part| part.as_f64().unwrap()).sum::<f64>() / 3.0 / 255.0
}

#[test]
fn the_page_is_dark_where_the_reader_wants_it_dark() {
    let Some(browser) = Browser::open([1280, 800]) else { return };
    let file = page("zhang");
    for (scheme, is_dark) in [("light", false), ("dark", true)] {
        browser.emulate(&json!({ "features": [{ "name": "prefers-color-scheme", "value": scheme }] }));
        browser.go(&file, "claims");
        let [paper, ink] = ["backgroundColor", "color"].map(|property| lightness(&browser, property));
        assert_eq!(paper < 0.3 && ink > 0.7, is_dark, "{scheme}: paper {paper}, ink {ink}");
        assert_eq!(paper > 0.7 && ink < 0.3, !is_dark, "{scheme}: paper {paper}, ink {ink}");
        browser.picture(&format!("zhang-{scheme}-1280"));
    }
}

#[test]
fn on_paper_stand_all_evidence_and_figures_without_controls() {
    let Some(browser) = Browser::open([1280, 800]) else { return };
    browser.go(&page("zhang"), "claims");
    browser.emulate(&json!({ "media": "print" }));
    browser.run("dispatchEvent(new Event('beforeprint'))");
    browser.wait("return [...document.querySelectorAll('#figures img')].every((image) => image.complete && image.naturalWidth > 0)");
    let hidden = "return ['nav', '#filter', '#player'].map((part) => getComputedStyle(document.querySelector(part)).display)";
    assert_eq!(browser.run(hidden), json!(["none", "none", "none"]));
    let closed = "return [...document.querySelectorAll('#claimed tbody:not([hidden]) .evidence')].filter((row) => row.offsetHeight === 0).length";
    assert_eq!(browser.run(closed), json!(0));
    assert_eq!(browser.run("return document.querySelector('#interpretations details').open"), json!(true));
}

#[test]
fn keys_open_a_claim_and_move_a_replay() {
    let Some(browser) = Browser::open([1280, 800]) else { return };
    let file = page("planar");
    browser.go(&file, "claims");
    browser.run("document.querySelector('#claimed .open').focus()");
    browser.press("\u{E007}");
    assert_eq!(
        browser.run("return document.querySelector('#claimed .open').getAttribute('aria-expanded')"),
        json!("true")
    );
    browser.go(&file, "replay=methods/case-1/a-star-8");
    browser.run("document.querySelector('[name=step]').focus()");
    browser.press("\u{E014}");
    assert_eq!(browser.run("return document.querySelector('[name=step]').value"), json!("1"));
    browser.press(" ");
    assert_eq!(
        browser.run("return document.querySelector('[name=play]').getAttribute('aria-pressed')"),
        json!("true")
    );
    browser.wait("return Number(document.querySelector('[name=step]').value) > 2");
}

/// What takes part in the page without a name that a screen reader could say.
const NAMELESS: &str = "
    const named = (element) => (element.getAttribute('aria-label') || element.textContent || element.alt || '').trim() || element.labels?.length;
    return [...document.querySelectorAll('button, input, select, canvas, img, output')]
        .filter((element) => element.tagName !== 'OUTPUT' && !(element.tagName === 'CANVAS' && element.closest('.uplot')))
        .filter((element) => !named(element)).map((element) => element.outerHTML.slice(0, 120))";

#[test]
fn everything_has_a_name_and_no_page_is_wider_than_a_narrow_screen() {
    let Some(browser) = Browser::open([390, 844]) else { return };
    for name in committed() {
        browser.go(&page(&name), "claims");
        assert_eq!(browser.run(NAMELESS), json!([]), "{name}");
        let width = browser.run("return document.documentElement.scrollWidth");
        assert!(width.as_u64().unwrap() <= 390, "{name} is {width} wide");
        browser.run("document.querySelectorAll('details').forEach((part) => (part.open = true))");
        let width = browser.run("return document.documentElement.scrollWidth");
        assert!(width.as_u64().unwrap() <= 390, "{name} unfolded is {width} wide");
        let cut = "return [...document.querySelectorAll('caption span')].filter((text) => text.getBoundingClientRect().right > 390).length";
        assert_eq!(browser.run(cut), json!(0), "{name}: captions are cut off");
        browser.picture(&format!("{name}-390"));
        assert_eq!(browser.console(), Value::Array(Vec::new()), "{name}");
    }
}

/// Where the counts and the headline claims end, and how many of the page's parts are open.
const FIRST_SCREEN: &str = "
    const end = (element) => element.getBoundingClientRect().bottom;
    const counts = [...document.querySelectorAll('header > p')].find((line) => line.querySelector('.class'));
    return [end(counts), end(document.querySelector('header ul')), document.querySelectorAll('section > details[open]').length,
        document.querySelectorAll('section > details').length]";

#[test]
fn the_first_screen_holds_headline_and_counts_and_a_narrow_one_folds_the_rest() {
    for [width, height] in [[1400, 900], [390, 844]] {
        let Some(browser) = Browser::open([width, height]) else { return };
        for name in committed() {
            browser.go(&page(&name), "");
            let found: Vec<f64> = serde_json::from_value(browser.run(FIRST_SCREEN)).unwrap();
            let [counts, headlines, open, all] = found[..] else { panic!("{name}: {found:?}") };
            assert!(counts < f64::from(height) && all >= 1.0, "{name} at {width}: {found:?}");
            if width < 600 {
                assert!(open == 0.0, "{name} at {width}: {found:?}");
            } else {
                assert!(headlines < f64::from(height) && open == all, "{name} at {width}: {found:?}");
            }
            browser.picture(&format!("{name}-first-{width}"));
        }
    }
}

#[test]
fn links_lead_to_what_they_name_just_below_the_menu() {
    for [width, height] in [[1280, 800], [390, 844]] {
        let Some(browser) = Browser::open([width, height]) else { return };
        for name in ["zhang", "fu2018", "theta"] {
            let file = page(name);
            let links = links_of(&browser, &file);
            assert!(links.len() > 8, "{links:?}");
            for link in links {
                browser.go(&file, "");
                browser.run(&format!("document.querySelector('a[href=\"#{link}\"]').click()"));
                let below = format!(
                    "const gap = document.getElementById('{link}').getBoundingClientRect().top \
                     - document.querySelector('nav').getBoundingClientRect().bottom; return gap > -1 && gap < 40"
                );
                browser.wait(&below);
            }
            assert_eq!(browser.console(), json!([]), "{name}");
        }
    }
}

/// What the menu and the headline claims link to in the page.
fn links_of(browser: &Browser, file: &Path) -> Vec<String> {
    browser.go(file, "");
    let links = browser.run(
        "return [...document.querySelectorAll('nav a, header li a')].map((link) => link.hash.slice(1)).filter(Boolean)",
    );
    serde_json::from_value(links).unwrap()
}
