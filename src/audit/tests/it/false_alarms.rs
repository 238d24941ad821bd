//! Tables that people print and that are possible, but look impossible to a careless reader.

use crate::report::audited;
use proofs::printed::Printed;
use replan_audit::output;
use replan_audit::reader::{Format, read};
use replan_audit::report::{Class, Options, Report, audit};

fn report_on(text: &str) -> Report {
    let format = if text.starts_with('|') { Format::Markdown } else { Format::Csv };
    audited(text, format, &Options { skips_power: true, ..Options::default() })
}

/// Every class that was found.
fn classes(text: &str) -> Vec<Class> {
    report_on(text).findings.iter().map(|finding| finding.class).collect()
}

/// The first fault of a table that cannot be read.
fn fault(text: &str) -> String {
    let faults = read(text, Format::Csv).and_then(|input| audit(&input, &Options::default())).unwrap_err();
    faults[0].to_string()
}

#[test]
fn a_statistic_that_is_not_known_is_reported_with_its_row() {
    let text = "s [statistic],time\nmean,5.0\n110%,4.0\nmax,7\ncount,3\n110%,-\n";
    let report = report_on(text);
    let lines = output::unseen("t", &report);
    let known = "there are mean, sd, se, min, q1, median, q3, max, total, and quantiles as 5% or q95";
    let expected = ["110%", "count"].map(|row| {
        let line = if row == "count" { 5 } else { 3 };
        format!("t:{line}:1: row `{row}`: no check looked at it; no statistic is called so; {known}")
    });
    assert_eq!(lines, expected);
    assert!(report.findings.is_empty() && report.tally["order"].applied == 1, "{report:?}");
    assert_eq!(output::unseen("t", &report_on("s [statistic],time\nmean,5.0\nmax,7\nn/a,-\n")), [""; 0]);
}

#[test]
fn a_header_with_a_statistic_that_is_not_known_is_no_mean() {
    for name in ["time 110%", "nodes variance (n=50)", "time p95", "time 95th", "nodes geometric mean (n=9)"]
    {
        let input = read(&format!("p,{name}\nA,5.37\n"), Format::Csv).unwrap();
        let annotation = &input.tables[0].columns[1].annotation;
        assert!(annotation.starts_with("value"), "{name}: {annotation}");
        let report = audit(&input, &Options::default()).unwrap();
        assert!(report.tally.is_empty(), "{name}: {report:?}");
        assert!(output::unseen("t", &report)[0].contains(&format!("column `{name}`: no check looked at it")));
    }
    assert!(fault("p,time [110%]\nA,5\n").starts_with("1:2: `110%` is no item of an annotation"));
}

#[test]
fn words_that_may_name_methods_are_a_guess_and_no_proof() {
    let pooled = "pooling,success\nmean,85.0\nmax,80.1\nsum,84.2\n";
    assert_eq!(classes(pooled), [Class::Signal; 2]);
    assert!(
        report_on(pooled).findings[0]
            .premises
            .last()
            .unwrap()
            .contains("`pooling` is `statistic` was guessed")
    );
    assert_eq!(classes(&pooled.replace("pooling", "pooling [statistic]")), [Class::Impossible; 2]);
    // Shares are printed as quantiles are called.
    assert_eq!(classes("success,length\n50%,5\n75%,4\n95%,3\n"), []);
}

#[test]
fn a_row_that_sums_up_the_others_is_no_proof() {
    let table = |row: &str| format!("planner,success [% of 250]\nA,33.2\nB,33.5\n{row}\n");
    assert_eq!(classes(&table("C,33.35")), [Class::Impossible; 2]);
    for name in ["Average", "mean", "Overall"] {
        assert_eq!(
            classes(&table(&format!("{name},33.35"))),
            [Class::Impossible],
            "B is refused, and {name} is right"
        );
        let wrong = format!("{name},33.75");
        assert_eq!(classes(&table(&wrong)), [Class::Impossible, Class::Signal, Class::Signal]);
        let premises = report_on(&table(&wrong)).findings.into_iter().flat_map(|found| found.premises);
        let start = format!("the row `{name}` is one like the others");
        assert_eq!(premises.filter(|premise| premise.starts_with(&start)).count(), 1);
    }
}

#[test]
fn a_name_of_two_columns_or_rows_is_not_taken_for_the_first() {
    let sides =
        "p,a [value],b [value],t [value, sum=a+b],a [value],b [value],t [value, sum=a+b]\nA,1,2,3,5,6,11\n";
    let expected =
        "1:4: column `t` names the column `a`, which stands 2 times; a name that stands once is accepted";
    assert_eq!(fault(sides), expected);
    let counts = "p,n [value],x [mean, integers, n=n],n [value],y [mean, integers, n=n]\nA,3,2.33,4,2.25\n";
    assert!(fault(counts).starts_with("1:3: column `x` names the column `n`, which stands 2 times"));
    // A name that a deviation has as well names the mean.
    let spread = "p,a [sd],a [mean],b [mean],t [mean, sum=a+b]\nA,9.0,1.0,2.0,3.0\n";
    assert_eq!((classes(spread), report_on(spread).tally["sum_of_means"].applied), (vec![], 1));
    let relation = "[[table]]\nname = \"t\"\ntext = \"\"\"\n| map | planner | time [value] |\n|-|-|-|\n| M | A | 3.0 |\n| M | B | 6.0 |\n\
                    \"\"\"\n[[relation]]\ncheck = \"ratio\"\nvalue = \"2.0\"\nof = \"t/M/time\"\nover = \"3.0\"\n";
    let faults = audit(&read(relation, Format::Toml).unwrap(), &Options::default()).unwrap_err();
    let expected = "`of` is `t/M/time`, which names 2 cells; a name that stands once is accepted";
    assert!(faults[0].message.ends_with(expected), "{}", faults[0]);
}

