//! Samples, trees and simplification against what is known of them.

use super::*;
use base::seed;
use rand::RngExt as _;
use std::f64::consts::TAU;
use world::geometry::planar::ConvexPolygon;
use world::space::roadmap::{Local, PlaneMap};

/// A particle in a square of 100 mm with a wall that leaves a gap at the top.
fn plane() -> Local {
    let corners = [[45.0, 0.0], [55.0, 0.0], [55.0, 80.0], [45.0, 80.0]];
    let wall = ConvexPolygon::new(corners.map(Into::into).to_vec());
    Local::Plane(PlaneMap::new([100.0, 100.0], vec![wall.expect("a wall is convex")]))
}

#[test]
fn halton_samples_are_the_mirrored_digits_of_their_numbers() {
    let mut draw = Draw::new(DrawSetting::Halton, 1);
    let drawn: Vec<Vec<f64>> = (0..4).map(|_| draw.next(&[[0.0, 1.0], [-1.0, 1.0]])).collect();
    let known = [[1.0 / 3.0, 0.2], [2.0 / 3.0, 0.4], [1.0 / 9.0, 0.6], [4.0 / 9.0, 0.8]];
    for (sample, [x, y]) in drawn.iter().zip(known) {
        assert!((sample[0] - x).abs() < 1e-15 && (sample[1] - (2.0 * y - 1.0)).abs() < 1e-15, "{drawn:?}");
    }
}

#[test]
fn points_in_a_ball_fill_it_evenly() {
    let mut draw = Draw::new(DrawSetting::Seeded, 5);
    let points: Vec<Vec<f64>> = (0..4000).map(|_| draw.in_ball(3)).collect();
    let norm = |point: &Vec<f64>| point.iter().map(|x| x * x).sum::<f64>().sqrt();
    assert!(points.iter().all(|point| norm(point) <= 1.0));
    // Half of the radius holds an eighth of the volume, a half space half of it.
    let inner = points.iter().filter(|point| norm(point) < 0.5).count();
    let above = points.iter().filter(|point| point[2] > 0.0).count();
    assert!((420..580).contains(&inner) && (1900..2100).contains(&above), "{inner} {above}");
}

#[test]
fn near_nodes_are_those_that_a_plain_scan_finds_also_round_a_turn() {
    let local = plane();
    let motions = Motions::new(&local);
    let mut stream = seed::stream(17);
    let mut point = || vec![stream.random_range(0.0..100.0), stream.random_range(0.0..100.0)];
    let mut tree = Tree::new(&motions, &point());
    (1..203).for_each(|_| {
        tree.add(&point(), 0);
    });
    for _ in 0..50 {
        let at = point();
        let mut all: Vec<(u32, f64)> =
            (0..203).map(|node| (node, motions.distance(&at, tree.config(node)))).collect();
        all.sort_by(|a, b| a.1.total_cmp(&b.1));
        let near = tree.nearest_of(&at, 7);
        assert_eq!(near.len(), 7);
        for ((node, gap), (known, distance)) in near.iter().zip(&all) {
            assert!(node == known && (gap - distance).abs() < 1e-9, "seed 17 at {at:?}: {near:?}");
        }
        assert_eq!(tree.nearest(&at).0, all[0].0);
    }
}

/// Points of all kinds: spread, in clusters, in a row, on a raster where many are equally far, and more turns round.
fn points(kind: usize, axes: usize, stream: &mut seed::Stream) -> Vec<Vec<f64>> {
    let mut middle = vec![0.0; axes];
    let mut point = |number: usize| -> Vec<f64> {
        if number.is_multiple_of(300) {
            middle.fill_with(|| stream.random_range(-3.0..3.0));
        }
        let mut value = |axis: usize| match kind {
            0 => stream.random_range(-3.0..3.0),
            1 => middle[axis] + stream.random_range(-0.1..0.1),
            2 => number as f64 * 0.001 + stream.random_range(0.0..0.001),
            3 => f64::from(stream.random_range(-2..=2)),
            _ => stream.random_range(-20.0..20.0),
        };
        (0..axes).map(&mut value).collect()
    };
    (0..3000).map(&mut point).collect()
}

