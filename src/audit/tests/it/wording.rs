//! What findings and remarks say, and what they rest on.

use crate::report::audited;
use replan_audit::input::Input;
use replan_audit::output;
use replan_audit::reader::{Format, read, stub_line};
use replan_audit::report::{Class, Finding, Options, audit};
use replan_audit::witness::Budget;

fn found(text: &str, format: Format, check: &str) -> Finding {
    let report = audited(text, format, &Options { keeps_possible: true, ..Options::default() });
    report.findings.into_iter().find(|finding| finding.check == check).unwrap()
}

#[test]
fn zeros_left_out_are_a_premise_and_the_finding_says_what_the_typed_digits_allow() {
    let table = "| p | time [mean, integers, n=699, digits=6] |\n|-|-|\n| A | 67.408 |\n";
    let finding = found(table, Format::Markdown, "grim");
    assert_eq!(finding.class, Class::Impossible);
    assert!(finding.text.starts_with("67.408 is the mean of no 699 values"), "{}", finding.text);
    assert!(finding.text.ends_with("possible if the digits as typed are all there are"), "{}", finding.text);
    let premise = finding.premises.last().unwrap();
    assert!(
        premise.ends_with("zeros at the end are left out, so that 67.408 is read as 67.4080"),
        "{premise}"
    );
    let certificate = finding.certificate.unwrap();
    let number = &certificate["numbers"][0];
    assert_eq!((&number["printed"], &number["significant"]), (&"67.408".into(), &6.into()));
    assert!(certificate["premises"].to_string().contains("67.4080"));
    assert_eq!(finding.mend.unwrap().to.to_string(), "67.4078");
    let both = found(&table.replace("67.408", "67.4"), Format::Markdown, "grim");
    assert!(both.text.ends_with("; possible if the digits as typed are all there are"), "{}", both.text);
    let neither = found(&table.replace("n=699", "n=2"), Format::Markdown, "grim");
    assert!(
        neither.text.ends_with("; impossible as well if the digits as typed are all there are"),
        "{}",
        neither.text
    );
    let typed = found(&table.replace(", digits=6", ""), Format::Markdown, "grim");
    assert_eq!((typed.class, typed.text.contains("as typed")), (Class::Possible, false));
}

#[test]
fn a_deviation_below_0_is_impossible_without_mean_range_or_n() {
    let column = "p,time [mean],time [sd]\nA,2.0,-0.5\n";
    let behind = "p,time [mean, ±sd]\nA,2.0 ± −0.5\n";
    let error = "p,time [mean],time [se]\nA,2.0,-0.5\n";
    for text in [column, behind, error] {
        let finding = found(text, Format::Csv, "sd_range");
        assert_eq!(
            (finding.class, &*finding.text),
            (Class::Impossible, "-0.5 is below 0, as no deviation is"),
            "{text}"
        );
        assert!(finding.certificate.is_some());
    }
    let ranged = "p,t [mean, integers, n=5],t [sd],t [min],t [max]\nA,2.0,-0.5,1,4\n";
    let report = audited(ranged, Format::Csv, &Options::default());
    assert!(report.findings.iter().all(|finding| finding.class == Class::Impossible), "{report:?}");
}

#[test]
fn printed_ends_bound_the_values_behind_mean_and_deviation() {
    let sample =
        "[[sample]]\nname = \"x\"\nis = \"integers, n=6, population\"\nmean = \"2.00\"\nsd = \"1.15\"\n";
    assert_eq!(found(sample, Format::Toml, "grimmer").class, Class::Possible, "4, 3, 2, 2, 1, 0");
    let ends = |min: &str, max: &str| {
        found(&format!("{sample}min = \"{min}\"\nmax = \"{max}\"\n"), Format::Toml, "grimmer")
    };
    assert_eq!(ends("0", "4").class, Class::Possible);
    let bounded = ends("1", "3");
    assert_eq!(bounded.class, Class::Impossible, "from 1 to 3 the deviation is 1 at most");
    assert!(bounded.text.contains("1 the least and 3 the greatest"), "{}", bounded.text);
    assert_eq!(bounded.certificate.unwrap()["given"]["printed_ends"], serde_json::json!([2, 3]));
}

#[test]
fn a_number_behind_plus_or_minus_that_no_check_looks_at_is_reported() {
    let spreads = |text: &str| output::unread_spreads("t.csv", &read(text, Format::Csv).unwrap());
    let message = spreads("p,rate [% of 20]\nA,-\nB,25 ± 9\n");
    let expected = "t.csv:3:2: column `rate`: what stands behind 25 ± 9 is not looked at; say `±sd` if it is the deviation or `±se` if it is the standard error";
    assert_eq!(message, [expected]);
    assert!(spreads("p,length [value]\nA,2.5 (0.1)\n")[0].contains("`mean, n=N` and `±sd` or `±se`"));
    assert!(spreads("p,length [value, ±sd]\nA,2.5 (0.1)\n")[0].contains("`mean, n=N`"));
    assert!(spreads("s [statistic],time\nmean,2.5 (0.1)\n")[0].contains("a row of its own"));
    for silent in
        ["p,rate [% of 20, ±se]\nA,25 ± 9\n", "p,time [mean, ±sd]\nA,2.5 (0.1)\n", "p,rate [% of 20]\nA,25\n"]
    {
        assert!(spreads(silent).is_empty(), "{silent}");
    }
}

