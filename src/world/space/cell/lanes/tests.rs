//! Lanes against one configuration at a time: the same verdict, reason and count on every motion.

use super::place::place_block;
use super::*;
use crate::geometry::lanes::{Level, ROUGHNESS, levels, on_level};
use crate::geometry::{Frame, Vec3};
use crate::kinematics::{Chain, Robot};
use crate::space::cell::doubt::{HALF_WAY, axis_way_m};
use crate::space::cell::lines::between;
use crate::space::cell::tests::{draw, fu_cell, rules};
use crate::space::cell::{Cell, EdgeEnd, LineRules, Scene, Scratch, SpeedRule, Standing};
use base::seed::{self, Stream};
use base::settings::Document;
use rand::RngExt as _;
use std::collections::BTreeMap;
use std::path::Path as FilePath;

/// A cell with every kind of obstacle, two of them without lanes, and a turned box.
fn mixed_cell(robot: &Robot) -> Cell {
    let text = "name = 'mixed'\n[support]\nunder = 'floor'\nbase_mm = [0, 0, 0]\nyaw_deg = 0\n[[box]]\nname = 'b'\nmin_mm = [600, -300, 0]\n\
                max_mm = [900, 100, 700]\nyaw_deg = 30\n[[capsule]]\nname = 'c'\nfrom_mm = [-800, 500, 300]\n\
                to_mm = [0, 900, 900]\nradius_mm = 60\n[[sphere]]\nname = 's'\ncenter_mm = [900, 900, 900]\n\
                radius_mm = 100\n[[convex]]\nname = 'p'\nvertices_mm = [[-900, 0, 0], [-600, 0, 0], [-900, -300, 0], \
                [-900, 0, 600]]\n";
    let scene = Scene::parse(&Document::new(FilePath::new("mixed.toml"), text.to_owned())).unwrap();
    Cell::new(robot.clone(), scene, true)
}

/// A configuration on the same branch as `from`, or one not far off, whatever its branch.
fn partner(lines: &Lines, from: &Joints, stream: &mut Stream) -> Joints {
    if stream.random_bool(0.5) {
        return from.map(|angle| angle + stream.random_range(-0.5..0.5));
    }
    let arm = lines.cell().robot().arm();
    loop {
        let q = draw(stream);
        if arm.branch_of(&q) == arm.branch_of(from) {
            return q;
        }
    }
}

/// What the lanes alone say on each of [`levels`], after holding them and [`Lines::join`] to one configuration at a time.
///
/// `used` is the memory of one motion after another: what an earlier one left in it must not show.
fn compared(
    lines: &Lines,
    [a, b]: [&Joints; 2],
    place: &str,
    used: &mut (Scratch, Memory),
) -> [Option<Result<(), Rejection>>; 2] {
    let [from, to] = [a, b].map(|q| lines.pose(q));
    let mut single = Scratch::default();
    let expected = lines.join_singly(&from, &to, &mut single);
    let (both, memory) = used;
    let mut one = |level: Level| {
        let place = format!("{place} on {level:?}: {a:?} {b:?}");
        let before = both.checked();
        assert_eq!(lines.join(&from, &to, both), expected, "{place}");
        assert_eq!(both.checked() - before, single.checked(), "{place}");
        if lines.parts_branches(&from, &to) {
            return Some(Err(Rejection::Branch));
        }
        let found = lines.join_lanes(&from, &to, memory, &mut 0);
        if found == Some(Ok(())) {
            let Track { near: found, count, .. } = &memory.track;
            let is_near = |state: usize| found[state / ROUGH_LANES] >> (state % ROUGH_LANES) & 1 == 1;
            let exact = near(lines.cell(), &single.states);
            assert_eq!(exact.len(), *count, "{place}");
            // What may be near counts as near; what is near must.
            assert!((0..*count).all(|state| is_near(state) || !exact[state]), "{place}");
        }
        found
    };
    levels().map(|level| on_level(level, || one(level)))
}

/// Which configurations of a free path come near something, by the scalar code.
fn near(cell: &Cell, states: &[Joints]) -> Vec<bool> {
    let mut bodies = vec![Vec::new(); states.len()];
    for (q, placed) in states.iter().zip(&mut bodies) {
        cell.place(q, placed);
    }
    let is_near = |state: usize| {
        let to = |other: usize, part: usize| axis_way_m(&bodies[state][part], &bodies[other][part]);
        let next = (state + 1).min(states.len() - 1);
        let margin = |part| HALF_WAY * to(state.saturating_sub(1), part).max(to(next, part));
        cell.standing(&bodies[state], margin) == Standing::Near
    };
    (0..states.len()).map(is_near).collect()
}

