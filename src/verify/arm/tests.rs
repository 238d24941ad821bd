use super::*;
use crate::arm::Body;

pub(super) fn case(ends: [&[f64]; 2], swept: bool) -> Case<'_> {
    Case {
        links_cm: [30.0, 20.0],
        higher_elbow: false,
        low_cm: [-50.0, 0.0],
        step_cm: 1.0,
        size: [101, 51],
        inner_radius_cm: 20.0,
        touching_is_contact: true,
        corner_rule: CornerRule::Allow,
        q2_limit_rad: f64::INFINITY,
        hops: if swept { Hops::EvenJoints } else { Hops::EndPoints },
        bodies: [[35.0, 18.0], [7.0, 35.0], [-13.0, 35.0], [-30.0, 20.0]]
            .into_iter()
            .map(|center| Body::disc(center, 5.0))
            .collect(),
        start: ends[0],
        goal: ends[1],
    }
}

#[test]
fn the_inverse_puts_the_tip_back_and_bends_as_the_rule_says() {
    let mut case = case([&[49.0, 3.0], &[0.0, 45.0]], false);
    let mut reached = 0;
    for higher in [false, true] {
        case.higher_elbow = higher;
        for x in -50..=50 {
            for y in 0..=50 {
                let target = [f64::from(x), f64::from(y)];
                let Some(posture) = case.posture(target) else { continue };
                let [_, elbow, tip] = case.joints(posture);
                let miss = (tip[0] - target[0]).abs() + (tip[1] - target[1]).abs();
                assert!(miss < 1e-9, "{target:?}: off by {miss}");
                let cross = elbow[0] * (tip[1] - elbow[1]) - elbow[1] * (tip[0] - elbow[0]);
                assert!(if higher && x < 0 { cross > -1e-6 } else { cross < 1e-6 }, "{target:?}: {cross}");
                reached += 1;
            }
        }
    }
    assert!(reached > 4_000, "{reached}");
}

#[test]
fn a_hop_over_an_obstacle_is_refused_where_hops_are_swept_and_counted_where_they_are_not() {
    // Past the rim of the first obstacle, with link 2 turning through it.
    let ends: [&[f64]; 2] = [&[30.0, 20.0], &[36.0, 26.0]];
    let path = [ends[0].to_vec(), ends[1].to_vec()];
    let length = 72.0_f64.sqrt();
    let answer = Answer { path: &path, cost: Some(length), steps: None, optimal: false };
    let audit = case(ends, false).audit(&answer).unwrap();
    assert_eq!((audit.unsafe_hops, audit.length_cm), (1, length));
    let refused = case(ends, true).audit(&answer).unwrap_err();
    assert!(
        refused.starts_with("the arm hits an obstacle between [30.0, 20.0] and [36.0, 26.0]"),
        "{refused}"
    );
    let mut empty = case(ends, true);
    empty.bodies.clear();
    assert_eq!(empty.audit(&answer).unwrap().unsafe_hops, 0);
}

#[test]
fn the_optimum_of_eight_steps_among_discs_is_the_printed_length() {
    let ends: [&[f64]; 2] = [&[49.0, 3.0], &[0.0, 45.0]];
    let eight: Vec<[i32; 2]> =
        (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| [dx, dy])).filter(|step| *step != [0, 0]).collect();
    let found = case(ends, false).optimal_length(&eight).unwrap();
    assert!((found - (29.0 + 31.0 * 2.0_f64.sqrt())).abs() < 1e-9, "{found}");
    assert!(case(ends, true).optimal_length(&eight).unwrap() >= found);
    let mut shut = case(ends, false);
    shut.bodies.push(Body::polygon(vec![[-60.0, 22.0], [60.0, 22.0], [60.0, 23.0], [-60.0, 23.0]]));
    assert_eq!(shut.optimal_length(&eight), None);
}

#[test]
fn what_is_not_as_claimed_is_refused() {
    let ends: [&[f64]; 2] = [&[49.0, 3.0], &[49.0, 5.0]];
    let steps = [[0, 1], [0, -1], [1, 0], [-1, 0]];
    let path: Vec<Vec<f64>> = [3.0, 4.0, 5.0].map(|y| vec![49.0, y]).to_vec();
    let answer = Answer { path: &path, cost: Some(2.0), steps: Some(&steps), optimal: true };
    let case = case(ends, true);
    assert_eq!(case.audit(&answer).unwrap().optimal_cm, Some(2.0));
    let refuse = |answer: Answer<'_>, part: &str| {
        let refused = case.audit(&answer).unwrap_err();
        assert!(refused.contains(part), "{refused}");
    };
    refuse(Answer { cost: Some(1.9), ..answer }, "the claimed length is 1.9 cm");
    refuse(Answer { cost: None, ..answer }, "claims no length");
    refuse(Answer { path: &path[..2], ..answer }, "not from start to goal");
    refuse(Answer { path: &[], ..answer }, "the path is empty");
    let leap = [path[0].clone(), path[2].clone()];
    refuse(Answer { path: &leap, ..answer }, "is none of the planner's");
    let still = [path[0].clone(), path[0].clone(), path[1].clone(), path[2].clone()];
    refuse(Answer { path: &still, ..answer }, "stands still");
    let off = [path[0].clone(), vec![49.0, 3.5], path[2].clone()];
    refuse(Answer { path: &off, ..answer }, "not a point of the lattice");
    let detour = [[49.0, 3.0], [48.0, 3.0], [48.0, 4.0], [48.0, 5.0], [49.0, 5.0]].map(|p| p.to_vec());
    refuse(Answer { path: &detour, cost: Some(4.0), ..answer }, "is not the optimum 2 cm");
    let outside = [path[0].clone(), vec![50.0, 3.0], vec![50.0, 4.0], vec![50.0, 5.0], path[2].clone()];
    refuse(Answer { path: &outside, cost: Some(4.0), ..answer }, "may not stand at [50.0, 3.0]");
}
