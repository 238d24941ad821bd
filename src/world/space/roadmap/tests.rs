use super::*;
use crate::geometry::Vec2;
use crate::geometry::planar::ConvexPolygon;
use base::seed;
use rand::RngExt as _;

fn map() -> PlaneMap {
    let rectangle =
        |a: [f64; 2], b: [f64; 2]| ConvexPolygon::rectangle(Vec2::from(a), Vec2::from(b)).unwrap();
    PlaneMap::new(
        [100.0, 100.0],
        vec![rectangle([30.0, 0.0], [40.0, 70.0]), rectangle([60.0, 40.0], [70.0, 100.0])],
    )
}

fn samples(seed: u64, count: usize) -> Vec<Sample> {
    let mut stream = seed::stream(seed::derive(seed, &["roadmap"]));
    let plane = map();
    let mut found = Vec::new();
    let mut draws = 0;
    while found.len() < count {
        let point = [stream.random_range(0.0..100.0), stream.random_range(0.0..100.0)];
        if plane.refusal(point).is_none() {
            found.push(Sample { config: point.to_vec(), drawn_after: draws });
        }
        draws += 1;
    }
    found
}

fn built(samples: &[Sample], radius_mm: f64, counted: Counted) -> Roadmap {
    Roadmap::build(Local::Plane(map()), samples.to_vec(), Near::Places(radius_mm), counted)
}

#[test]
fn the_first_samples_and_a_smaller_radius_give_the_roadmap_that_is_built_from_them() {
    let all = samples(1, 80);
    let whole = built(&all, 40.0, Counted::Accepted);
    assert!(whole.tally().edges > 100 && whole.tally().rejected[Rejection::Contact as usize] > 100);
    for (count, radius_mm) in [(80, 40.0), (50, 40.0), (80, 25.0), (33, 15.0)] {
        let part = built(&all[..count], radius_mm, Counted::Accepted);
        let mut edges = 0;
        for node in 0..count as u32 {
            let links = whole.links(node);
            let kept = links.iter().filter(|(to, gap)| (*to as usize) < count && *gap <= radius_mm);
            let kept: Vec<(u32, f64)> = kept.copied().collect();
            assert_eq!(kept, *part.links(node), "{count} samples, {radius_mm} mm, node {node}");
            edges += kept.len() as u64;
        }
        assert_eq!(edges, 2 * part.tally().edges);
        assert!(part.tally().edges > 0);
        assert_eq!(*whole.components(count as u32, radius_mm), *part.components(count as u32, radius_mm));
    }
}

#[test]
fn components_are_what_a_flood_finds() {
    let mut parts = 0;
    for seed in 0..20 {
        let roadmap = built(&samples(seed, 60), 14.0, Counted::Accepted);
        let found = roadmap.components(60, 14.0);
        let mut flood = vec![u32::MAX; 60];
        for first in 0..60_u32 {
            let mut open = vec![first];
            while let Some(node) = open.pop() {
                if flood[node as usize] == u32::MAX {
                    flood[node as usize] = first;
                    open.extend(roadmap.links(node).iter().map(|(to, _)| *to));
                }
            }
        }
        assert_eq!(*found, flood, "seed {seed}");
        parts += flood.iter().zip(0..).filter(|(part, node)| **part == *node).count();
    }
    assert!(parts > 60, "one-sided sample: {parts} components in 20 roadmaps");
}

#[test]
fn draws_count_less_than_samples_that_were_accepted() {
    let all = samples(3, 30);
    let roadmap = built(&all, 20.0, Counted::Drawn);
    let kept = roadmap.prefix(25).unwrap();
    assert!(kept < 25, "{kept} of the first 25 draws were accepted");
    assert!(all[..kept as usize].iter().all(|sample| sample.drawn_after < 25));
    assert!(all[kept as usize].drawn_after >= 25);
    let accepted = built(&all, 20.0, Counted::Accepted);
    assert_eq!(accepted.prefix(30), Ok(30));
    assert_eq!(accepted.prefix(31).unwrap_err(), "31 samples are requested; the roadmap was built with 30");
}

#[test]
fn an_end_is_joined_with_the_samples_it_sees_and_known_again() {
    let roadmap = built(&samples(4, 60), 30.0, Counted::Accepted);
    let end = roadmap.number("start", &[5.0, 5.0]).unwrap();
    assert_eq!(roadmap.number("goal", &[5.0, 5.0]), Ok(end));
    assert_eq!((end, roadmap.node_count()), (60, 61));
    for (node, sample) in roadmap.samples().iter().enumerate() {
        let [x, y] = [sample.config[0], sample.config[1]];
        let gap_mm = libm::hypot(x - 5.0, y - 5.0);
        let sees = gap_mm <= 30.0 && map().sees([5.0, 5.0], [x, y]);
        assert_eq!(roadmap.links(end).iter().any(|(to, _)| *to as usize == node), sees, "node {node}");
        assert_eq!(roadmap.join(end, node as u32).is_ok(), map().sees([5.0, 5.0], [x, y]), "node {node}");
    }
    let refused = roadmap.number("goal", &[35.0, 5.0]).unwrap_err();
    assert_eq!(refused, "the goal cannot be posed: [35.0, 5.0] is in obstacle 1");
    let refused = roadmap.number("goal", &[35.0]).unwrap_err();
    assert!(refused.contains("it has 1 numbers; a configuration has 2"), "{refused}");
}

