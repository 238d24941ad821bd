//! Arms in their cell in three dimensions: beside each other, in step, with clearance and contact, under one camera.

use super::driver::Browser;
use super::{packed, page};
use crate::paper::Bench;
use serde_json::{Value, json};
use std::path::Path;

/// A query that both algorithms solve, by ways of different lengths.
const TRIAL: &str = "length/cell/0/10/improved-a-star";
const LABELS: [&str; 2] = ["Original A*", "Improved A*"];

fn texts(browser: &Browser, css: &str) -> Vec<String> {
    let script = format!("return [...document.querySelectorAll('{css}')].map((found) => found.textContent)");
    serde_json::from_value(browser.run(&script)).unwrap()
}

/// The pixels of each canvas.
fn pixels(browser: &Browser) -> Vec<String> {
    let script = "return [...document.querySelectorAll('.stage canvas')].map((canvas) => canvas.toDataURL())";
    serde_json::from_value(browser.run(script)).unwrap()
}

fn replay(page: &Path, trial: &str) -> Value {
    let is_it = |replay: &Value| replay["trials"].as_array().unwrap().contains(&json!(trial));
    packed(page, "replay").into_iter().find(is_it).unwrap()
}

/// The frame of a lane of `count` frames at `step` of `steps`.
fn frame(step: usize, steps: usize, count: usize) -> usize {
    (step as f64 / steps as f64 * (count - 1) as f64).round() as usize
}

#[test]
fn original_and_improved_stand_side_by_side_in_step_with_their_clearance() {
    let Some(browser) = Browser::open([1280, 800]) else { return };
    let file = page("fu2018");
    let replay = replay(&file, TRIAL);
    let lane =
        |at: usize| -> Vec<f64> { serde_json::from_value(replay["lanes"][at]["clearance"].clone()).unwrap() };
    let clearances = [lane(0), lane(1)];
    assert_ne!(clearances[0].len(), clearances[1].len(), "ways of equal length show no step");
    let steps = clearances.iter().map(Vec::len).max().unwrap() - 1;
    let mut before: Vec<Vec<String>> = Vec::new();
    for step in [0, steps / 3, 2 * steps / 3, steps] {
        browser.go(&file, &format!("replay={TRIAL}&step={step}"));
        browser.wait(&format!("return document.querySelector('[name=step]').value === '{step}'"));
        let text = texts(&browser, ".stage figcaption");
        assert_eq!(text.len(), 2, "{text:?}");
        for ((text, label), clearance) in text.iter().zip(LABELS).zip(&clearances) {
            let now = clearance[frame(step, steps, clearance.len())];
            assert!(text.starts_with(&format!("{label}: ")), "{text}");
            assert!(text.ends_with(&format!(", clearance {now:.1} mm")), "step {step}: {text}, not {now}");
        }
        let pixels = pixels(&browser);
        assert_eq!(pixels.len(), 2);
        assert!(pixels[0] != pixels[1], "one arm is drawn twice");
        for at in 0..2 {
            assert!(before.iter().all(|old| old[at] != pixels[at]), "{} stands still at {step}", LABELS[at]);
        }
        before.push(pixels);
    }
    // Both begin and end at the poses of the query, at the first and the last step.
    let ends = |at: usize| [clearances[at][0], *clearances[at].last().unwrap()];
    assert_eq!(ends(0), ends(1));
    browser.picture("fu2018-replay-1280");
    assert_eq!(browser.console(), json!([]));
}

