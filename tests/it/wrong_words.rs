//! Wrong words in specs, with what must be said about each.

/// A wrong edit of the tiny paper and what must be said about it.
pub struct Wrong {
    pub file: &'static str,
    pub from: &'static str,
    pub to: &'static str,
    pub expected: &'static str,
}

const fn wrong(file: &'static str, from: &'static str, to: &'static str, expected: &'static str) -> Wrong {
    Wrong { file, from, to, expected }
}

/// One wrong word each, in every place that a spec has.
pub const WRONG: &[Wrong] = &[
    wrong("draws", "[budget]", "[budget", "mini/draws.toml:5:8: "),
    wrong(
        "draws",
        "seed = 7\n",
        "",
        "mini/draws.toml:1:1: missing key `seed` (The root of every seed); a whole number of 0 or more is",
    ),
    wrong(
        "draws",
        "seed = 7",
        "seed = -1",
        "mini/draws.toml:3:8: `seed` is -1; a whole number of 0 or more is accepted",
    ),
    wrong(
        "draws",
        "expansions = 10_000",
        "expansions = 0",
        "mini/draws.toml:6:14: `expansions` is 0; a whole number from 1 to 1000000000000 is",
    ),
    wrong(
        "draws",
        "seed = 7",
        "seed = 'seven'",
        "mini/draws.toml:3:8: `seed` is \"seven\"; a whole number of 0 or more is accepted",
    ),
    wrong(
        "draws",
        "question",
        "questoin",
        "mini/draws.toml:2:1: unknown key `questoin` (did you mean `question`?); accepted: `budget`, ",
    ),
    wrong(
        "draws",
        "planner = \"astar\"",
        "planner = \"a-star\"",
        "mini/draws.toml:23:11: contender `A*` asks for planner `a-star`, which does not exist (did you mean `astar`?); the planners are ",
    ),
    wrong(
        "draws",
        "\"delete_inflections\"",
        "\"astar\"",
        "mini/draws.toml:30:19: contender `Two-sided` asks for stage `astar`, which does not exist; the stages are ",
    ),
    wrong(
        "draws",
        "weight = 1,",
        "wait = 1,",
        "mini/draws.toml:24:14: unknown key `wait`; accepted: `equal_ways`, `heuristic`, `neighbours`, `ties`, `weight`",
    ),
    wrong(
        "draws",
        "weight = 1,",
        "weight = -1,",
        "mini/draws.toml:24:23: weight is -1; 0 (Dijkstra), 1 (A*), any larger number, or",
    ),
    wrong(
        "draws",
        "\"fifo\" }\n\n",
        "\"filo\" }\n\n",
        "mini/draws.toml:24:33: `ties` is \"filo\" (did you mean `fifo`?); \"fifo\", \"lifo\", \"larger_g\" or \"smaller_g\" is accepted",
    ),
    wrong(
        "draws",
        "\"random_cells\"",
        "\"random_cell\"",
        "mini/draws.toml:17:10: there is no problem family `random_cell` (did you mean `random_cells`?); there are ",
    ),
    wrong(
        "draws",
        "seed = 7",
        "seed = 7\ntask = \"plna\"",
        "mini/draws.toml:4:8: there is no task `plna` (did you mean `plan`?); there are ",
    ),
    wrong(
        "draws",
        "instances = 24",
        "instances = 0",
        "mini/draws.toml:18:13: `instances` is 0; a whole number from 1 to 1000000 is",
    ),
    wrong(
        "paper",
        "default = \"allow\"",
        "default = \"deny\"",
        "mini/paper.toml:54:11: choice `corners` has no option `deny`; it has allow,",
    ),
    wrong(
        "paper",
        "problem = { corner_rule = \"forbid_any\" }",
        "problem = { corner_rule = \"never\" }",
        "paper.toml:58:27: `corner_rule` is \"never\"; \"allow\", \"forbid_both\" or \"forbid_any\" is",
    ),
    wrong(
        "draws",
        "label = \"Two-sided\"",
        "label = \"a-star\"",
        "the second to be called `a-star` in trial names",
    ),
    wrong(
        "draws",
        "label = \"Two-sided\"",
        "label = \"Two\\u0007sided\"",
        "`label` holds a control character; text that can be seen is accepted",
    ),
    wrong("draws", "\"mini\"", "\"maxi\"", "`paper` is `maxi`, but the study lies in the folder of `mini`"),
    wrong(
        "draws",
        "goal = [11, 9]",
        "goal = [12, 9]",
        "mini/draws.toml:19:60: goal is [12, 9], outside the map; cells from [0, 0] to [11, 11] are accepted",
    ),
    wrong(
        "room",
        "start = [0, 0]",
        "start = [3, 0]",
        "mini/room.toml:16:44: the start [3.0, 0.0] is blocked",
    ),
    wrong(
        "room",
        "goal = [6, 3]",
        "goal = [7, 3]",
        "the goal [7.0, 3.0] is not a cell of the map; cells from [0, 0] to [6, ",
    ),
    wrong(
        "room",
        "room.map.txt",
        "hall.map.txt",
        "input file `hall.map.txt` does not exist; looked for ./mini/hall",
    ),
    wrong(
        "room",
        "\"grid_search\"",
        "\"grid_saerch\"",
        "mini/room.toml:25:8: figure `fig1` is of kind `grid_saerch`, which does not exist (did you mean `grid_search`?); the kinds are ",
    ),
    wrong(
        "room",
        "contenders = [\"A*\"]",
        "contenders = [\"B*\"]",
        "mini/room.toml:28:49: no contender is called `B*`; they are A*",
    ),
    wrong(
        "room",
        "shows = [{ problems = \"room\"",
        "shows = [{ problems = \"hall\"",
        "mini/room.toml:27:23: no problem group is called `hall`",
    ),
    wrong(
        "room",
        "shows = [{ problems = \"room\", instances = 1 }]\n",
        "",
        "mini/room.toml:24:6: figure `fig1` draws what is kept of trials on `room`, and none is kept; accepted is shows = [",
    ),
    wrong(
        "draws",
        "instances = 24",
        "instances = 4000000000",
        "mini/draws.toml:18:13: `instances` is 4000000000; a whole number from 1 to 1000000 is accepted",
    ),
    wrong(
        "room",
        "id = \"fig1\"",
        "id = \"../fig1\"",
        "mini/room.toml:24:6: the id `../fig1` names files; a to z, 0 to 9 and _",
    ),
    wrong(
        "room",
        "id = \"fig1\"",
        "id = \"table1\"",
        "mini/paper.toml:20:6: another figure or table of the paper is called `table1`",
    ),
    wrong("paper", "id = \"table1\"", "id = \"Table\"", "mini/paper.toml:20:6: the id `Table` names files"),
    wrong(
        "room",
        "settings = { problems = [\"room\"], contenders = [\"A*\"] }",
        "",
        "mini/room.toml:24:6: figure `fig1` has no settings: missing key `problems` (",
    ),
    wrong(
        "room",
        "map = \"room.map.txt\"",
        "map = \"..\"",
        "input file `..` is a folder (./mini/..); a regular file is",
    ),
    wrong("room.map", "#", "x", "room.map.txt: line 3, column 4: found `x`; a cell is one of"),
    wrong(
        "paper",
        "table.check.exists",
        "table.check.exist",
        "claim `cost`: there is no criterion `exist` (did you mean `exists`?); there are equals, exists, ",
    ),
    wrong(
        "paper",
        "metric = \"nodes\"",
        "metric = \"knots\"",
        "mini/paper.toml:39:10: there is no metric `knots`, nor a choice that gives the name a meaning; the metrics are ",
    ),
    wrong(
        "paper",
        "metric = \"path_cost_cells\"",
        "metric = \"plan_time_us\"",
        "mini/paper.toml:26:10: study `room` does not produce the metric `plan_time_us`; it produces ",
    ),
    wrong(
        "paper",
        "study = \"draws\"",
        "study = \"drawn\"",
        "mini/paper.toml:37:9: there is no study `drawn` (did you mean `draws`?); there are draws, room",
    ),
    wrong(
        "paper",
        "contender = \"Two-sided\"",
        "contender = \"Two\"",
        "mini/paper.toml:40:13: study `draws` has no contender `Two` (did you mean `Two-sided`?); it has A*, Two-sided",
    ),
    wrong(
        "paper",
        "printed = [\"7.83\"]",
        "printed = [\"7,83\"]",
        "mini/paper.toml:24:49: claim `cost`: printed is `7,83`",
    ),
    wrong(
        "paper",
        "figures = 1",
        "figures = 2",
        "the inventory has no row for Fig. 2; the paper has 2 of its kind",
    ),
    wrong(
        "paper",
        "figures = [\"fig1\"]",
        "figures = [\"fig2\"]",
        "mini/paper.toml:13:12: there is no figure or table `fig2` (did you mean `fig1`?); there are fig1, tab",
    ),
    wrong(
        "room",
        "kind = \"grid_search\"",
        "kind = \"tradeoff\"",
        "is of kind `tradeoff`, which does not exist (it is `statistics` now)",
    ),
    wrong(
        "room",
        "kind = \"grid_search\"\ncaption = \"A search in a room.\"\nshows = [{ problems = \"room\", instances = 1 }]\nsettings = { problems = [\"room\"], contenders = [\"A*\"] }",
        "kind = \"statistics\"\ncaption = \"What is saved.\"\nsettings = { panels = [{ x = \"contenders\", y = \"opened\" }] }",
        "mini/room.toml:27:48: panel 1: no statistic is along these axes",
    ),
    wrong(
        "room",
        "kind = \"grid_search\"\ncaption = \"A search in a room.\"\nshows = [{ problems = \"room\", instances = 1 }]\nsettings = { problems = [\"room\"], contenders = [\"A*\"] }",
        "kind = \"statistics\"\ncaption = \"What is saved.\"\nsettings = { panels = [{ y = \"contenders\", x = \"solved\", marks = [\"box\"] }] }",
        "mini/room.toml:27:66: panel 1: `marks` has box; accepted are point",
    ),
    // Of two panels, the fault of the second is reported beside that of the first.
    wrong(
        "room",
        "kind = \"grid_search\"\ncaption = \"A search in a room.\"\nshows = [{ problems = \"room\", instances = 1 }]\nsettings = { problems = [\"room\"], contenders = [\"A*\"] }",
        "kind = \"statistics\"\ncaption = \"What is saved.\"\nsettings = { panels = [{ x = \"contenders\", y = \"opened\" }, { y = \"contenders\", x = \"solved\", marks = [\"box\"] }] }",
        "panel 2: `marks` has box; accepted are point",
    ),
    wrong("paper", "id = \"nodes\"", "id = \"cost\"", "another claim or cell is called `cost` already"),
    wrong(
        "paper",
        "printed = [\"7.83\"]",
        "printed = [\"7.83\", \"7.84\"]",
        "row `astar` of table `table1` has 2 cells for 1 columns; one for each is accepted, `N/A` where",
    ),
];

/// The file of the tiny paper that a wrong word stands in.
pub fn file(name: &str) -> String {
    if name == "room.map" { "mini/room.map.txt".to_owned() } else { format!("mini/{name}.toml") }
}
