//! Planners: one a file, all in [`REGISTRY`], over the kernel of `search`.
//!
//! A contender is a pipeline: a planner finds a plan, then stages tidy it. Both are entries of one registry; an
//! entry says what world it needs, what columns its counts fill, and how to build it from its settings. Nothing
//! here knows studies or records; nothing outside an entry's file knows its settings.

mod any_angle;
mod ap_theta_star;
mod astar;
mod astar_octile;
mod bidirectional;
mod bspline;
mod chaos_astar;
mod corners;
mod delete_inflections;
mod direct;
mod entry;
mod field_dstar;
mod joint_astar;
mod joint_bspline;
mod jps;
mod jps_plus;
mod jump_points;
mod key_nodes;
mod keynode_astar;
mod lattice;
mod lattice26_astar;
mod lattice_astar;
mod lazy_theta_star;
#[cfg(test)]
mod mirrors;
mod one_side;
mod polyhedra;
mod pool;
mod post_smooth;
mod posture;
mod posture_turns;
mod prm_star;
mod roadmap;
mod roadmap_astar;
mod roadmap_cost;
mod rrt;
mod rrt_connect;
mod rrt_star;
mod sampled;
mod shorten_best;
mod simplify_path;
mod straighten;
mod straighten_from_previous;
mod theta_star;
mod tips;
mod visibility_astar;
mod visibility_edges;

pub use entry::{Build, Counts, Ending, Entry, Invalid, Plan, Planner, Request, Stage, Trace, Value};

/// Every planner and stage, in the order of their names.
pub static REGISTRY: &[&Entry] = &[
    &ap_theta_star::ENTRY,
    &astar::ENTRY,
    &astar_octile::ENTRY,
    &bidirectional::ENTRY,
    &bspline::ENTRY,
    &chaos_astar::ENTRY,
    &delete_inflections::ENTRY,
    &direct::ENTRY,
    &field_dstar::ENTRY,
    &joint_astar::ENTRY,
    &joint_bspline::ENTRY,
    &jps::ENTRY,
    &jps_plus::ENTRY,
    &keynode_astar::ENTRY,
    &lattice26_astar::ENTRY,
    &lattice_astar::ENTRY,
    &lazy_theta_star::ENTRY,
    &post_smooth::ENTRY,
    &posture::ENTRY,
    &posture_turns::ENTRY,
    &prm_star::ENTRY,
    &roadmap_astar::ENTRY,
    &roadmap_cost::ENTRY,
    &rrt::ENTRY,
    &rrt_connect::ENTRY,
    &rrt_star::ENTRY,
    &shorten_best::ENTRY,
    &simplify_path::ENTRY,
    &straighten::ENTRY,
    &straighten_from_previous::ENTRY,
    &theta_star::ENTRY,
    &visibility_astar::ENTRY,
    &visibility_edges::ENTRY,
];

/// The entry called `name`.
pub fn find(name: &str) -> Option<&'static Entry> {
    REGISTRY.iter().copied().find(|entry| entry.name == name)
}