#[test]
fn success_is_to_rise_for_one_planner_on_one_map() {
    let table = "map,planner,samples [samples],success [%, anytime]\nM,A,100,90\nM,B,200,50\nM,A,200,95\n";
    assert_eq!((classes(table), report_on(table).tally["rises"].applied), (vec![], 1));
    assert_eq!(classes(&table.replace("M,A,200,95", "M,A,200,60")), [Class::Impossible]);
}

#[test]
fn quotients_are_held_against_the_values_of_their_own_contender() {
    let rows = |who: &str, values: [&str; 2]| format!("{who},25%,{}\n{who},75%,{}\n", values[0], values[1]);
    let head = "p,s [statistic],a [n=100],b [n=100],r [n=100, ratio=a/b]\n";
    let a = rows("A", ["2.0,100,0.010", "4.0,300,0.200"]);
    // Were the quotients of A those of B's values, no problem could have them.
    let b = rows("B", ["0.002,100,-", "0.004,300,-"]);
    assert_eq!(classes(&format!("{head}{a}{b}")), []);
    let wrong = rows("A", ["0.002,100,0.010", "0.004,300,0.200"]);
    assert_eq!(classes(&format!("{head}{wrong}{b}")), [Class::Impossible]);
}

#[test]
fn units_in_names_are_units() {
    let mixed = "p,time (ms) [mean, of=time],time (s) [max, of=time]\nA,950,1.2\n";
    assert!(fault(mixed).contains("contradict each other: both say the unit"), "{}", fault(mixed));
    let sum = "p,plan (ms) [value],check (us) [value],all (ms) [value, sum=plan (ms)+check (us)]\nA,100.0,2,100.0\n";
    assert!(fault(sum).contains("in the unit ms and in the unit us"), "{}", fault(sum));
    let alike = "p,time (ms) [mean, of=time],most (ms) [max, of=time],x (min) [min, of=time]\nA,950,1200,3\n";
    assert_eq!(classes(alike), []);
}

#[test]
fn emphasis_hides_no_number() {
    let table = "| p | success [% of 250] |\n|-|-|\n| A | *33.2* |\n| B | _33.6_ |\n| C | <u>34.0</u> |\n| D | \\underline{33.5} |\n";
    let report = report_on(table);
    assert_eq!((report.tally["grim"].applied, report.tally["grim"].impossible), (4, 1));
}

/// What a program prints that cuts `value` to `decimals` places, or raises it to them, in floats.
fn ended(value: f64, decimals: i32, is_raised: bool) -> String {
    let scaled = value * 10_f64.powi(decimals);
    let units = if is_raised { scaled.ceil() } else { scaled.floor() } as i64;
    Printed::from_units(units, decimals as u32).to_string()
}

#[test]
fn what_floats_cut_short_is_no_proof() {
    let mut tried = 0;
    let mut doubted = 0;
    for n in 1..=100_u32 {
        for k in 0..=n {
            for (decimals, is_raised) in [(0, false), (1, false), (2, false), (0, true), (1, true), (2, true)]
            {
                let mean = f64::from(k) / f64::from(n);
                let cells = [ended(mean * 100.0, decimals, is_raised), ended(mean, decimals + 2, is_raised)];
                let text =
                    format!("share [% of {n}],mean [mean, integers, n={n}]\n{},{}\n", cells[0], cells[1]);
                let report = report_on(&text);
                assert!(!report.has_impossible(), "{k} of {n}\n{text}{report:?}");
                tried += 1;
                doubted +=
                    usize::from(report.findings.iter().any(|found| found.text.contains("floats make of")));
            }
        }
    }
    assert!(doubted > 50, "{doubted} of {tried} tables show nothing");
    // Two ways to compute 0.58 × 100 in floats are 57.99999999999999 and 58; nothing makes 57 of it by rounding to nearest.
    let cut = report_on("share [% of 50]\n57\n").findings.remove(0);
    assert_eq!(cut.class, Class::Signal);
    let expected = "no proof: a program that cuts off or rounds up 57.99999999999999, which floats make of 58, prints it";
    assert!(cut.text.ends_with(expected), "{}", cut.text);
    assert_eq!(classes("share [% of 50, rounding=nearest]\n57\n"), [Class::Impossible]);
    assert_eq!(classes("share [% of 50]\n51\n"), [Class::Impossible], "nothing makes 51 of 50 or 52");
}
