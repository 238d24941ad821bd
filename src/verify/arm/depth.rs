//! The depth of a hit, beside a search over shifts that knows neither the formulas nor the halving.

use super::tests::case;
use super::{Answer, Body, Case};
use base::seed;
use rand::RngExt as _;

/// What an obstacle is, by how far it goes in a direction.
enum Plain {
    Disc([f64; 2], f64),
    Corners(Vec<[f64; 2]>),
}

impl Plain {
    fn body(&self) -> Body {
        match self {
            Self::Disc(center, radius) => Body::disc(*center, *radius),
            Self::Corners(corners) => Body::polygon(corners.clone()),
        }
    }

    fn farthest(&self, [ux, uy]: [f64; 2]) -> f64 {
        match self {
            Self::Disc([x, y], radius) => ux * x + uy * y + radius,
            Self::Corners(corners) => {
                corners.iter().map(|[x, y]| ux * x + uy * y).fold(f64::NEG_INFINITY, f64::max)
            }
        }
    }
}

/// The least value of `of` on [0, 1]: of many places, each that is below its neighbours is looked at ever closer.
fn least(of: &dyn Fn(f64) -> f64, places: u32) -> f64 {
    let values: Vec<f64> = (0..=places).map(|i| of(f64::from(i) / f64::from(places))).collect();
    let at = |i: usize| values.get(i).copied().unwrap_or(f64::INFINITY);
    let is_low = |i: &usize| at(*i) <= at(i.wrapping_sub(1)) && at(*i) <= at(i + 1);
    let closer = |i: usize| {
        let mut place = i as f64 / f64::from(places);
        let mut half = 1.0 / f64::from(places);
        let mut best = at(i);
        for _ in 0..5 {
            let tried = (-8..=8).map(|k| (place + half * f64::from(k) / 8.0).clamp(0.0, 1.0));
            let (value, found) = tried.map(|at| (of(at), at)).min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
            (place, half, best) = (found, half / 6.0, value.min(best));
        }
        best
    };
    (0..values.len()).filter(is_low).map(closer).fold(f64::INFINITY, f64::min)
}

/// The shortest shift, in any direction, that takes the segment out of the obstacle; 0 or less if it is out.
fn shift(plain: &Plain, segment: [[f64; 2]; 2]) -> f64 {
    let overlap = |share: f64| {
        let (uy, ux) = libm::sincos(share * std::f64::consts::TAU);
        let nearest = segment.map(|[x, y]| ux * x + uy * y).into_iter().fold(f64::INFINITY, f64::min);
        plain.farthest([ux, uy]) - nearest
    };
    least(&overlap, 180)
}

/// How deep each link gets while both joints turn evenly the short way round.
fn sampled(case: &Case<'_>, plain: &Plain) -> [f64; 2] {
    let [from, to] = [case.start, case.goal].map(|end| case.posture([end[0], end[1]]).unwrap());
    let by = [0, 1].map(|i| libm::remainder(to[i] - from[i], std::f64::consts::TAU));
    let links = |share: f64| {
        let [q1, q2] = [0, 1].map(|i| from[i] + share * by[i]);
        let elbow = [30.0 * libm::cos(q1), 30.0 * libm::sin(q1)];
        let tip = [elbow[0] + 20.0 * libm::cos(q1 + q2), elbow[1] + 20.0 * libm::sin(q1 + q2)];
        [[[0.0; 2], elbow], [elbow, tip]]
    };
    [0, 1].map(|link| -least(&|share| -shift(plain, links(share)[link]), 60))
}

fn obstacles() -> [Plain; 4] {
    let [x, y] = [7.0, 35.0];
    [
        Plain::Disc([x, y], 5.0),
        Plain::Disc([4.0, 24.0], 3.0),
        Plain::Corners(vec![[x - 5.0, y - 5.0], [x + 5.0, y - 5.0], [x + 5.0, y + 5.0], [x - 5.0, y + 5.0]]),
        Plain::Corners(vec![[-4.0, 29.0], [8.0, 31.0], [1.0, 40.0]]),
    ]
}

#[test]
fn the_depth_of_a_hit_is_the_least_shift_that_parts_arm_and_obstacle() {
    let mut hits = [0; 4];
    let mut clear = 0;
    let mut first_link = 0;
    for number in 0..400_u64 {
        let mut stream = seed::stream(number);
        let which = number as usize % 4;
        let plain = &obstacles()[which];
        let [start, goal] =
            [0, 1].map(|_| [stream.random_range(-30..50), stream.random_range(0..50)].map(f64::from));
        let mut case = case([&start, &goal], false);
        case.bodies = vec![plain.body()];
        let path = [start.to_vec(), goal.to_vec()];
        let length = libm::hypot(goal[0] - start[0], goal[1] - start[1]);
        let answer = Answer { path: &path, cost: Some(length), steps: None, optimal: false };
        let Ok(audit) = case.audit(&answer) else { continue };
        if audit.unsafe_hops == 0 && clear > 20 {
            continue;
        }
        let [first, second] = sampled(&case, plain);
        let deepest = first.max(second).max(0.0);
        assert!(
            (audit.deepest_cm - deepest).abs() < 1e-3,
            "seed {number}: {} cm, and {deepest} cm by search",
            audit.deepest_cm
        );
        match audit.unsafe_hops {
            0 => clear += 1,
            _ => hits[which] += 1,
        }
        first_link += u32::from(first > second && first > 0.0);
    }
    assert!(hits.iter().all(|hits| *hits > 3) && clear > 10, "{hits:?} hits, {clear} clear");
    assert!(first_link > 2, "link 1 was the deeper one {first_link} times");
}

#[test]
fn of_several_hits_the_deepest_counts() {
    let ends: [[f64; 2]; 3] = [[30.0, 20.0], [36.0, 26.0], [35.0, 25.0]];
    let depth = |points: &[[f64; 2]]| {
        let path: Vec<Vec<f64>> = points.iter().map(|point| point.to_vec()).collect();
        let length =
            points.windows(2).map(|two| libm::hypot(two[1][0] - two[0][0], two[1][1] - two[0][1])).sum();
        let case = case([&path[0], &path[path.len() - 1]], false);
        let audit =
            case.audit(&Answer { path: &path, cost: Some(length), steps: None, optimal: false }).unwrap();
        (audit.unsafe_hops, audit.deepest_cm)
    };
    let there = depth(&ends[..2]);
    let back = depth(&[ends[1], ends[0]]);
    assert_eq!((there.0, back.0), (1, 1));
    assert!((there.1 - back.1).abs() < 1e-3 && there.1 > 0.1, "{there:?} and {back:?}");
    let all = depth(&[ends[0], ends[1], ends[2], ends[0]]);
    let last = depth(&[ends[2], ends[0]]);
    assert!(last.1 > 0.0 && last.1 < there.1 - 0.01, "{last:?} and {there:?}");
    assert_eq!(all.1, there.1);
}