#[test]
fn an_index_finds_what_measuring_every_point_finds_also_among_equally_far_ones() {
    let mut ties = 0;
    let mut deep = 0;
    for (kind, turn_on) in (0..5).flat_map(|kind| {
        [vec![false; 2], vec![false; 8], vec![true; 3], vec![false, true, false, true, true, false]]
            .map(|turn_on| (kind, turn_on))
    }) {
        let mut stream = seed::stream(kind as u64);
        let points = points(kind, turn_on.len(), &mut stream);
        let square = |at: &[f64], to: &[f64]| -> f64 {
            let gap = |((from, to), turns_on): ((&f64, &f64), &bool)| {
                let gap = to - from;
                if *turns_on { gap - TAU * (gap / TAU).round() } else { gap }
            };
            at.iter().zip(to).zip(&turn_on).map(gap).fold(0.0, |sum, gap| sum + gap * gap)
        };
        let mut index = Index::new(&turn_on);
        for (number, point) in points.iter().enumerate() {
            assert_eq!(index.add(point), number as u32);
            let is_asked = number < 20 || number % 97 == 0 || number % 512 > 509;
            if !is_asked {
                continue;
            }
            let by = if kind == 3 { 0.0 } else { 0.5 };
            let near = &points[stream.random_range(0..points.len())];
            let at: Vec<f64> = near.iter().map(|value| value + by * stream.random_range(-1.0..1.0)).collect();
            let mut all: Vec<(f64, u32)> =
                points[..=number].iter().zip(0..).map(|(to, node)| (square(&at, to), node)).collect();
            all.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            all.truncate(12);
            ties += usize::from(all.windows(2).any(|pair| pair[0].0 == pair[1].0));
            deep += usize::from(number >= 1024);
            let known: Vec<(u32, f64)> = all.iter().map(|(square, node)| (*node, square.sqrt())).collect();
            let seen = format!("seed {kind}, {turn_on:?}, {} points, at {at:?}", number + 1);
            assert_eq!(index.nearest(&at), known[0], "{seen}");
            assert_eq!(index.nearest_of(&at, 12), known, "{seen}");
        }
    }
    assert!(ties > 100 && deep > 200, "one-sided sample: {ties} with ties, {deep} in packs");
}

#[test]
fn what_is_cut_off_is_near_nothing_any_more() {
    let local = plane();
    let motions = Motions::new(&local);
    let mut tree = Tree::new(&motions, &[0.0, 0.0]);
    // Two branches of 600 nodes: one lies in packs, and both are reached over the root.
    let branch = |tree: &mut Tree, y: f64| {
        let first = tree.add(&[0.1, y], 0);
        (1..600).fold(first, |parent, step| tree.add(&[f64::from(step) * 0.1, y], parent));
        first
    };
    let [low, high] = [10.0, 20.0].map(|y| branch(&mut tree, y));
    let at = [30.0, 11.0];
    assert_eq!(tree.config(tree.nearest(&at).0), [30.0, 10.0]);
    tree.cut(low);
    assert_eq!(tree.config(tree.nearest(&at).0), [30.0, 20.0]);
    assert!(tree.nearest_of(&at, 700).iter().all(|(node, _)| *node == 0 || *node >= high));
    tree.cut(high);
    assert_eq!((tree.nearest(&at).0, tree.nearest_of(&at, 700).len()), (0, 1));
}

#[test]
fn simplified_paths_keep_their_ends_are_free_and_no_longer() {
    let local = plane();
    let bspline = &BSpline { rounds: 1, least_change: 0.1, share: 0.5 };
    let path: Vec<Vec<f64>> = [
        [10.0, 10.0],
        [5.0, 50.0],
        [20.0, 95.0],
        [40.0, 85.0],
        [50.0, 95.0],
        [70.0, 85.0],
        [95.0, 60.0],
        [90.0, 10.0],
    ]
    .map(|point| point.to_vec())
    .to_vec();
    for operations in [&[Operation::Shortcut, Operation::Bspline][..], &[Operation::Shortcut]] {
        let mut motions = Motions::new(&local);
        let short = simplify(&mut motions, path.clone(), (5, operations), bspline);
        assert_eq!((&short[0], short.last()), (&path[0], path.last()), "{operations:?}");
        assert!(short.windows(2).all(|leg| motions.goes(&leg[0], &leg[1])), "{operations:?}: {short:?}");
        assert!(motions.length(&short) < 0.9 * motions.length(&path), "{operations:?}: {short:?}");
    }
    // A path whose ends see each other is one motion.
    let seen = vec![vec![10.0, 10.0], vec![20.0, 90.0], vec![40.0, 10.0]];
    let mut motions = Motions::new(&local);
    let short = simplify(&mut motions, seen, (5, &[Operation::Bspline]), bspline);
    assert_eq!(short, [[10.0, 10.0], [40.0, 10.0]]);
}
