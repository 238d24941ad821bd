//! The audit of a table of 20 rows, from its text to the findings: what a pre-commit hook waits for.

use audit::reader::{Format, read};
use audit::report::{Options, audit};
use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;

/// Twenty rows of the usual columns; some shares are no k of 250, so that mends are searched for as well.
fn table() -> String {
    let mut text = "| planner | success [% of 250] | time [mean, integers, n=50] | time [sd] | length [a+b√2] |\n|-|-|-|-|-|\n".to_owned();
    for row in 0..20 {
        let (percent, length) = (50.0 + 1.7 * f64::from(row), 20.0 + 1.37 * f64::from(row));
        text += &format!("| p{row} | {percent:.1} | {}.48 | 3.{row:02} | {length:.2} |\n", 10 + row);
    }
    text
}

fn audit_of_twenty_rows(criterion: &mut Criterion) {
    let text = table();
    criterion.bench_function("audit/20 rows", |bencher| {
        bencher.iter(|| {
            let input = read(black_box(&text), Format::Markdown).expect("the table is well formed");
            audit(&input, &Options::default()).expect("there are no relations")
        });
    });
}

criterion_group!(benches, audit_of_twenty_rows);
criterion_main!(benches);
