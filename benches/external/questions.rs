//! What a question costs a planner from outside: messages there and back, by the size of a batch. Needs python3.

use base::grid::{CornerRule, Grid2};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use engine::space::{LatticeWorld, World};
use replan_external::message::Limits;
use replan_external::{End, Process, Program, Query, Space, describe, greet, solve};
use std::hint::black_box;
use std::sync::OnceLock;
use std::time::Duration;

/// How many batches are asked for one query, so that the query itself weighs little.
const BATCHES: usize = 200;

#[expect(clippy::disallowed_types, reason = "a bench reads the clock")]
fn now_ns() -> u64 {
    static FIRST: OnceLock<std::time::Instant> = OnceLock::new();
    FIRST.get_or_init(std::time::Instant::now).elapsed().as_nanos() as u64
}

fn questions(criterion: &mut Criterion) {
    let world =
        World::Lattice(LatticeWorld::new(Grid2::new(20, 20).expect("a small grid"), CornerRule::Allow));
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/../../planners/python/examples/ask.py");
    let limits = Limits { time_s: 600.0, memory_mb: 4096, output_mb: 1000 };
    let mut group = criterion.benchmark_group("motions asked by a planner in Python");
    group.sample_size(10).measurement_time(Duration::from_secs(5));
    for size in [1, 10, 100, 1000] {
        let words = ["python3", script, &BATCHES.to_string(), &size.to_string()];
        let program = Program { command: words.map(str::to_owned).to_vec(), limits, hello_s: 10.0 };
        let Ok(mut process) = Process::start(&program) else {
            eprintln!("skipped: there is no python3");
            return;
        };
        greet(&mut process, &program).expect("it says hello");
        group.throughput(Throughput::Elements((BATCHES * size) as u64));
        group.bench_function(BenchmarkId::from_parameter(format!("batches of {size}")), |bench| {
            bench.iter(|| {
                let data = describe(&world, false).expect("a grid is of the protocol");
                let query = Query { id: 1, seed: 0, world: data, start: &[3.0, 4.0], goal: &[4.0, 5.0] };
                let mut space = Space::new(&world, false);
                let talk = solve(&mut process, query, limits, &mut space, now_ns);
                assert_eq!((&talk.end, talk.questions.batches), (&End::NoPath, BATCHES as u64));
                black_box(talk)
            });
        });
    }
}

criterion_group!(benches, questions);
criterion_main!(benches);