#[test]
fn bodies_are_placed_to_a_tenth_of_the_band() {
    let cell = fu_cell();
    let mut stream = seed::stream(54);
    let band_m = f64::from(cell.outline.band_m);
    let parts = cell.body().parts().len();
    let mut worst = 0_f64;
    for index in 0..20_000 {
        let drawn: [Joints; ROUGH_LANES] = std::array::from_fn(|_| draw(&mut stream));
        let angles = std::array::from_fn(|joint| drawn.map(|q| q[joint] as f32));
        for level in levels() {
            let mut rows = vec![[[0.0; ROUGH_LANES]; 6]; parts];
            dispatch!(level, simd => place_block(simd, &cell.outline, &angles, &mut rows));
            for (lane, q) in drawn.iter().enumerate() {
                let mut placed = Vec::new();
                cell.place(q, &mut placed);
                for (capsule, row) in placed.iter().zip(&rows) {
                    let end =
                        |first: usize| Vec3::from([0, 1, 2].map(|axis| f64::from(row[first + axis][lane])));
                    let off = (end(0) - capsule.segment.a).norm().max((end(3) - capsule.segment.b).norm());
                    assert!(off < 0.1 * band_m, "seed 54 case {index} on {level:?}: {q:?} is off by {off}");
                    worst = worst.max(off);
                }
            }
        }
    }
    assert!(worst > 1e-7, "{worst}");
}

#[test]
fn no_end_of_a_part_bends_more_than_its_bound() {
    let cell = fu_cell();
    let mut stream = seed::stream(57);
    let mut worst = 0_f64;
    for index in 0..20_000 {
        let q = draw(&mut stream);
        let step: Joints = std::array::from_fn(|_| stream.random_range(-0.3..0.3) * f64::from(index % 3));
        let [before, own, after] = [-1.0, 0.0, 1.0].map(|share| {
            let mut placed = Vec::new();
            cell.place(&std::array::from_fn(|joint| q[joint] + share * step[joint]), &mut placed);
            placed
        });
        let pulls = Outline::pulls(&step.map(|change| change as f32));
        for part in 0..own.len() {
            let [a, b, c] = [&before, &own, &after].map(|placed| placed[part].segment);
            let bend_m = (a.a - b.a * 2.0 + c.a).norm().max((a.b - b.b * 2.0 + c.b).norm());
            let most_m = f64::from(cell.outline.bend_m(part, &pulls));
            assert!(
                bend_m <= most_m * 1.000_01 + 1e-9,
                "seed 57 case {index} part {part}: {bend_m} m of {most_m} m"
            );
            worst = worst.max(bend_m / most_m.max(1e-9));
        }
    }
    assert!(worst > 0.5, "the bound is loose: {worst}");
}

#[test]
fn angles_of_many_turns_and_what_is_no_number_are_left_to_the_scalar_code() {
    let lines = Lines::new(fu_cell(), LineRules { path: Path::Joints, ..rules() });
    let found = |from: f64, to: f64| {
        let [from, to] = [from, to].map(|last| lines.pose(&[0.0, -1.5, 0.0, 0.0, 1.5, last]));
        lines.join_lanes(&from, &to, &mut Memory::default(), &mut 0)
    };
    let [near, far] = [TAU, 1.02 * TAU];
    assert_eq!(found(near, -near), Some(Ok(())));
    for (from, to) in [(far, near), (near, far), (-far, near), (near, f64::NAN)] {
        assert_eq!(found(from, to), None, "{from} {to}");
    }
}

#[test]
fn what_is_thin_for_the_size_of_the_cell_has_no_lanes() {
    let robot = fu_cell().robot().clone();
    let cell = |capsule_mm: f64| {
        let text = format!(
            "name = 's'\n[support]\nunder = 'nothing'\nbase_mm = [0, 0, 0]\nyaw_deg = 0\nwhy = 'a test'\n\
             [[capsule]]\nname = 'c'\nfrom_mm = [0, 0, 900]\nto_mm = [0, 900, 900]\nradius_mm = {capsule_mm}\n"
        );
        let scene = Scene::parse(&Document::new(FilePath::new("s.toml"), text)).unwrap();
        Cell::new(robot.clone(), scene, true)
    };
    // The finger's radius is 15 mm, and a fiftieth of the arm's reach about 51 mm.
    for (capsule_mm, has_lanes) in [(30.0, false), (40.0, true)] {
        assert_eq!(cell(capsule_mm).outline.solids[0].is_some(), has_lanes, "{capsule_mm}");
    }
    let reach_m = f64::from(cell(40.0).outline.band_m) / ROUGHNESS;
    let body = robot.bodies()[0].clone();
    let chain = robot.arm().chain();
    for (base_m, are_thin) in [(0.0, false), (10.0 * reach_m, true)] {
        let base = Frame::at(Vec3::x() * base_m);
        let chain = Chain::new(*chain.joints(), base, *chain.tool()).unwrap();
        let outline = Outline::new(&chain, &body, &Scene::empty(), &[], body.self_pairs());
        assert!(outline.pairs.iter().all(|pair| pair.touch_m.is_nan() == are_thin), "{base_m}");
    }
}

