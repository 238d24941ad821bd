//! The page's curves: values under the pointer.

use super::driver::Browser;
use super::page;
use replan::analysis::verdict::Verdicts;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

/// What the legend of the success curves says: each curve with its value.
const LEGEND: &str = "
    const figure = [...document.querySelectorAll('#curves figure')].find((figure) => figure.textContent.includes('in the reconstructed cell'));
    figure.querySelector('.u-over').id = 'success';
    return Object.fromEntries([...figure.querySelectorAll('.u-series:not(.band)')]
        .map((series) => [series.querySelector('.u-label').textContent, series.querySelector('.u-value').textContent]))";

#[test]
fn success_curves_say_the_values_under_the_pointer() {
    let Some(browser) = Browser::open([1280, 800]) else { return };
    let runs = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/runs/fu2018");
    let verdicts = Verdicts::read(&runs).unwrap();
    browser.go(&page("fu2018"), "curves");
    browser.wait("return document.querySelectorAll('#curves .u-over').length >= 2");
    let legend = || -> BTreeMap<String, String> { serde_json::from_value(browser.run(LEGEND)).unwrap() };
    assert!(legend().values().all(|value| value.chars().all(|c| "-–".contains(c))), "{:?}", legend());
    // A turn of the wheel, after which the page stays where it is put while other parts are drawn.
    browser.scroll("nav", 1);
    browser.run("document.getElementById('success').scrollIntoView({ block: 'center' })");
    let width = browser.run("return document.getElementById('success').clientWidth").as_f64().unwrap();
    for samples in [300, 800, 1400] {
        let share = f64::from(samples - 100) / 1400.0;
        browser.point("#success", &[[0, 0], [((share - 0.5) * width).round() as i32, 20]], false);
        let shown = legend();
        let value = |label: &str| -> f64 {
            let text = shown.get(label).unwrap_or_else(|| panic!("{label}: {shown:?}"));
            text.split(' ')
                .next()
                .unwrap()
                .replace(',', "")
                .parse()
                .unwrap_or_else(|_| panic!("{label}: {text}"))
        };
        assert_eq!(value("samples N"), f64::from(samples));
        for (row, label) in [("original", "Original A*"), ("improved", "Improved A*")] {
            let judged = verdicts.claim(&format!("t2.{row}.{samples}")).unwrap();
            let ours = judged.ours().unwrap().value;
            let found = value(label);
            assert!((ours - found).abs() < 0.01, "{label}, {samples}: {found} on the page, {ours} as judged");
            let printed: f64 = judged.printed.as_ref().unwrap().parse().unwrap();
            assert_eq!(value(&format!("{label}: printed")), printed, "{label}, {samples}");
            let band = &shown[label];
            assert!(band.contains(" [") && band.ends_with(']'), "{band}");
        }
    }
    browser.picture("fu2018-curves-1280");
    assert_eq!(browser.console(), Value::Array(Vec::new()));
}