#[test]
fn what_is_not_decided_is_not_worded_as_a_claim() {
    let relation = |keys: &str| format!("[[relation]]\n{keys}\n");
    for (keys, check, expected) in [
        (
            "check = \"turn_sum\"\nturns = \"90\"\nlength = \"6.50\"\nfrom = \"0:0\"\nto = \"3:5\"",
            "turn_sum",
            "not decided: no 8-connected path over (3, 5) cells has the length 6.50 (see `lattice`)",
        ),
        (
            "check = \"ratio\"\nvalue = \"2\"\nof = \"1.0\"\nover = \"0.0\"",
            "ratio",
            "not decided: with a = 1.0 and b = 0.0 a divisor may be 0",
        ),
        (
            "check = \"total_over_mean\"\ntotal = \"1\"\nmean = \"0.0\"",
            "total_over_mean",
            "not decided: the mean 0.0 may be 0",
        ),
        (
            "check = \"any_angle_turns\"\nturns = \"90\"\nlength = \"60\"\nfrom = \"0:0\"\nto = \"3:5\"",
            "any_angle_turns",
            "not decided: a length of 60 is more than 2.5 cells above the straight line",
        ),
        (
            "check = \"grimmer\"\nmean = \"2\"\nsd = \"1\"\nn = 1\ndivisor = \"sample\"",
            "grimmer",
            "not decided: one value has no sample deviation",
        ),
    ] {
        let finding = found(&relation(keys), Format::Toml, check);
        assert_eq!((finding.class, &*finding.text), (Class::Unchecked, expected));
    }
}

#[test]
fn power_names_its_range_and_why() {
    let share =
        found("p,rate [share of 20, ±sd, sample]\nA,0.25 ± 0.44\n", Format::Csv, "debit").power.unwrap();
    // Half of the whole, by the root of 20/19: 0.51299, rounded up.
    assert_eq!((share.low.to_string(), share.high.to_string()), ("0.00".to_owned(), "0.52".to_owned()));
    let ranged = "p,t [mean],t [sd],t [min],t [max]\nA,2.0,1.0,1.0,4.0\n";
    let line = output::line("t.csv", &found(ranged, Format::Csv, "sd_range"));
    assert!(
        line.contains(" values from 0.0 to 2.3, up to the greatest that values between the ends have"),
        "{line}"
    );
}

#[test]
fn a_reduction_names_what_it_is_a_share_of() {
    let text = "[[relation]]\ncheck = \"reduction\"\npercent = \"7.6\"\nfrom = \"17.65\"\nto = \"16.40\"\nbase = \"to\"\n";
    let premise = &found(text, Format::Toml, "reduction").premises[0];
    assert_eq!(premise, "the percentage was computed from the two cells a and b, by 100(a-b)/b");
}

#[test]
fn ways_to_end_digits_that_differ_are_each_a_premise() {
    let table = "p,x [mean, integers, n=4, rounding=half up],x [sd]\nA,2.50,1.29\n";
    let premise = found(table, Format::Csv, "grimmer").premises[1].clone();
    assert!(
        premise.contains("those of standard deviation of x of A end in any usual way")
            && premise.contains("those of mean of x of A end by half up"),
        "{premise}"
    );
}

#[test]
fn a_stub_is_written_as_the_table_is_and_can_be_read() {
    for text in ["\"a, b\",rate\nx,25\n", "a;rate [% of 20, ±sd]\nx;25 ± 3\n", "a\trate\nx\t25\n"] {
        let input = read(text, Format::Csv).unwrap();
        let line = stub_line(&input.tables[0]);
        assert!(!line.contains('|'), "{line}");
        let again = format!("{}\n{}\n", line.replace('?', "20"), text.lines().nth(1).unwrap());
        let read = read(&again, Format::Csv).unwrap_or_else(|faults| panic!("{again}: {faults:?}"));
        let names = |input: &Input| {
            input.tables[0].columns.iter().map(|column| column.name.clone()).collect::<Vec<_>>()
        };
        assert_eq!(names(&read), names(&input));
        assert!(read.tables[0].columns.iter().all(|column| column.written.is_some()));
    }
    let table = "|a|rate|\n|-|-|\n|x|25|\n";
    let line = stub_line(&read(table, Format::Markdown).unwrap().tables[0]);
    assert_eq!(line, "| a [label] | rate [% of ?] |");
}