#[test]
fn boxes_have_no_lanes_beside_a_slender_part() {
    let path = FilePath::new(env!("CARGO_MANIFEST_DIR")).join("../../data/robots/motoman_up6.toml");
    let text = std::fs::read_to_string(&path).unwrap();
    let boxes = |forearm_mm: u32| {
        // The forearm's axis is 790 mm long.
        let changed = text.replacen("radius_mm = 75", &format!("radius_mm = {forearm_mm}"), 1);
        assert_ne!(changed, text);
        let robot = Robot::parse(&changed, &path).unwrap();
        let cell = Cell::new(robot, fu_cell().scene().clone(), true);
        cell.outline.solids.iter().filter(|solid| solid.is_some()).count()
    };
    // The floor has lanes in any case.
    assert_eq!([7, 8].map(boxes), [1, fu_cell().scene().obstacles().len()]);
}

#[test]
fn lanes_and_one_configuration_at_a_time_agree_on_every_motion() {
    let cell = fu_cell();
    let speed = SpeedRule { speed_m_s: 0.5, acceleration_m_s2: 2.0 };
    let mixed = mixed_cell(cell.robot());
    let readings = [
        (rules(), 40_000),
        (LineRules { path: Path::Joints, ..rules() }, 20_000),
        // Most of these are free or not by the steps between their configurations.
        (LineRules { path: Path::Joints, step_rad: 0.4, ..rules() }, 10_000),
        (LineRules { speed: Some(speed), end: EdgeEnd::WholeTurns, ..rules() }, 20_000),
        (LineRules { end: EdgeEnd::PoseOnly, turn_rad: 1.5, ..rules() }, 10_000),
    ];
    let mut seen = [BTreeMap::new(), BTreeMap::new()];
    let mut doubts = [0; 2];
    let mut used = Default::default();
    for (number, (rules, count)) in readings.into_iter().enumerate() {
        let mut stream = seed::stream(seed::derive(51, &[&number.to_string()]));
        let cells = [cell.clone(), mixed.clone()].map(|cell| Lines::new(cell, rules));
        for index in 0..count {
            let lines = &cells[usize::from(index % 4 == 0)];
            let from = draw(&mut stream);
            let to = partner(lines, &from, &mut stream);
            let place = format!("seed 51 reading {number} motion {index}");
            let found = compared(lines, [&from, &to], &place, &mut used);
            for (level, found) in found.into_iter().enumerate() {
                match found {
                    Some(verdict) => *seen[level].entry(format!("{verdict:?}")).or_insert(0) += 1,
                    None => doubts[level] += 1,
                }
            }
        }
    }
    for (seen, doubts) in seen.into_iter().zip(doubts) {
        assert!(seen.len() == 9 && seen.values().all(|count| *count > 100), "one-sided sample: {seen:?}");
        assert!(doubts < 10_000, "{doubts} motions in doubt: {seen:?}");
    }
}

#[test]
fn motions_that_stop_a_micrometre_before_or_in_contact_are_left_to_the_scalar_code() {
    let lines = Lines::new(fu_cell(), LineRules { path: Path::Joints, ..rules() });
    let cell = lines.cell();
    let mut stream = seed::stream(52);
    let mut cases = 0;
    let mut contacts = 0;
    let mut doubts = [0; 2];
    let mut used = Default::default();
    while cases < 4_000 {
        let [free, other] = [0; 2].map(|_| draw(&mut stream));
        if !cell.is_free(&free) || cell.is_free(&other) {
            continue;
        }
        let (mut low, mut high) = (0.0, 1.0);
        while high - low > 1e-15 {
            let share = f64::midpoint(low, high);
            if share <= low || share >= high {
                break;
            }
            *(if cell.is_free(&between(&free, &other, share)) { &mut low } else { &mut high }) = share;
        }
        let off = stream.random_range(-3e-7..3e-7);
        let end = between(&free, &other, high + off);
        let start = between(&free, &other, (high - 0.1).max(0.0));
        let place = format!("seed 52 case {cases}");
        let lanes = compared(&lines, [&start, &end], &place, &mut used);
        contacts += u32::from(!cell.is_free(&end));
        for (doubts, found) in doubts.iter_mut().zip(lanes) {
            *doubts += u32::from(found.is_none());
        }
        cases += 1;
    }
    assert!((1_000..3_000).contains(&contacts), "one-sided sample: {contacts}");
    assert!(doubts.iter().all(|count| *count > 3_000), "only {doubts:?} of {cases} were passed on");
}

