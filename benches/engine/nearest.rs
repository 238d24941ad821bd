//! The nearest of many configurations of eight joints: the index of the planners that sample beside a plain scan and rstar's tree.
//!
//! Configurations are those of a tree that grows as RRT does in joint space without obstacles: each lies at most 1 rad from the nearest
//! one on the way to an even sample. Questions are even samples. All three answer alike first; then `index`, `plain` and `rstar` are
//! timed a question, and `grow` and `rstar_grow` a whole tree without its questions.

mod cpu;

use base::seed;
use cpu::CpuTime;
use criterion::{Criterion, criterion_group, criterion_main};
use rand::RngExt as _;
use replan_engine::sampling::Index;
use rstar::RTree;
use std::{cell::Cell, hint::black_box, time::Duration};

const AXES: usize = 8;
const RANGE_RAD: f64 = 1.0;
const QUESTIONS: usize = 512;

type Config = [f64; AXES];

fn square(a: &Config, b: &Config) -> f64 {
    a.iter().zip(b).map(|(a, b)| a - b).fold(0.0, |sum, gap| sum + gap * gap)
}

fn sample(stream: &mut seed::Stream) -> Config {
    std::array::from_fn(|_| stream.random_range(-3.0..3.0))
}

/// The configurations of a tree, as they are added.
fn tree(count: usize) -> Vec<Config> {
    let mut stream = seed::stream(56);
    let mut index = Index::new(&[false; AXES]);
    let mut configs = vec![[0.0; AXES]];
    index.add(&configs[0]);
    while configs.len() < count {
        let to = sample(&mut stream);
        let (near, distance) = index.nearest(&to);
        let from = configs[near as usize];
        let share = (RANGE_RAD / distance).min(1.0);
        let step = std::array::from_fn(|axis| from[axis] + share * (to[axis] - from[axis]));
        index.add(&step);
        configs.push(step);
    }
    configs
}

fn indexed(configs: &[Config]) -> Index {
    let mut index = Index::new(&[false; AXES]);
    for config in configs {
        index.add(config);
    }
    index
}

fn in_rstar(configs: &[Config]) -> RTree<Config> {
    let mut tree = RTree::new();
    for config in configs {
        tree.insert(*config);
    }
    tree
}

fn plain(configs: &[Config], at: &Config) -> f64 {
    configs.iter().map(|config| square(config, at)).fold(f64::INFINITY, f64::min)
}

fn benches(c: &mut Criterion<CpuTime>) {
    let mut stream = seed::stream(57);
    let questions: Vec<Config> = (0..QUESTIONS).map(|_| sample(&mut stream)).collect();
    for count in [1_000, 10_000, 100_000, 1_000_000] {
        let configs = tree(count);
        let index = indexed(&configs);
        let rstar = in_rstar(&configs);
        for at in &questions[..32] {
            let known = plain(&configs, at);
            assert_eq!(index.nearest(at).1, known.sqrt(), "{at:?}");
            let theirs = rstar.nearest_neighbor(*at).expect("it has configurations");
            assert_eq!(square(theirs, at), known, "{at:?}");
        }
        let mut group = c.benchmark_group(format!("nearest_of_{count}"));
        group
            .sample_size(10)
            .warm_up_time(Duration::from_millis(200))
            .measurement_time(Duration::from_secs(1));
        let turn = Cell::new(0);
        let next = || {
            turn.set((turn.get() + 1) % QUESTIONS);
            &questions[turn.get()]
        };
        group.bench_function("index", |b| b.iter(|| index.nearest(black_box(next()))));
        group.bench_function("plain", |b| b.iter(|| plain(&configs, black_box(next()))));
        group.bench_function("rstar", |b| b.iter(|| rstar.nearest_neighbor(*black_box(next()))));
        if count < 1_000_000 {
            group.bench_function("grow", |b| b.iter(|| indexed(&configs)));
            group.bench_function("rstar_grow", |b| b.iter(|| in_rstar(&configs)));
        }
        group.finish();
    }
}

criterion_group! {
    name = nearest;
    config = cpu::criterion();
    targets = benches
}
criterion_main!(nearest);
