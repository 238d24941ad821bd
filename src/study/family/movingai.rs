//! A `MovingAI` map with the queries of a scenario file.
//!
//! Queries are named after their line in the file. The optimal length that the file prints for each stands in every trial's row,
//! so that a check can hold both the verifier and the planners to it. A query whose start or goal is blocked (water, say) is an
//! invalid problem, and its trials are rows with that status. A query without a path, according to the file, is posed like any
//! other, with no optimal length.

use super::{Entry, Family, Query};
use crate::StudyError;
use crate::preprocessing::{Preprocessing, lattice};
use base::grid::{CornerRule, Scenario, Vertices, read_movingai_map, read_scenarios};
use base::ignored::ignored_note;
use base::settings::{Accepted, Faults};
use engine::planner::{Counts, Invalid, Value};
use engine::space::{LatticeWorld, WorldKind};
use schemars::JsonSchema;
use serde::Deserialize;
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// The registry's entry.
pub static ENTRY: Entry = Entry {
    name: "movingai",
    about: "a MovingAI map (.map) with the queries of a scenario file (.scen) and their printed optimal lengths",
    instances: "maps",
    revision: 1,
    is_drawn: false,
    preprocessing: lattice::ENTRY.name,
    columns: &[
        "path_cost_cells",
        "turn_exterior_deg",
        "turn_interior_deg",
        "bends",
        "optimal_cost_cells",
        "printed_optimal_cells",
    ],
    settings: Accepted::shape::<MovingAi>(),
    example: r#"
map = "data/maps/movingai_sample.map"
scenarios = "data/maps/movingai_sample.scen"
corner_rule = "allow"
vertices = "corners"
"#,
    build: |settings, inputs| {
        let read: MovingAi = settings.read()?;
        let file =
            |key: &str, name: &str| inputs.locate(name).map_err(|message| settings.error_at(key, message));
        let mut faults = Faults::default();
        let files =
            [file("map", &read.map), file("scenarios", &read.scenarios)].map(|file| faults.keep(file));
        let files = faults.or(match files {
            [Some(map), Some(scenarios)] => Some([map, scenarios]),
            _ => None,
        })?;
        let refused =
            |key: &'static str| move |e: base::grid::GridError| settings.error_at(key, e.to_string());
        let grid = read_movingai_map(&files[0]).map_err(refused("map"))?;
        let all = read_scenarios(&files[1], &grid).map_err(refused("scenarios"))?;
        read.check_names(&all).map_err(|message| settings.error_at("scenarios", message))?;
        let scenarios = read.picked(all).map_err(|message| settings.error_at("scenarios", message))?;
        let vertices = read.vertices.unwrap_or_default();
        lattice::check_rule(settings, read.corner_rule, vertices)?;
        // The files count rows downwards from the highest, so that their corner [x, y] is the upper left one of their cell.
        let up = if vertices == Vertices::Corners { 1.0 } else { 0.0 };
        let point = |cell: u32| {
            let [x, y] = grid.xy(cell).map(f64::from);
            vec![x, y + up]
        };
        let query = |s: &Scenario| Query {
            name: format!("line-{}", s.line),
            start: point(s.start),
            goal: point(s.goal),
        };
        let queries = scenarios.iter().map(query).collect();
        let world = lattice::world(grid, read.corner_rule, vertices);
        Ok::<Box<dyn Family>, StudyError>(Box::new(Posed { world, scenarios, queries, files }))
    },
};

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct MovingAi {
    /// The map, a `.map` file of the Moving AI benchmarks.
    map: String,
    /// Its queries, a `.scen` file of the Moving AI benchmarks.
    scenarios: String,
    /// The benchmark's lengths hold for `forbid_any`.
    #[serde(default = "no_corner_is_cut")]
    corner_rule: CornerRule,
    /// Where the vertices are that paths lead over; `centres` of cells if absent. At `corners`, a cell of a query stands for its upper
    /// left corner, [x, y] as the file counts, and the benchmark's lengths do not hold.
    vertices: Option<Vertices>,
    /// Only every so many-th query, from the first on; all of them if absent.
    every: Option<NonZeroUsize>,
}

