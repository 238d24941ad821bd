//! The law of neighbour orders: turning a map together with the order of neighbours turns what is found, and changes nothing
//! else.

use super::{Build, Counts, Plan, Planner, Request, Stage, find};
use base::grid::{CornerRule, Grid2, NeighbourOrder, independent_cells};
use base::seed::{self, Stream};
use base::settings::Settings;
use rand::RngExt as _;
use world::space::{LatticeWorld, World};

const RULES: [CornerRule; 3] = [CornerRule::Allow, CornerRule::ForbidBoth, CornerRule::ForbidAny];

/// A rotation or mirror of the square: x and y are exchanged first, then turned round.
#[derive(Clone, Copy, Debug)]
struct Turn {
    exchanged: bool,
    reversed: [bool; 2],
}

impl Turn {
    fn all() -> impl Iterator<Item = Self> {
        (0..8).map(|i| Self { exchanged: i & 4 != 0, reversed: [i & 2 != 0, i & 1 != 0] })
    }

    fn step(self, [x, y]: [i32; 2]) -> [i32; 2] {
        let [x, y] = if self.exchanged { [y, x] } else { [x, y] };
        [if self.reversed[0] { -x } else { x }, if self.reversed[1] { -y } else { y }]
    }

    fn size(self, grid: &Grid2) -> [i32; 2] {
        let [width, height] = [grid.width() as i32, grid.height() as i32];
        if self.exchanged { [height, width] } else { [width, height] }
    }

    fn point(self, grid: &Grid2, at: [i32; 2]) -> [i32; 2] {
        let size = self.size(grid);
        let [x, y] = self.step(at);
        [
            if self.reversed[0] { x + size[0] - 1 } else { x },
            if self.reversed[1] { y + size[1] - 1 } else { y },
        ]
    }

    fn grid(self, grid: &Grid2) -> Grid2 {
        let [width, height] = self.size(grid).map(|side| side as u32);
        let mut turned = Grid2::new(width, height).unwrap();
        for cell in (0..grid.cell_count()).filter(|cell| !grid.is_free(*cell)) {
            let [x, y] = self.point(grid, grid.xy(cell));
            turned.set_blocked(turned.cell(x, y).unwrap(), true);
        }
        turned
    }

    fn order(self, order: NeighbourOrder) -> NeighbourOrder {
        let steps = order.steps().map(|step| self.step(step));
        let turned = NeighbourOrder::ALL.into_iter().find(|other| other.steps() == steps);
        turned.expect("the forms of an order are closed under turns")
    }
}

fn planner(name: &str, settings: toml::Table) -> Box<dyn Planner> {
    match find(name).unwrap().build {
        Build::Planner(build) => build(&Settings::composed("a test", settings)).unwrap(),
        Build::Stage(_) => panic!("{name} is a stage"),
    }
}

fn deletion(sight: &str, corners: &str) -> Box<dyn Stage> {
    let settings = toml::toml! { line_of_sight = sight
    sight_corners = corners };
    match find("delete_inflections").unwrap().build {
        Build::Stage(build) => build(&Settings::composed("a test", settings)).unwrap(),
        Build::Planner(_) => panic!("deletion is a planner"),
    }
}

/// The planner and its settings but for the order of neighbours, any of them with equal chance.
fn drawn(stream: &mut Stream) -> (&'static str, toml::Table) {
    let mut pick = |of: &[&str]| of[stream.random_range(0..of.len())].to_owned();
    let ties = pick(&["fifo", "lifo", "larger_g"]);
    if pick(&["one side", "two sides"]) == "one side" {
        let weight = pick(&["falling", "one"]);
        let weight: toml::Value = if weight == "one" { 1.into() } else { weight.into() };
        return (
            "astar",
            [("weight".to_owned(), weight), ("ties".to_owned(), ties.into())].into_iter().collect(),
        );
    }
    let settings = [
        ("weight", pick(&["one", "falling"])),
        ("meeting", pick(&["generated_any", "closed_by_other", "both_closed", "optimal_stop"])),
        ("end", pick(&["expansion", "contact"])),
        ("aim", pick(&["root", "front"])),
        ("side", pick(&["alternate", "smaller_f"])),
        ("ties", ties),
    ];
    ("bidirectional", settings.map(|(key, value)| (key.to_owned(), value.into())).into_iter().collect())
}

