//! Seeded corruptions are caught as often as the power that is stated says.

use crate::report::audited;
use proofs::printed::Printed;
use rand::{RngExt, SeedableRng, rngs::SmallRng};
use replan_audit::checks::REGISTRY;
use replan_audit::reader::Format;
use replan_audit::report::{Class, Finding, Options};
use std::collections::BTreeSet;

/// Inputs that data can print, with the place of the number that is to be corrupted. Each belongs to one check.
const WHOLE: [(&str, &str); 30] = [
    ("grim", "[[sample]]\nname = \"x\"\nis = \"% of 250\"\nmean = \"{33.2}\"\n"),
    ("grim", "[[sample]]\nname = \"x\"\nis = \"integers, n=20\"\nmean = \"{3.45}\"\n"),
    ("grimmer", "[[sample]]\nname = \"x\"\nis = \"integers, n=5\"\nmean = \"2.40\"\nsd = \"{1.14}\"\n"),
    ("seed_spread", "[[sample]]\nname = \"x\"\nis = \"% of 25, seeds=10\"\nmean = \"1.2\"\nsd = \"{1.9}\"\n"),
    ("debit", "[[sample]]\nname = \"x\"\nis = \"share of 40\"\nmean = \"0.25\"\nsd = \"{0.44}\"\n"),
    ("quantile", "[[sample]]\nname = \"x\"\nis = \"integers, n=608, quantiles=linear\"\nq25 = \"{73.25}\"\n"),
    (
        "reduction",
        "[[relation]]\ncheck = \"reduction\"\npercent = \"{7.1}\"\nfrom = \"17.65\"\nto = \"16.40\"\n",
    ),
    ("summary", "[[relation]]\ncheck = \"summary\"\nvalue = \"{55.0}\"\nparts = [\"50.0\", \"60.0\"]\n"),
    (
        "sum_of_means",
        "[[relation]]\ncheck = \"sum_of_means\"\ntotal = \"{9.0}\"\nparts = [\"4.0\", \"5.0\"]\n",
    ),
    ("lattice", "[[relation]]\ncheck = \"lattice\"\nvalue = \"{14.65}\"\nfrom = \"22:15\"\nto = \"26:28\"\n"),
    ("clock", "[[relation]]\ncheck = \"clock\"\nvalue = \"{0.0156}\"\ntick = \"1/64\"\n"),
    ("expansions", "[[relation]]\ncheck = \"expansions\"\nvalue = \"{870}\"\nfree = 900\n"),
    (
        "interval",
        "[[relation]]\ncheck = \"interval\"\nlow = \"{91.5}\"\nhigh = \"99.4\"\nk = 97\nn = 100\nmethod = \"clopper_pearson\"\n",
    ),
    ("order", "[[sample]]\nname = \"x\"\nmedian = \"{3.0}\"\nq75 = \"4.0\"\n"),
    (
        "path_bound",
        "[[relation]]\ncheck = \"path_bound\"\nvalue = \"{14.65}\"\nfrom = \"22:15\"\nto = \"26:28\"\n",
    ),
    ("ratio", "[[relation]]\ncheck = \"ratio\"\nvalue = \"{2.1}\"\nof = \"3.1\"\nover = \"1.5\"\n"),
    (
        "ratio_label",
        "[[table]]\nname = \"t\"\ntext = \"\"\"\n| [statistic] | a [n=100] | b [n=100] | r [n=100, ratio=a/b] |\n|-|-|-|-|\n\
         | 25% | 2.0 | 100 | {0.010} |\n| 75% | 4.0 | 300 | 0.200 |\n\"\"\"\n",
    ),
    (
        "rises",
        "[[table]]\nname = \"t\"\ntext = \"\"\"\n| samples [samples] | success [%, anytime] |\n|-|-|\n\
         | 100 | 88.0 |\n| 200 | {90.0} |\n\"\"\"\n",
    ),
    ("sd_range", "[[sample]]\nname = \"x\"\nmean = \"1.2\"\nsd = \"{0.7}\"\nmin = \"1.0\"\nmax = \"4.0\"\n"),
    ("shares_sum", "[[relation]]\ncheck = \"shares_sum\"\nparts = [\"{50.1}\", \"30.2\", \"19.7\"]\n"),
    ("speedup", "[[relation]]\ncheck = \"speedup\"\ntimes = \"{2.0}\"\nbefore = \"10.0\"\nafter = \"5.0\"\n"),
    (
        "total_over_mean",
        "[[relation]]\ncheck = \"total_over_mean\"\ntotal = \"{100.0}\"\nmean = \"2.50\"\nn = 40\n",
    ),
    (
        "turn_sum",
        "[[relation]]\ncheck = \"turn_sum\"\nturns = \"{90}\"\nlength = \"6.24\"\nfrom = \"0:0\"\nto = \"3:5\"\n",
    ),
    (
        "grimmer",
        "[[sample]]\nname = \"x\"\nis = \"integers, n=3, population\"\nmean = \"5.0\"\nsd = \"{1.41}\"\n",
    ),
    (
        "grimmer",
        "[[sample]]\nname = \"x\"\nis = \"integers, n=5, sample\"\nmean = \"2.40\"\nsd = \"{1.14}\"\nmin = \"1\"\nmax = \"4\"\n",
    ),
    ("grim", "[[sample]]\nname = \"x\"\nis = \"integers, n=699, digits=6\"\nmean = \"{67.4077}\"\n"),
    (
        "bold",
        "[[table]]\nname = \"t\"\ntext = \"\"\"\n| a | cost [value, lower is better] |\n|-|-|\n| A | **{2.0}** |\n| B | 3.0 |\n\"\"\"\n",
    ),
    ("p_value", "[[relation]]\ncheck = \"p_value\"\np = \"{0.65}\"\nk1 = 90\nn1 = 100\nk2 = 88\nn2 = 100\n"),
    (
        "any_angle_turns",
        "[[relation]]\ncheck = \"any_angle_turns\"\nturns = \"{90.00}\"\nlength = \"4.00\"\nfrom = \"0:0\"\nto = \"2:2\"\n\
         angles = \"exterior\"\n",
    ),
    (
        "seed_spread",
        "[[sample]]\nname = \"x\"\nis = \"% of 25, seeds=10, sample\"\nmean = \"1.2\"\nsd = \"{3.79}\"\n",
    ),
];