fn no_corner_is_cut() -> CornerRule {
    CornerRule::ForbidAny
}

impl MovingAi {
    /// Refuses scenarios of another map, by its file name; folders may differ.
    fn check_names(&self, all: &[Scenario]) -> Result<(), String> {
        let name = |path: &str| path.rsplit('/').next().map(str::to_owned);
        match all.iter().find(|scenario| name(&scenario.map) != name(&self.map)) {
            None => Ok(()),
            Some(other) => Err(format!(
                "line {} of {} asks of map `{}`; {} is accepted",
                other.line, self.scenarios, other.map, self.map
            )),
        }
    }

    fn picked(&self, all: Vec<Scenario>) -> Result<Vec<Scenario>, String> {
        let picked: Vec<Scenario> =
            all.into_iter().step_by(self.every.map_or(1, NonZeroUsize::get)).collect();
        if picked.is_empty() { Err(format!("{} holds no query", self.scenarios)) } else { Ok(picked) }
    }
}

struct Posed {
    world: LatticeWorld,
    scenarios: Vec<Scenario>,
    queries: Vec<Query>,
    files: [PathBuf; 2],
}

impl Family for Posed {
    fn world(&self) -> WorldKind {
        lattice::kind(self.world.vertices())
    }

    fn prepare(&self, _seed: u64) -> Result<Preprocessing, Invalid> {
        Ok(lattice::prepare_map(self.world.again()))
    }

    fn queries(&self) -> &[Query] {
        &self.queries
    }

    fn known(&self, query: usize) -> Counts {
        let printed = self.scenarios[query].optimal_length_cells;
        printed.map(|length| ("printed_optimal_cells", Value::Real(length))).into_iter().collect()
    }

    fn notes(&self) -> Vec<String> {
        let without =
            self.scenarios.iter().filter(|scenario| scenario.optimal_length_cells.is_none()).count();
        let note = || format!("{}: {without} of its queries have no path, it says", self.files[1].display());
        let ignored = ignored_note(&["bucket".to_owned()].into());
        let ignored = ignored.map(|note| format!("{}: {note}", self.files[1].display()));
        (without > 0).then(note).into_iter().chain(ignored).collect()
    }

    fn cells(&self) -> u64 {
        u64::from(self.world.cells().cell_count())
    }

    fn inputs(&self) -> &[PathBuf] {
        &self.files
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Inputs;
    use crate::verification::{Guide, Truth, truth};
    use base::settings::Settings;
    use engine::planner::{Build, Request, find};
    use engine::space::World;

    const MAP: &str = "type octile\nheight 3\nwidth 4\nmap\n.@..\n.@..\n....\n";
    const SCENARIOS: &str = "version 1\n0\tm.map\t4\t3\t0\t0\t2\t0\t6\n0\tm.map\t4\t3\t0\t0\t1\t0\t1\n";

    fn build(map: &str, scenarios: &str, extra: &str) -> Result<Box<dyn Family>, String> {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("m.map"), map).unwrap();
        std::fs::write(folder.path().join("m.scen"), scenarios).unwrap();
        let table = toml::from_str(&format!("map = 'm.map'\nscenarios = 'm.scen'\n{extra}")).unwrap();
        let inputs = Inputs::below(vec![folder.path().to_owned()]);
        (ENTRY.build)(&Settings::composed("a test", table), &inputs).map_err(|e| e.to_string())
    }

    #[test]
    fn queries_are_named_by_line_and_carry_the_printed_length() {
        let family = build(MAP, SCENARIOS, "").unwrap();
        let names: Vec<&str> = family.queries().iter().map(|query| query.name.as_str()).collect();
        assert_eq!(names, ["line-2", "line-3"]);
        assert_eq!(family.queries()[0].goal, [2.0, 2.0], "y is up");
        assert_eq!(family.known(0)["printed_optimal_cells"], Value::Real(6.0));
        let world = family.prepare(1).unwrap().world;
        let lattice = world.as_lattice().unwrap();
        assert_eq!(lattice.corner_rule(), base::grid::CornerRule::ForbidAny, "no corner is cut by default");
        assert_eq!(build(MAP, SCENARIOS, "every = 2").unwrap().queries().len(), 1);
    }

