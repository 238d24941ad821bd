//! The audit of tables, from their text to the findings, in processor time: what a pre-commit hook waits for, and a long table.

use criterion::{Bencher, Criterion, criterion_group, criterion_main};
use replan_audit::reader::{Format, read};
use replan_audit::report::{Options, Report, audit};
use std::fs;
use std::hint::black_box;
use std::time::Duration;

/// Twenty rows of the usual columns; some shares are no k of 250, so that mends are searched for as well.
fn usual() -> String {
    let mut text = "| planner | success [% of 250] | time [mean, integers, n=50] | time [sd] | length [a+b√2] |\n|-|-|-|-|-|\n".to_owned();
    for row in 0..20 {
        let percent = 50.0 + 1.7 * f64::from(row);
        let length = 20.0 + 1.37 * f64::from(row);
        text += &format!("| p{row} | {percent:.1} | {}.48 | 3.{row:02} | {length:.2} |\n", 10 + row);
    }
    text
}

/// Shares of 250 that can be.
fn long(rows: u32) -> String {
    let cells = (0..rows).map(|row| format!("p{row},{:.1}\n", f64::from(row % 250) * 0.4));
    "planner,success [% of 250]\n".to_owned() + &cells.collect::<String>()
}

/// Time that this thread has had of a core; other programs on the machine do not count.
fn processor_time() -> Duration {
    let text = fs::read_to_string("/proc/thread-self/schedstat").expect("the bench is for Linux");
    Duration::from_nanos(
        text.split(' ').next().and_then(|ns| ns.parse().ok()).expect("nanoseconds stand first"),
    )
}

fn report(text: &str, format: Format) -> Report {
    let input = read(black_box(text), format).expect("the table is well formed");
    audit(&input, &Options::default()).expect("there are no relations")
}

fn timed(bencher: &mut Bencher<'_>, text: &str, format: Format) {
    bencher.iter_custom(|times| {
        let begun = processor_time();
        for _ in 0..times {
            black_box(report(text, format));
        }
        processor_time().saturating_sub(begun)
    });
}

fn audits(criterion: &mut Criterion) {
    let usual = usual();
    let long = long(100_000);
    assert!(
        report(&usual, Format::Markdown).findings.len() >= 20,
        "nothing is found, so that nothing is mended"
    );
    assert!(report(&long, Format::Csv).tally["grim"].applied == 100_000);
    let mut group = criterion.benchmark_group("audit, processor time");
    group.sample_size(20);
    group.bench_function("20 rows", |bencher| timed(bencher, &usual, Format::Markdown));
    group.sample_size(10);
    group.bench_function("100 000 rows of shares", |bencher| timed(bencher, &long, Format::Csv));
}

criterion_group!(benches, audits);
criterion_main!(benches);
