//! Samples, trees and simplification against what is known of them.

use super::*;
use crate::geometry::planar::ConvexPolygon;
use crate::space::roadmap::{Local, PlaneMap};
use base::seed;
use rand::RngExt as _;

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

#[test]
fn simplified_paths_keep_their_ends_are_free_and_no_longer() {
    let local = plane();
    let rules = (
        &BSpline { rounds: 1, least_change: 0.1, share: 0.5 },
        &Reduce { tries: 10, empty_tries: 5, range_share: 0.5 },
    );
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
    for operations in [
        &[Operation::Shortcut, Operation::Bspline][..],
        &[Operation::Reduce],
        &[Operation::Reduce, Operation::Bspline],
    ] {
        let mut motions = Motions::new(&local);
        let mut draw = Draw::new(DrawSetting::Seeded, 3);
        let short = simplify(&mut motions, &mut draw, path.clone(), (5, operations), rules);
        assert_eq!((&short[0], short.last()), (&path[0], path.last()), "{operations:?}");
        assert!(short.windows(2).all(|leg| motions.goes(&leg[0], &leg[1])), "{operations:?}: {short:?}");
        assert!(motions.length(&short) < 0.9 * motions.length(&path), "{operations:?}: {short:?}");
    }
    // A path whose ends see each other is one motion.
    let seen = vec![vec![10.0, 10.0], vec![20.0, 90.0], vec![40.0, 10.0]];
    let mut motions = Motions::new(&local);
    let mut draw = Draw::new(DrawSetting::Seeded, 3);
    let short = simplify(&mut motions, &mut draw, seen, (5, &[Operation::Bspline]), rules);
    assert_eq!(short, [[10.0, 10.0], [40.0, 10.0]]);
}
