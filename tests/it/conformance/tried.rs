//! With which settings every entry is tried, and what is not asked of which: each exception is the smallest that its
//! entry needs, and one that nothing needs any more fails.

use base::settings::Settings;
use engine::planner::Entry;
use engine::space::WorldKind;
use std::collections::BTreeSet;

/// The settings that each entry is tried with.
pub const SETTINGS: &[(&str, &[&str])] = &[
    ("ap_theta_star", &["ties = 'smaller_g'", "ties = 'larger_g'"]),
    (
        "astar",
        &[
            "weight = 0\nties = 'fifo'",
            "weight = 1\nties = 'fifo'",
            "weight = 1\nties = 'lifo'",
            "weight = 1\nties = 'larger_g'",
            "weight = 3\nties = 'fifo'",
            "heuristic = 'octile'\nties = 'smaller_g'",
        ],
    ),
    ("astar_octile", &[""]),
    (
        "bidirectional",
        &[
            "weight = 'one'\nmeeting = 'optimal_stop'\nside = 'alternate'\nties = 'fifo'",
            "weight = 'one'\nmeeting = 'optimal_stop'\nside = 'smaller_f'\nties = 'larger_g'",
            "weight = 'one'\nmeeting = 'both_closed'\nside = 'smaller_f'\nties = 'lifo'",
            "weight = 'falling'\nmeeting = 'generated_any'\nside = 'alternate'\nties = 'fifo'",
            "weight = 'falling'\nmeeting = 'closed_by_other'\nside = 'alternate'\nties = 'fifo'",
        ],
    ),
    (
        "bspline",
        &[
            "control = 'steps'\nguarded = true\npoints_per_span = 2",
            "control = 'nodes'\nguarded = true\npoints_per_span = 5",
            "control = 'nodes'\nguarded = false\npoints_per_span = 3",
        ],
    ),
    (
        "chaos_astar",
        &[
            "region_shape = 'square'\nregion_radius_cells = 2\nneighbours = 16\ndrawn = 'each_expansion'\nsource = \
             'uniform'\ngoal_in_region = 'included'\nopen_node = 'lowered'\nties = 'fifo'",
            "region_shape = 'square'\nregion_radius_cells = 2\nneighbours = 20\ndrawn = 'once_per_run'\nsource = \
             'logistic'\ngoal_in_region = 'as_drawn'\nopen_node = 'never'\nties = 'lifo'",
        ],
    ),
    ("delete_inflections", &["line_of_sight = 'exact_interior'", "line_of_sight = 'closed_cells'"]),
    ("direct", &[""]),
    (
        "field_dstar",
        &[
            "ties = 'larger_g'\ninterpolates = 'opened'\nextraction = 'looks_ahead'",
            "ties = 'smaller_g'\ninterpolates = 'expanded'\nextraction = 'interpolated'",
        ],
    ),
    ("joint_astar", &["delta_deg = 12.0\nneighbours = 12"]),
    (
        "joint_bspline",
        &[
            "control = 'trail'\nguarded = true\npoints_per_span = 2",
            "control = 'off'\nguarded = true\npoints_per_span = 2",
        ],
    ),
    ("jps", &["", "preparation = 'each_query'"]),
    ("jps_plus", &["", "preparation = 'each_query'"]),
    (
        "keynode_astar",
        &[
            "search = 'open_list'\ncluster = true\nlast_resort = true",
            "search = 'open_list'\ncluster = false\nlast_resort = false",
            "search = 'greedy'\ncluster = false\nlast_resort = false",
            "search = 'greedy'\ncluster = false\nlast_resort = false\nlegs = 'last_joined'",
            "search = 'open_list'\ncluster = true\nlast_resort = true\nlegs = 'first_refused'",
            "search = 'literal'\ncluster = false\nlast_resort = false",
        ],
    ),
    (
        "lattice26_astar",
        &[
            "checked = 'segments'\nties = 'fifo'",
            "checked = 'segments'\nties = 'larger_g'",
            "checked = 'nodes'\nties = 'lifo'",
        ],
    ),
    (
        "lattice_astar",
        &[
            "neighbourhood = { shape = 'square', radius_cells = 1 }\nopen_node = 'lowered'\nties = 'fifo'",
            "neighbourhood = { shape = 'disc', radius_cells = 2 }\nopen_node = 'lowered'\nties = 'larger_g'",
            "neighbourhood = { shape = 'square', radius_cells = 2 }\nopen_node = 'never'\nties = 'lifo'",
        ],
    ),
    (
        "lazy_theta_star",
        &["line_of_sight = 'exact_interior'", "line_of_sight = 'closed_cells'\nties = 'lifo'"],
    ),
    (
        "post_smooth",
        &[
            "line_of_sight = 'exact_interior'\nfrom = 'start'",
            "line_of_sight = 'exact_interior'\nfrom = 'goal'",
        ],
    ),
    (
        "posture",
        &[
            "adjust = true\nsign = 'down'\nclamp = 'floor'\ndistance = 'exact'\npose = 'inverse'\ndamping = 0.02\n\
             act_cm = 2.0\nd0_cm = 5.0\nstep_rad = 0.03\niterations = 20\nbounds_rad = [0.2, 0.2, 0.1]\n\
             bounds = 'per_node'\nrecovery_rad = 0.02\nbranches = 'all'\ndiagnose = false",
            "adjust = true\nsign = 'as_printed'\nclamp = 'literal'\ndistance = 'exact'\npose = 'jacobian'\n\
             damping = 0.0\nact_cm = 2.0\nd0_cm = 5.0\nstep_rad = 0.03\niterations = 5\n\
             bounds_rad = [0.2, 0.2, 0.1]\nbounds = 'from_start'\nrecovery_rad = 0.02\nbranches = 'clearest'\n\
             diagnose = true",
            "adjust = false\nsign = 'down'\nclamp = 'floor'\ndistance = 'printed'\npose = 'inverse'\ndamping = 0.02\n\
             act_cm = 2.0\nd0_cm = 5.0\nstep_rad = 0.03\niterations = 5\nbounds_rad = [0.2, 0.2, 0.1]\n\
             bounds = 'per_node'\nrecovery_rad = 0.02\nbranches = 'all'\ndiagnose = false",
        ],
    ),
    ("posture_turns", &["bounds_rad = [0.2, 0.2, 0.1]"]),
    (
        "prm_star",
        &[
            "sampler = 'halton'\niterations = 300\ngrowth = 1.2",
            "sampler = 'seeded'\niterations = 300\nnearest = 30",
        ],
    ),
    (
        "roadmap_astar",
        &[
            "samples = 40\nneighbour_mm = 30.0\ncost = 'hops'\ngoal_shot = 'never'\npath = 'parents'",
            "samples = 40\nneighbour_mm = 30.0\ncost = 'length'\ngoal_shot = 'never'\npath = 'parents'",
            "samples = 40\nneighbour_mm = 30.0\ncost = 'length'\nblind = true\ngoal_shot = 'never'\npath = 'parents'",
            "samples = 40\nneighbour_mm = 30.0\ncost = 'hops'\ngoal_shot = 'before_expansion'\npath = 'parents'",
        ],
    ),
    ("roadmap_cost", &[""]),
    (
        "rrt",
        &[
            "range = 20\nsampler = 'halton'\ngoal_share = 0\niterations = 2000",
            "range = 20\nsampler = 'seeded'\ngoal_share = 0.1\niterations = 2000",
        ],
    ),
    (
        "rrt_connect",
        &[
            "range = 20\nsampler = 'halton'\nbalance = 1\ndynamic_domain = { radius = 40, alpha = 0.1, least_radius = 10 }\n\
             first = 'start'\niterations = 2000\nnodes = 2000",
            "range = 20\nsampler = 'seeded'\nfirst = 'goal'\niterations = 2000\nnodes = 2000",
        ],
    ),
    (
        "rrt_star",
        &[
            "range = 20\nsampler = 'halton'\ngoal_share = 0.05\niterations = 600\ninformed = false",
            "range = 20\nsampler = 'seeded'\ngoal_share = 0.05\niterations = 600\ninformed = true",
            "range = 20\nreach = 10\nsampler = 'seeded'\ngoal_share = 0.05\niterations = 600\ninformed = false\nnearest_parent = true",
        ],
    ),
    ("shorten_best", &["least = 'length'", "least = 'nodes'"]),
    (
        "simplify_path",
        &[
            "rounds = 5\noperations = ['shortcut', 'bspline']\nbspline = { rounds = 1, least_change = 0.1, share = 0.5 }",
            "rounds = 5\noperations = ['reduce']\nreduce = { tries = 10, empty_tries = 5, range_share = 0.5 }",
        ],
    ),
    ("straighten", &["last = 'as_printed'", "last = 'goal'"]),
    ("straighten_from_previous", &["resume = 'last_joined'", "resume = 'first_refused'", "resume = 'off'"]),
    (
        "theta_star",
        &[
            "line_of_sight = 'exact_interior'",
            "line_of_sight = 'closed_cells'\nties = 'larger_g'",
            "line_of_sight = 'exact_interior'\nweight = 0.5\nreopen = true\nbranching = 'sixteen'",
        ],
    ),
    ("visibility_astar", &["ties = 'larger_g'\nvertices = 'all'", "ties = 'fifo'\nvertices = 'convex'"]),
    ("visibility_edges", &["spacing_cm = 2.0"]),
];