#[test]
fn one_camera_turns_all_arms_by_pointer_and_by_keys() {
    let Some(browser) = Browser::open([1280, 800]) else { return };
    browser.go(&page("fu2018"), &format!("replay={TRIAL}&step=30"));
    let first = pixels(&browser);
    let differs = |from: &[String], what: &str| {
        let now = pixels(&browser);
        for at in 0..2 {
            // Not `assert_ne`, which would print all pixels.
            assert!(from[at] != now[at], "{what} does not turn {}", LABELS[at]);
        }
        now
    };
    // A reader scrolls past the arms; the wheel zooms only where a canvas has the focus.
    let top = || browser.run("return Math.round(scrollY)").as_i64().unwrap();
    let before = top();
    browser.scroll(".stage canvas", 60);
    assert!(top() > before && pixels(&browser) == first, "the page stands still at {before}");
    browser.run("document.querySelector('.stage canvas').focus()");
    // Twenty-four presses go all the way round: a camera that only moved aside would not come back.
    browser.press("\u{E012}");
    differs(&first, "an arrow key");
    (1..24).for_each(|_| browser.press("\u{E012}"));
    assert!(pixels(&browser) == first, "a whole turn does not come back");
    browser.press("\u{E013}");
    let raised = differs(&first, "the arrow up");
    browser.point(".stage canvas", &[[0, 0], [60, 0], [120, 30]], true);
    differs(&raised, "the pointer");
    browser.picture("fu2018-turned-1280");
    assert_eq!(browser.console(), json!([]));
}

/// How many pixels of each canvas are of the colour of contact.
const RED: &str = "return [...document.querySelectorAll('.stage canvas')].map((canvas) => {
    const flat = Object.assign(document.createElement('canvas'), { width: canvas.width, height: canvas.height });
    const pen = flat.getContext('2d');
    pen.drawImage(canvas, 0, 0);
    const { data } = pen.getImageData(0, 0, flat.width, flat.height);
    let count = 0;
    for (let at = 0; at < data.length; at += 4) count += data[at] > 100 && data[at + 1] < 0.15 * data[at] && data[at + 2] < 0.15 * data[at];
    return count;
})";

#[test]
fn an_arm_in_contact_turns_red_and_a_replay_is_opened_from_a_file() {
    let bench = Bench::empty();
    let Some(browser) = Browser::open([1280, 800]) else { return };
    let file = page("fu2018");
    let is_moving = |replay: &Value| replay["lanes"][0]["clearance"].as_array().unwrap().len() == 100;
    let mut replay = packed(&file, "replay").into_iter().find(is_moving).unwrap();
    // What is stored was found free by the verifier: contact is put in by hand.
    replay["lanes"][0]["clearance"][40] = json!(-0.5);
    bench.write("touching.json", replay.to_string().as_bytes());
    browser.go(&file, "replays");
    browser.choose("#more", &bench.at("touching.json"));
    browser.wait("return document.querySelectorAll('.stage canvas').length === 2");
    let at = |step: usize| -> ([u64; 2], String) {
        browser.run(&format!(
            "const step = document.querySelector('[name=step]'); step.value = {step}; step.dispatchEvent(new Event('input'))"
        ));
        (serde_json::from_value(browser.run(RED)).unwrap(), texts(&browser, ".stage figcaption").remove(0))
    };
    for step in [39, 40, 41] {
        let ([red, other], message) = at(step);
        let is_touching = step == 40;
        assert_eq!(message.ends_with(", in contact"), is_touching, "{step}: {message}");
        assert_eq!(
            (red > 500, other),
            (is_touching, 0),
            "step {step}: {red} red pixels, {other} of the other"
        );
    }
    bench.write("broken.json", b"{ \"kind\": \"arm\"");
    browser.choose("#more", &bench.at("broken.json"));
    browser.wait("return document.querySelector('.controls output').textContent.startsWith('broken.json is no replay: ')");
    assert_eq!(browser.console(), json!([]));
}

#[test]
fn one_that_finds_no_path_stands_beside_the_one_that_does() {
    let Some(browser) = Browser::open([1280, 800]) else { return };
    browser.go(&page("fu2018"), "replay=length/cell/0/1/improved-a-star&step=20");
    let text = texts(&browser, ".stage figcaption");
    assert!(text[0] == "Original A*: no path" && text[1].starts_with("Improved A*: "), "{text:?}");
    assert!(texts(&browser, ".controls output")[0].contains("Original A*: no path"));
    assert_eq!(browser.console(), json!([]));
}