#[test]
fn a_search_that_ends_without_data_says_so() {
    let text = "[[sample]]\nname = \"x\"\nis = \"integers, n=40, sample\"\nmean = \"2.50\"\nsd = \"1.28\"\n";
    let witness = Some(Budget { most: 5, steps: 3, seed: None });
    let report = audited(text, Format::Toml, &Options { witness, ..Options::default() });
    let finding = report.findings.iter().find(|finding| finding.check == "grimmer").unwrap();
    assert!(
        output::line("t", finding).ends_with("no data found in 3 of 3 steps"),
        "{}",
        output::line("t", finding)
    );
}

#[test]
fn an_end_that_carries_a_proof_is_among_its_premises() {
    for (end, mean, expected) in [("most=2", "2.5", "at most 2"), ("least=1", "0.5", "at least 1")] {
        let table = format!("| p | t [mean, integers, n=10, {end}] |\n|-|-|\n| A | {mean} |\n");
        let finding = found(&table, Format::Markdown, "grim");
        assert_eq!(finding.class, Class::Impossible);
        assert!(finding.premises[0].contains(expected), "{:?}", finding.premises);
    }
}

#[test]
fn a_fall_in_small_steps_shows_against_the_greatest_success_with_fewer_samples() {
    let rows = |from: u32| (0..10).map(move |row| format!("| {} | {} |\n", row + 1, from - row));
    let table = |rows: String| format!("| samples [samples] | success [%, anytime] |\n|-|-|\n{rows}");
    let impossible = |text: &str| {
        let report = audited(text, Format::Markdown, &Options::default());
        report
            .findings
            .iter()
            .filter(|found| found.check == "rises" && found.class == Class::Impossible)
            .count()
    };
    // Digits may be rounded or cut, so that a fall of two units may be none; seven rows fall by more.
    assert_eq!(impossible(&table(rows(90).collect())), 7);
    assert_eq!(impossible(&table(rows(90).take(2).collect())), 0);
}

/// The faults of a text, which cannot be audited.
pub fn refused(text: &str, format: Format) -> String {
    read(text, format).and_then(|input| audit(&input, &Options::default())).unwrap_err()[0].to_string()
}

#[test]
fn a_filled_stub_of_statistics_in_columns_of_their_own_is_checked() {
    let text = "planner,mean,sd,min,max\nA,2.0,3.0,1.0,4.0\n";
    let input = read(text, Format::Csv).unwrap();
    let stub = stub_line(&input.tables[0]);
    let expected = "planner [label],mean [mean, n=?, of=values],sd [sd, n=?, of=values],min [min, n=?, of=values],max [max, n=?, of=values]";
    assert_eq!(stub, expected);
    let filled = text.replace("planner,mean,sd,min,max", &stub.replace('?', "50"));
    let finding = found(&filled, Format::Csv, "sd_range");
    assert_eq!(finding.class, Class::Impossible, "{}", finding.text);
    assert!(finding.name == "sd of A" && finding.premises[0].contains("same"), "{finding:?}");
    let long = "planner,time mean (n = 50),time std,iterations (mean),iterations (max)\nA,2.0,3.0,5,6\n";
    let stub = stub_line(&read(long, Format::Csv).unwrap().tables[0]);
    let expected = "planner [label],time mean (n = 50) [mean, n=50, lower is better, of=time],time std [sd, n=?, of=time],iterations \
                    (mean) [mean, n=?, of=iterations],iterations (max) [max, n=?, of=iterations]";
    assert_eq!(stub, expected);
}

#[test]
fn what_rests_on_a_guess_is_a_signal_and_the_header_makes_it_a_proof() {
    let text = "planner,success (% of 250),Time [s]\nA,33.3,1.2\n";
    let input = read(text, Format::Csv).unwrap();
    assert_eq!(
        stub_line(&input.tables[0]),
        "planner [label],success (% of 250) [% of 250, higher is better],Time [mean, n=?, lower is better, unit=s]"
    );
    let finding = found(text, Format::Csv, "grim");
    assert_eq!((finding.class, finding.certificate), (Class::Signal, None));
    let premise = finding.premises.last().unwrap();
    assert!(premise.contains("`% of 250, higher is better` was guessed"), "{premise}");
    let message = found(&text.replace("(% of 250)", "[% of 250]"), Format::Csv, "grim");
    assert_eq!(message.class, Class::Impossible);
    let runs = read("p,runs,success\nA,30,50.0\nB,-,33.3\n", Format::Csv).unwrap();
    assert_eq!(stub_line(&runs.tables[0]), "p [label],runs [value],success [% of runs, higher is better]");
    let comma = refused("p;success;time\nA;33,3;1.234,5\nB;90,0;2,5\n", Format::Csv);
    assert!(comma.starts_with("2:2: column `success`: `33,3` has a decimal comma"), "{comma}");
    let counts = read("q,solved of 20\nq1,3\nq2,20\nq3,7\n", Format::Csv).unwrap();
    assert_eq!(stub_line(&counts.tables[0]), "q [label],solved of 20 [count of 20, higher is better]");
}