    #[test]
    fn printed_lengths_are_those_of_shortest_paths_over_centres_and_over_corners() {
        // From the upper left corner of the map past a wall of two cells to the corner right of it.
        let around = [1.0 + 3.0 + std::f64::consts::SQRT_2, f64::sqrt(5.0) + 3.0];
        let at_corners = "corner_rule = 'allow'\nvertices = 'corners'";
        for (printed, extra, start, goal, expected) in [
            ("6", "", [0.0, 2.0], [2.0, 2.0], [6.0, 6.0]),
            ("5.41421356", at_corners, [0.0, 3.0], [2.0, 3.0], around),
        ] {
            let line = format!("0\tm.map\t0\t0\t2\t0\t{printed}\n");
            let family = build(MAP, &line, extra).unwrap();
            let query = &family.queries()[0];
            assert_eq!(query.ends(), [&start[..], &goal[..]], "{extra}");
            let world = family.prepare(1).unwrap().world;
            let Value::Real(known) = family.known(0)["printed_optimal_cells"] else { panic!("{extra}") };
            let [in_graph, shortest] = optima(&world, query);
            assert!((in_graph - known).abs() < 1e-6, "{extra}: {in_graph}, printed {known}");
            assert!(
                (in_graph - expected[0]).abs() < 1e-9 && (shortest - expected[1]).abs() < 1e-9,
                "{extra}"
            );
            let Build::Planner(astar) = find("astar").unwrap().build else { panic!("astar plans") };
            let settings = toml::from_str("weight = 1\nties = 'fifo'").unwrap();
            let planner = astar(&Settings::composed("a test", settings)).unwrap();
            let [start, goal] = query.ends();
            let request = Request { world: &world, start, goal, expansions: 100, seed: 0, trace: false };
            let cost = planner.plan(&request).unwrap().cost.unwrap();
            assert!((cost - known).abs() < 1e-6, "{extra}: {cost}, printed {known}");
        }
    }

    /// The least cost in the graph and the length of the shortest path, as the verifier finds them.
    fn optima(world: &World, query: &Query) -> [f64; 2] {
        match truth(world, query, &Guide::default()) {
            Truth::Corners(Some(least)) => [least.in_graph, least.shortest],
            other => [other.optimal().unwrap(); 2],
        }
    }

    #[test]
    fn bad_files_are_refused_by_name_and_line() {
        for (map, scenarios, extra, message) in [
            (&MAP[5..], SCENARIOS, "", "m.map: line 1: found"),
            (&MAP.replace('@', "?")[..], SCENARIOS, "", "m.map: line 5, column 2: found `?`"),
            (
                &MAP.replace("height 3", "height 4")[..],
                SCENARIOS,
                "",
                "found 3 rows of cells; the header promises 4",
            ),
            (MAP, &SCENARIOS.replace("\t4\t3", "\t5\t3")[..], "", "m.scen: line 2: found `5 3`"),
            (MAP, "version 1\n", "", "m.scen holds no query"),
            (
                MAP,
                &SCENARIOS
                    .replace("1\tm.map", "1\tother/n.map")
                    .replace("0\tm.map\t4\t3\t0\t0\t1", "0\tn.map\t4\t3\t0\t0\t1")[..],
                "",
                "line 3 of m.scen asks of map `n.map`; m.map is accepted",
            ),
            (MAP, SCENARIOS, "every = 0", "`every` is 0; a whole number of 1 or more is accepted"),
            (MAP, SCENARIOS, "corner = 1", "unknown key `corner`"),
        ] {
            let error = build(map, scenarios, extra).err().unwrap();
            assert!(error.contains(message), "{error}\nlacks\n{message}");
        }
        let table = toml::from_str("map = 'none.map'\nscenarios = 'none.scen'").unwrap();
        let error =
            (ENTRY.build)(&Settings::composed("a test", table), &Inputs::below(vec!["nowhere".into()]));
        let error = error.err().unwrap().to_string();
        assert!(
            error.contains("input file `none.map` does not exist; looked for nowhere/none.map"),
            "{error}"
        );
    }
}
