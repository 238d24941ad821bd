//! Annotations that contradict each other or themselves, and their messages.

use crate::wording::refused;
use replan_audit::reader::{Format, read};
/// Annotations of one column that contradict themselves, each with how the fault begins.
const CONTRADICTORY: [(&str, &str); 12] = [
    (
        "% of 250, n=40",
        "1:2: `% of 250` and `n=40` contradict each other: both say how many values there are",
    ),
    (
        "mean, sd, n=4",
        "1:2: `mean` and `sd` contradict each other: both say what kind of number the column holds",
    ),
    ("mean, least=5, most=1", "1:2: `mean, least=5, most=1` contradicts itself: least=5 is above most=1"),
    ("mean, binary, most=2", "1:2: `binary` and `most=2` contradict each other: both say the greatest value"),
    (
        "mean, integers, tick=1/4",
        "1:2: `integers` and `tick=1/4` contradict each other: both say what values",
    ),
    (
        "sd, sample, population",
        "1:2: `sample` and `population` contradict each other: both say how a deviation",
    ),
    ("% of 20, ±sd, ±se", "1:2: `±sd` and `±se` contradict each other: both say what stands after ±"),
    ("mean, rounding=floor, rounding=ceiling", "1:2: `rounding=floor` and `rounding=ceiling` contradict"),
    ("% of 20, integers", "1:2: `% of 20, integers` contradicts itself: behind a share every value is 0 or"),
    ("mean, seeds=10", "1:2: `mean, seeds=10` contradicts itself: `seeds=S` is for shares"),
    ("mean s, unit=ms", "1:2: `mean s` and `unit=ms` contradict each other: both say the unit"),
    (
        "value, from=0:0, from=1:1",
        "1:2: `from=0:0` and `from=1:1` contradict each other: both say where paths",
    ),
];

/// Annotations that say one thing twice, or things that only look as if they were against each other.
const CONSISTENT: [&str; 5] = [
    "% of 250, n=250",
    "rises, anytime",
    "binary, integers",
    "a+b√2, step=2, value",
    "% of 25, seeds=10, ±sd",
];

#[test]
fn annotations_that_contradict_themselves_are_refused_and_not_called_impossible() {
    for (annotation, expected) in CONTRADICTORY {
        let found = refused(&format!("p,x [{annotation}]\nA,2\n"), Format::Csv);
        assert!(found.starts_with(expected), "{annotation}: {found}");
    }
    for fine in CONSISTENT {
        read(&format!("p,x [{fine}]\nA,2\n"), Format::Csv)
            .unwrap_or_else(|faults| panic!("{fine}: {faults:?}"));
    }
    let columns = "p,x [mean, n=50],x [sd, n=40]\nA,2,1\n";
    let expected = "1:3: `x [mean, n=50]` and `x [sd, n=40]` contradict each other: both say how many values there are, and they \
                are statistics of the same values";
    assert!(refused(columns, Format::Csv).starts_with(expected), "{}", refused(columns, Format::Csv));
    let units = refused("p,x [mean s, n=50],x [sd ms]\nA,2,1\n", Format::Csv);
    assert!(units.contains("both say the unit"), "{units}");
    let parts = refused("p,a [% of 40, parts=w],b [% of 50, parts=w]\nA,60,40\n", Format::Csv);
    assert!(parts.contains("how many values there are, and they are parts of one whole"), "{parts}");
    for keys in [
        "check = \"grim\"\nvalue = \"2\"\nn = 4\nleast = 5\nmost = 1",
        "check = \"grimmer\"\nmean = \"2\"\nsd = \"1\"\nn = 4\nleast = 5\nmost = 1",
    ] {
        let found = refused(&format!("[[relation]]\n{keys}\n"), Format::Toml);
        assert!(found.contains("least=5 is above most=1"), "{found}");
    }
    let cell = refused("p,time [mean ms]\nA,1.2 s\n", Format::Csv);
    assert!(
        cell.starts_with("2:2: column `time`: `1.2 s` has the unit s, and its header the unit ms"),
        "{cell}"
    );
}