/// Whether `found` is of `check` and speaks against the number under every rounding.
fn is_refused(found: &Finding, check: &str) -> bool {
    found.check == check
        && found.class < Class::Unchecked
        && !found.text.contains("not if digits are rounded to nearest")
}

#[test]
fn corrupted_numbers_are_caught_as_often_as_the_power_says() {
    let options = Options { keeps_possible: true, ..Options::default() };
    let fast = Options { skips_power: true, ..Options::default() };
    let mut rng = SmallRng::seed_from_u64(21);
    let checked: BTreeSet<&str> = WHOLE.iter().map(|(check, _)| *check).collect();
    assert!(REGISTRY.iter().all(|entry| checked.contains(entry.name)), "{checked:?}");
    for (check, text) in WHOLE {
        let (before, rest) = text.split_once('{').unwrap();
        let (value, after) = rest.split_once('}').unwrap();
        let report = audited(&format!("{before}{value}{after}"), Format::Toml, &options);
        assert!(!report.has_impossible(), "{text}");
        let power = report.findings.iter().find(|found| found.check == check).unwrap().power.unwrap();
        let is_sparse = text.contains("digits=6");
        let first: Printed = value.parse().unwrap();
        let first = if is_sparse { first.with_zeros_left_out(6).unwrap() } else { first };
        // Each polyline is a search.
        let tries = if check == "any_angle_turns" { 100 } else { 2000 };
        let mut tried = 0;
        let mut caught = 0;
        for _ in 0..tries {
            let units = rng.random_range(power.low.units()..=power.high.units());
            let Some(print) = first.with_units(units) else { continue };
            tried += 1;
            let report = audited(&format!("{before}{print}{after}"), Format::Toml, &fast);
            caught += u32::from(report.findings.iter().any(|found| is_refused(found, check)));
        }
        let share = f64::from(caught) / f64::from(tried);
        let stated = power.share();
        // A share that a sample shows as 1 is likely a little less.
        let likely = (power.refused as f64 + 1.0) / (power.tried as f64 + 2.0);
        // Four standard errors of a share of 2000, and of the sample that power is computed from.
        let margin =
            4.0 * (likely * (1.0 - likely) * (1.0 / f64::from(tried) + 1.0 / power.tried as f64)).sqrt();
        assert!(
            (share - stated).abs() <= margin + 1e-9,
            "{check}: {share} caught, {stated} stated, margin {margin}"
        );
        assert!(stated > 0.05, "{check} refuses {stated} here, so the test shows nothing");
    }
}