#[test]
fn instructions_that_a_test_asks_for_are_those_that_lanes_run_on() {
    let lines = Lines::new(fu_cell(), rules());
    let mut stream = seed::stream(53);
    let [best, least] = levels();
    let mut whole = 0;
    let mut other = 0;
    while whole < 50 {
        let from = draw(&mut stream);
        let to = partner(&lines, &from, &mut stream);
        let [from, to] = [&from, &to].map(|q| lines.pose(q));
        let joints = |level: Level| {
            let mut memory = Memory::default();
            let mut checked = 0;
            let found = on_level(level, || lines.join_lanes(&from, &to, &mut memory, &mut checked));
            (found == Some(Ok(()))).then_some((memory.track.states, memory.track.placed))
        };
        if let Some((one, two)) = joints(best).zip(joints(least)) {
            whole += 1;
            other += u32::from(one != two);
        }
    }
    let are_alike = format!("{best:?}") == format!("{least:?}");
    assert_eq!(
        other == 0,
        are_alike,
        "{other} of {whole} paths differ in a last digit between {best:?} and {least:?}"
    );
}

#[test]
fn a_crowd_is_as_free_as_each_of_it_by_itself() {
    let cell = fu_cell();
    let cells = [mixed_cell(cell.robot()), cell];
    let mut stream = seed::stream(55);
    let mut free = [0_u32; 2];
    let mut doubts = [0_u32; 2];
    for (which, cell) in cells.iter().enumerate() {
        for round in 0..600 {
            // Groups of every size, with joints beyond their limits and angles that have no lanes among them.
            let mut states: Vec<Joints> = (0..round).map(|_| draw(&mut stream)).collect();
            for q in states.iter_mut().skip(3).step_by(29) {
                q[round % AXES] = [7.0, -7.0, f64::NAN, f64::INFINITY, 4.0][round % 5];
            }
            let expected: Vec<bool> = states.iter().map(|q| cell.is_free(q)).collect();
            free[which] += expected.iter().map(|free| u32::from(*free)).sum::<u32>();
            for level in levels() {
                let (found, lanes) =
                    on_level(level, || (cell.are_free(&states), cell.are_free_lanes(&states)));
                assert_eq!(found, expected, "seed 55 cell {which} round {round} on {level:?}");
                let differ = lanes
                    .iter()
                    .zip(&expected)
                    .position(|(lanes, free)| lanes.is_some_and(|found| found != *free));
                assert_eq!(differ, None, "seed 55 cell {which} round {round} on {level:?}");
                doubts[which] += lanes.iter().map(|found| u32::from(found.is_none())).sum::<u32>();
            }
        }
    }
    assert!(
        free.iter().all(|free| (20_000..160_000).contains(free)),
        "one-sided sample: {free:?} of 179 700"
    );
    // The mixed cell has solids without lanes.
    assert!(doubts[0] > 1_000 && doubts[1] < 100, "{doubts:?} of 359 400 in doubt");
}

#[test]
fn states_of_a_crowd_a_micrometre_from_contact_are_left_to_the_scalar_code() {
    let cell = fu_cell();
    let mut stream = seed::stream(56);
    let mut states = Vec::new();
    while states.len() < 4_000 {
        let [free, other] = [0; 2].map(|_| draw(&mut stream));
        if !cell.is_free(&free) || cell.is_free(&other) {
            continue;
        }
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..50 {
            let share = f64::midpoint(low, high);
            *(if cell.is_free(&between(&free, &other, share)) { &mut low } else { &mut high }) = share;
        }
        states.push(between(&free, &other, high + stream.random_range(-3e-7..3e-7)));
    }
    let expected: Vec<bool> = states.iter().map(|q| cell.is_free(q)).collect();
    let contacts = expected.iter().filter(|free| !**free).count();
    assert!((1_000..3_000).contains(&contacts), "one-sided sample: {contacts}");
    for level in levels() {
        let (found, lanes) = on_level(level, || (cell.are_free(&states), cell.are_free_lanes(&states)));
        assert_eq!(found, expected, "seed 56 on {level:?}");
        let doubts = lanes.iter().filter(|found| found.is_none()).count();
        assert!(doubts > 3_000, "only {doubts} of {} were passed on, on {level:?}", states.len());
    }
}
