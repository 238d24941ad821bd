//! A path over the edges of a cube, smoothed in three ways.

use super::*;
use crate::planner::{Counts, Ending};
use base::settings::Settings;
use world::geometry::{Aabb, Convex};
use world::space::World;

fn smoothed(settings: &str) -> (World, Plan) {
    let cube = Convex::cuboid(Vec3::repeat(20.0), Vec3::repeat(10.0)).unwrap();
    let domain = Aabb { min: Vec3::zeros(), max: Vec3::repeat(40.0) };
    let world = World::Polyhedra(Box::new(PolyhedraWorld::new(vec![cube], domain, 1.0, 0.0).unwrap()));
    let path: Vec<Vec<f64>> =
        [[20.0, 20.0, 5.0], [25.01, 20.0, 14.99], [25.01, 20.0, 25.01], [20.0, 20.0, 35.0]]
            .map(|point| point.to_vec())
            .to_vec();
    let (start, goal) = (path[0].clone(), path[3].clone());
    let request = Request { world: &world, start: &start, goal: &goal, expansions: 1, seed: 0, trace: false };
    let plan = Plan {
        ending: Ending::Solved,
        path,
        cost: None,
        counts: Counts::new(),
        traces: Vec::new(),
        reason: None,
    };
    let Build::Stage(build) = ENTRY.build else { panic!("it is a stage") };
    let stage = build(&Settings::composed("test", toml::from_str(settings).unwrap())).unwrap();
    let plan = stage.refine(&request, plan);
    (world, plan)
}

fn touches(world: &World, plan: &Plan) -> bool {
    let polyhedra = world.as_polyhedra().unwrap();
    points(plan).windows(2).any(|pair| !polyhedra.is_clear(&Segment::new(pair[0], pair[1])))
}

#[test]
fn over_few_nodes_the_spline_cuts_deep_over_steps_little_and_guarded_not_at_all() {
    let (world, nodes) = smoothed("control = 'nodes'\nguarded = false\npoints_per_span = 8");
    assert!(nodes.counts["cut_in_cm"].as_f64() > 0.5 && touches(&world, &nodes), "{:?}", nodes.counts);
    let (world, steps) = smoothed("control = 'steps'\nguarded = false\npoints_per_span = 8");
    let depth = steps.counts["cut_in_cm"].as_f64();
    assert!(depth > 0.0 && depth < 0.25 && touches(&world, &steps), "{depth}");
    let (world, guarded) = smoothed("control = 'steps'\nguarded = true\npoints_per_span = 8");
    assert!(!touches(&world, &guarded));
    assert!((2.0..20.0).contains(&guarded.counts["raised_points"].as_f64()), "{:?}", guarded.counts);
    for plan in [&nodes, &steps, &guarded] {
        let smooth = points(plan);
        assert!((smooth[0] - Vec3::new(20.0, 20.0, 5.0)).norm() < 1e-9);
        assert!((smooth[smooth.len() - 1] - Vec3::new(20.0, 20.0, 35.0)).norm() < 1e-9);
    }
}