/// Planners that have nothing to show but their path.
pub const WITHOUT_TRACES: &[&str] = &[
    "astar_octile",
    "direct",
    "jps",
    "jps_plus",
    "keynode_astar",
    "lattice26_astar",
    "rrt",
    "rrt_connect",
    "visibility_edges",
];

/// An entry, one of its settings, and the value under which a property is not asked of it.
pub type Exception = (&'static str, &'static str, &'static str);

/// As their papers print them, these look at points only: what is between them may be refused.
pub const LOOK_AT_POINTS: &[Exception] =
    &[("keynode_astar", "search", "literal"), ("lattice26_astar", "checked", "nodes")];

/// A spline that nothing guards cuts corners: what it makes of an accepted path may be refused.
pub const CUT_IN: &[Exception] = &[("bspline", "guarded", "false")];

/// The tip drifts where joints follow the Jacobian or are smoothed, so that its path may be longer than the one it follows.
pub const DRIFT: &[Exception] = &[("joint_bspline", "control", "trail"), ("posture", "pose", "jacobian")];

/// Stages that count and touch nothing, whether a plan is solved or not.
pub const COUNTING: &[&str] = &["roadmap_cost"];

/// Stages that are told to leave a path as it is.
pub const OFF: &[Exception] = &[
    ("joint_bspline", "control", "off"),
    ("posture_turns", "bounds_rad", "[0.2, 0.2, 0.1]"),
    ("straighten_from_previous", "resume", "off"),
];

/// Stages that take the paths of another kind of world's planners: `posture` makes joint angles of a tip's path.
pub const FED_BY: &[(&str, WorldKind)] = &[("posture", WorldKind::Polyhedra)];

/// Stages that follow a path instead of shortening it, and have none to give where they cannot.
pub const FOLLOWING: &[&str] = &["posture"];

/// Whether an exception is made for the entry under these settings.
pub fn is_among(exceptions: &[Exception], entry: &Entry, settings: &Settings) -> bool {
    let is_set = |&(name, key, value): &Exception| {
        let text = |found: &toml::Value| found.as_str().map_or_else(|| found.to_string(), str::to_owned);
        name == entry.name && settings.table().get(key).map(text).as_deref() == Some(value)
    };
    exceptions.iter().any(is_set)
}

pub fn names(exceptions: &[Exception]) -> BTreeSet<&'static str> {
    exceptions.iter().map(|(name, ..)| *name).collect()
}