/// A map, its ends and its corner rule.
struct Case {
    grid: Grid2,
    rule: CornerRule,
    ends: [[i32; 2]; 2],
}

impl Case {
    fn turned(&self, turn: Turn) -> Self {
        let ends = self.ends.map(|end| turn.point(&self.grid, end));
        Self { grid: turn.grid(&self.grid), rule: self.rule, ends }
    }

    fn plan(
        &self,
        name: &str,
        settings: &toml::Table,
        order: NeighbourOrder,
        stages: &[Box<dyn Stage>],
    ) -> Plan {
        let mut settings = settings.clone();
        settings.insert("neighbours".to_owned(), toml::Value::try_from(order).unwrap());
        let world = World::Lattice(LatticeWorld::new(self.grid.clone(), self.rule));
        let [start, goal] = self.ends.map(|end| end.map(f64::from));
        let request =
            Request { world: &world, start: &start, goal: &goal, expansions: 10_000, seed: 0, trace: false };
        let plan = planner(name, settings).plan(&request).unwrap();
        stages.iter().fold(plan, |plan, stage| stage.refine(&request, plan))
    }
}

fn cells(path: &[Vec<f64>]) -> Vec<[i32; 2]> {
    path.iter().map(|point| [point[0] as i32, point[1] as i32]).collect()
}

#[test]
fn turning_a_map_with_its_neighbour_order_turns_the_path_and_keeps_every_count() {
    let mut solved = 0;
    let mut order_matters = 0;
    for number in 0..400 {
        let mut stream = seed::stream(number);
        let size = [stream.random_range(8..24), stream.random_range(8..24)];
        let ends = [0, 1].map(|_| stream.random_range(0..size[0] * size[1]));
        let grid = independent_cells(&mut stream, size, 0.25, &ends).unwrap();
        let case = Case { ends: ends.map(|end| grid.xy(end)), rule: RULES[number as usize % 3], grid };
        let (name, settings) = drawn(&mut stream);
        let sight = ["exact_interior", "closed_cells"][number as usize % 2];
        let corners = ["as_moves", "allow", "forbid_both", "forbid_any"][stream.random_range(0..4)];
        let stages = if stream.random_bool(0.5) { vec![deletion(sight, corners)] } else { Vec::new() };
        let order = NeighbourOrder::ALL[stream.random_range(0..24)];
        let plan = case.plan(name, &settings, order, &stages);
        for turn in Turn::all() {
            let other = case.turned(turn).plan(name, &settings, turn.order(order), &stages);
            let wanted: Vec<[i32; 2]> =
                cells(&plan.path).into_iter().map(|point| turn.point(&case.grid, point)).collect();
            assert_eq!(
                cells(&other.path),
                wanted,
                "seed {number}, {name}, {settings:?}, {order:?}, {turn:?}"
            );
            let counts = |plan: &Plan| -> Counts { plan.counts.clone() };
            assert_eq!(counts(&other), counts(&plan), "seed {number}, {name}, {settings:?}, {turn:?}");
            let unturned = case.turned(turn).plan(name, &settings, order, &stages);
            order_matters += u32::from(cells(&unturned.path) != wanted || counts(&unturned) != counts(&plan));
        }
        solved += u32::from(!plan.path.is_empty());
    }
    assert!(solved > 200, "{solved} of 400 solved");
    assert!(order_matters > 300, "the order changed {order_matters} searches of 3200");
}