/// The pairs of neighbours among `samples`, by looking at all of them.
fn near_pairs(samples: &[Sample], near: Near) -> Vec<(u32, u32)> {
    let gap = |a: usize, b: usize| -> f64 {
        samples[a].config.iter().zip(&samples[b].config).map(|(a, b)| (a - b) * (a - b)).sum()
    };
    let chosen = |own: usize| -> Vec<usize> {
        let mut others: Vec<usize> = (0..samples.len()).filter(|other| *other != own).collect();
        match near {
            Near::Nearest(count) => {
                others.sort_by(|a, b| gap(own, *a).total_cmp(&gap(own, *b)));
                others.truncate(count);
            }
            Near::Configurations(radius) | Near::Places(radius) => {
                others.retain(|other| gap(own, *other) <= radius * radius);
            }
        }
        others
    };
    let both = |(a, b): (usize, usize)| (a.min(b) as u32, a.max(b) as u32);
    let mut pairs: Vec<_> = (0..samples.len())
        .flat_map(|own| chosen(own).into_iter().map(move |other| both((own, other))))
        .collect();
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}

#[test]
fn neighbours_by_configuration_are_those_that_a_look_at_all_pairs_finds() {
    let mut edges = 0;
    let mut tried = 0;
    for seed in 0..40 {
        let count = [1, 2, 15, 16, 17, 40, 90, 300][seed as usize % 8];
        let mut all = samples(seed, count);
        if seed % 2 == 1 {
            // Equal distances by the dozen.
            for x in all.iter_mut().flat_map(|sample| &mut sample.config) {
                *x = (*x / 9.0).round() * 9.0;
            }
            all.retain(|sample| map().refusal([sample.config[0], sample.config[1]]).is_none());
        }
        for near in [Near::Nearest(1), Near::Nearest(6), Near::Nearest(500), Near::Configurations(18.0)] {
            let roadmap = Roadmap::build(Local::Plane(map()), all.clone(), near, Counted::Accepted);
            let expected = near_pairs(&all, near);
            let what = format!("seed {seed}, {} samples, {near:?}", all.len());
            assert_eq!(roadmap.tally().pairs, expected.len() as u64, "{what}");
            let joined = |(a, b): &(u32, u32)| roadmap.join(*a, *b).is_ok();
            let free: Vec<_> = expected.into_iter().filter(joined).collect();
            for own in 0..all.len() as u32 {
                let others = free.iter().filter(|(a, b)| *a == own || *b == own).map(|(a, b)| a + b - own);
                let mut others: Vec<u32> = others.collect();
                others.sort_unstable();
                let links: Vec<u32> = roadmap.links(own).iter().map(|(to, _)| *to).collect();
                assert_eq!(links, others, "{what}, node {own}");
            }
            (edges, tried) = (edges + free.len(), tried + roadmap.tally().pairs);
        }
    }
    assert!(edges > 10_000 && tried > edges as u64 + 10_000, "{edges} edges of {tried}");
}

#[test]
fn an_end_is_joined_with_what_it_would_be_near_as_a_sample() {
    let all = samples(3, 121);
    let (rest, ends) = all.split_at(119);
    for near in [Near::Nearest(6), Near::Configurations(18.0), Near::Places(18.0)] {
        let roadmap = Roadmap::build(Local::Plane(map()), rest.to_vec(), near, Counted::Accepted);
        let [start, goal] = [0, 1].map(|i| roadmap.number("end", &ends[i].config).unwrap());
        for (end, sample) in [(start, &ends[0]), (goal, &ends[1])] {
            let square = |a: &Sample| (0..2).map(|i| (a.config[i] - sample.config[i]).powi(2)).sum::<f64>();
            let mut others: Vec<u32> = (0..119).collect();
            others.sort_by(|a, b| square(&rest[*a as usize]).total_cmp(&square(&rest[*b as usize])));
            match near {
                Near::Nearest(count) => others.truncate(count),
                _ => others.retain(|other| square(&rest[*other as usize]) <= 18.0 * 18.0),
            }
            others.retain(|other| roadmap.join(end, *other).is_ok());
            others.sort_unstable();
            let links: Vec<u32> = roadmap.links(end).iter().map(|(to, _)| *to).collect();
            assert_eq!(links, others, "seed 3, {near:?}, end {end}");
            assert!(links.len() > 2, "{links:?}");
        }
        let far = roadmap.number("end", &[1.0, 1.0]).unwrap();
        let beside = roadmap.number("end", &[2.0, 1.0]).unwrap();
        let across = roadmap.number("end", &[99.0, 1.0]).unwrap();
        assert_eq!([roadmap.are_near(far, beside), roadmap.are_near(far, across)], [true, false], "{near:?}");
    }
}