#[test]
fn what_no_check_looked_at_is_reported_with_what_to_write() {
    let unseen = |text: &str| {
        let report = audited(text, Format::Csv, &Options::default());
        (output::unseen("t", &report), report.tally.len())
    };
    let (lines, wanted) = unseen("p,a [mean, n=50],b [sd],c [value],d [% of 20],e\nA,2.0,3.0,1,25,3\n");
    assert_eq!(wanted, 1, "the share is a k of 20");
    let starts: Vec<&str> = lines.iter().map(|line| line.split(": no check").next().unwrap()).collect();
    assert_eq!(starts, ["t:2:2: column `a`", "t:2:3: column `b`", "t:2:4: column `c`", "t:2:6: column `e`"]);
    let (lines, _) = unseen("p,a [mean, n=50]\nA,2.0\n");
    assert!(lines[1].starts_with("t: nothing was looked at, which is no pass"), "{lines:?}");
    assert_eq!(unseen("p,a [% of m],m\nA,25,20\n").0, [""; 0], "a column that holds n is looked at");
    let sample = "[[sample]]\nname = \"x\"\nmean = \"2.0\"\n";
    let lines = output::unseen("t", &audited(sample, Format::Toml, &Options::default()));
    assert!(lines[0].starts_with("t:1: sample `x`: no check looked at it"), "{lines:?}");
}

#[test]
fn a_cause_is_reported_once_with_what_follows_from_it() {
    let text = "p,x [mean, integers, n=10],x [sd],x [median]\nA,3.45,1.2,3\n";
    let report = audited(text, Format::Csv, &Options::default());
    let checks: Vec<&str> = report.findings.iter().map(|finding| finding.check).collect();
    assert_eq!(checks, ["grim"]);
    assert_eq!(report.findings[0].follows, ["grimmer of standard deviation of x of A"]);
    assert_eq!((report.tally["grimmer"].impossible, report.tally["grimmer"].follows), (0, 1));
    // A deviation that no mended mean has is a cause of its own.
    let two = audited(&text.replace("1.2,", "0.01,"), Format::Csv, &Options::default());
    assert_eq!(two.findings.len(), 2, "{two:#?}");
}

#[test]
fn power_beside_a_refusal_is_not_nothing() {
    for text in [
        "p,x [% of 20]\nA,104.0\n",
        "p,x [value, free=900]\nA,1024\n",
        "p,x [mean],x [max]\nA,123456.7,3.1\n",
        "p,x [% of 1000000]\nA,99.99995\n",
    ] {
        for finding in audited(text, Format::Csv, &Options::default()).findings {
            let power = finding.power.unwrap();
            assert!(power.refused > 0 || power.is_beyond, "{text}: {power:?}");
            assert!(!power.to_string().contains("refuses 0 %") || power.is_beyond, "{power}");
        }
    }
}

#[test]
fn a_p_value_may_be_printed_as_a_bound() {
    let relation = |p: &str| {
        format!("[[relation]]\ncheck = \"p_value\"\np = \"{p}\"\nk1 = 90\nn1 = 100\nk2 = 60\nn2 = 100\n")
    };
    for (p, class) in [
        ("< 0.001", Class::Possible),
        ("≤0.05", Class::Possible),
        ("> 0.05", Class::Signal),
        (">=0.5", Class::Signal),
    ] {
        let finding = found(&relation(p), Format::Toml, "p_value");
        assert_eq!(finding.class, class, "{}", finding.text);
    }
    assert!(found(&relation("> 0.05"), Format::Toml, "p_value").text.starts_with("p > 0.05 for 90 of 100"));
    assert!(refused("p,x [value]\nA,<0.1\n", Format::Csv).contains("is a bound and no printed value"));
}

#[test]
fn a_row_without_all_parts_sums_to_nothing_and_a_missing_cell_joins_no_other_sample() {
    let report = audited(
        "p,a [%, parts=w],b [%, parts=w],c [%, parts=w]\nA,50,-,20\n",
        Format::Csv,
        &Options::default(),
    );
    assert!(report.findings.is_empty() && !report.tally.contains_key("shares_sum"), "{report:?}");
    let twice = "p,a [mean],a [min],a [mean],a [min]\nx,-,5,2.0,1\n";
    assert!(
        audited(twice, Format::Csv, &Options::default()).findings.is_empty(),
        "5 is the least of other values"
    );
}
