//! Planners in `sh` that misbehave, each in its own way, and what their trial must say.

/// What every script can use: `hello`, `query` (reads one; sets `id`, `start`, `goal`) and `result PATH`.
pub const PRELUDE: &str = r#"#!/bin/sh
hello() {
  printf '{"type":"hello","protocol":%s,"name":"%s","version":"%s","worlds":[%s],"seeding":"%s","deterministic":true,"anytime":false}\n' \
    "${protocol:-1}" "${name-t}" "${version:-1}" "${worlds-\"${world:-grid}\"}" "${seeding:-query}"
}
query() {
  read -r line || exit 0
  case $line in *'"quit"'*) exit 0 ;; esac
  id=$(printf '%s' "$line" | sed 's/.*"id":\([0-9]*\).*/\1/')
  start=$(printf '%s' "$line" | sed 's/.*"start":\(\[[^]]*\]\).*/\1/')
  goal=$(printf '%s' "$line" | sed 's/.*"goal":\(\[[^]]*\]\).*/\1/')
}
result() { printf '{"type":"result","id":%s,"status":"solved","path":%s%s}\n' "$id" "$1" "$2"; }
straight() { result "[$start,$goal]"; }
"#;

/// One way to misbehave: its name, the script, the status, and what the reason must hold.
pub struct Case {
    pub name: &'static str,
    pub script: &'static str,
    pub status: &'static str,
    pub reason: &'static str,
}

impl Case {
    /// Whoever ends by itself has more time than any load takes; whoever is cut off has little, or enough to write something before.
    pub fn time_s(&self) -> &'static str {
        match (self.name, self.status) {
            ("hang" | "cut-off", _) => "3.0",
            (_, "time_spent") => "0.5",
            _ => "60.0",
        }
    }
}

const fn case(name: &'static str, script: &'static str, status: &'static str, reason: &'static str) -> Case {
    Case { name, script, status, reason }
}

/// Says nothing; costs ten seconds and stands alone for it.
pub const SILENT: Case = case(
    "silent",
    "echo 'still loading' >&2; sleep 100",
    "crashed",
    "the planner sent no `hello` within 10 s; it wrote nothing: an output that is buffered must be flushed after each line; its \
     log ends: still loading",
);

/// Returns the straight line whatever the world, so that its path is shorter than any there is.
pub const SHORTER: Case = case(
    "shorter-than-optimal",
    "hello; query; echo 'a new record' >&2; sleep 0.1; straight; query",
    "rejected",
    "; its log ends: a new record",
);

/// The other cases, the sound ones among them.
pub const CASES: &[Case] = &[
    case("good", "hello; while query; do straight; done", "solved", ""),
    case(
        "fork-chain",
        r#"if [ "$1" = on ]; then sleep 0.02; setsid sh "$0" on & exit; fi; hello; query; setsid sh "$0" on & straight; query"#,
        "solved",
        "",
    ),
    case("one-query-each", "seeding=process; hello; query; straight; query", "solved", ""),
    case(
        "no-path",
        r#"hello; query; printf '{"type":"result","id":%s,"status":"no_path"}\n' "$id"; query"#,
        "no_path",
        "found no path",
    ),
    case(
        "own-budget",
        r#"hello; query; printf '{"type":"result","id":%s,"status":"budget_spent"}\n' "$id"; query"#,
        "budget_spent",
        "of the planner's own",
    ),
    case("gone", "echo 'no licence' >&2; exit 5", "crashed", "(exit status: 5); its log ends: no licence"),
    case(
        "crash",
        "hello; query; echo oops >&2; exit 3",
        "crashed",
        "ended before its result (exit status: 3); its log ends: oops",
    ),
    case("killed", "hello; query; kill -9 $$", "crashed", "(signal: 9"),
    case(
        "hang",
        "hello; query; echo 'still searching' >&2; sleep 100",
        "time_spent",
        "3 s were spent; it wrote nothing: an output that is buffered must be flushed after each line; its log ends: still \
         searching",
    ),
    case("spin", "hello; query; while :; do :; done", "time_spent", "0.5 s were spent"),
    case(
        "deaf-to-term",
        "trap '' TERM; hello; query; while :; do sleep 1; done",
        "time_spent",
        "0.5 s were spent",
    ),
    case("never-reads", "hello; sleep 100", "time_spent", "0.5 s were spent"),
    case(
        "rubbish",
        "hello; query; echo 'Segmentation fault'; query",
        "crashed",
        "`Segmentation fault`, which is no message",
    ),
    case(
        "no-number",
        "hello; query; result '[[0,NaN]]'; query",
        "crashed",
        "which is no message: JSON has no number `NaN`, at column",
    ),
    case(
        "no-cost",
        r#"hello; query; result "[$start,$goal]" ',"cost":-Infinity'; query"#,
        "crashed",
        "JSON has no number `-Infinity`, at column",
    ),
    case(
        "long-line",
        r#"hello; query; result "[$(yes '[0,0],' | head -n 500 | tr -d '\n')[0,nan]]"; query"#,
        "crashed",
        "[0,0],[0,0],[0,nan]]}`, which is no message: JSON has no number `nan`, at column 3",
    ),
    case("marked", r"printf '\357\273\277'; hello; while query; do straight; done", "solved", ""),
    case(
        "counter-too-large",
        r#"hello; query; result "[$start,$goal]" ',"counters":{"expansions":1e17}'; query"#,
        "crashed",
        "the planner counts 1e17 `expansions`; a whole number of 0 or more and below 2^53 is accepted",
    ),
    case(
        "counter-of-many-digits",
        r#"hello; query; result "[$start,$goal]" ',"counters":{"expansions" : 9007199254740993 }'; query"#,
        "crashed",
        "the planner counts 9007199254740993 `expansions`; a whole number of 0 or more and below 2^53 is accepted",
    ),
    case(
        "counter-twice",
        r#"hello; query; result "[$start,$goal]" ',"counters":{"samples":1,"samples":2}'; query"#,
        "crashed",
        "which is no message: duplicate field `samples`",
    ),
    case(
        "counter-in-parts",
        r#"hello; query; result "[$start,$goal]" ',"counters":{"samples":1.5}'; query"#,
        "crashed",
        "the planner counts 1.5 `samples`; a whole number of 0 or more",
    ),
    case(
        "counter-below-0",
        r#"hello; query; result "[$start,$goal]" ',"counters":{"own_wall_ns":-1}'; query"#,
        "crashed",
        "the planner counts -1 `own_wall_ns`; a whole number of 0 or more and below 2^53 is accepted",
    ),
    case(
        "counters",
        r#"hello; query; result "[$start,$goal]" ',"counters":{"own_wall_ns":-0.0,"samples":3.0}'; query"#,
        "solved",
        "",
    ),
    case(
        "counter-of-time-too-large",
        r#"hello; query; result "[$start,$goal]" ',"counters":{"own_wall_ns":1208925819614629174706176}'; query"#,
        "crashed",
        "the planner counts 1208925819614629174706176 `own_wall_ns`; a whole number of 0 or more",
    ),
    case(
        "counter-of-nothing",
        r#"hello; query; result "[$start,$goal]" ',"counters":{"iterations":null}'; query"#,
        "crashed",
        "the planner counts null `iterations`; a whole number of 0 or more",
    ),
    case(
        "counters-by-place",
        r#"hello; query; result "[$start,$goal]" ',"counters":[3]'; query"#,
        "crashed",
        "which is no message: invalid type: sequence, expected an object",
    ),
    case(
        "message-by-place",
        r#"hello; query; printf '["result",%s,"solved",[%s,%s],2.0]\n' "$id" "$start" "$goal"; query"#,
        "crashed",
        "which is no message: invalid type: sequence, expected an object",
    ),
    case(
        "unknown-counter",
        r#"hello; query; result "[$start,$goal]" ',"counters":{"expansion":3}'; query"#,
        "crashed",
        "unknown field `expansion` (did you mean `expansions`?), expected one of `expansions`, `iterations`",
    ),
    case(
        "no-path-with-a-path",
        r#"hello; query; printf '{"type":"result","id":%s,"status":"no_path","path":[%s,%s]}\n' "$id" "$start" "$goal"; query"#,
        "crashed",
        "the planner's result is `no_path` with a path of 2 points; it is accepted with `solved` alone",
    ),
    case(
        "budget-with-a-cost",
        r#"hello; query; printf '{"type":"result","id":%s,"status":"budget_spent","cost":7}\n' "$id"; query"#,
        "crashed",
        "the planner's result is `budget_spent` with a cost, 7; it is accepted with `solved` alone",
    ),
    case(
        "empty-question",
        r#"hello; query; echo '{"type":"ask","id":1,"valid":[],"motion":[],"fractions":true}'; read -r answer
  case $answer in *'"valid":[],"motion":[],"free_until":[]}') straight;; *) echo "$answer" >&2; exit 1;; esac; query"#,
        "solved",
        "",
    ),
    case(
        "unknown-key",
        r#"hello; query; result "[$start,$goal]" ',"lenght":3'; query"#,
        "crashed",
        "unknown field `lenght`",
    ),
    case(
        "rubbish-first",
        "echo 'Welcome!'; hello; query; straight",
        "crashed",
        "`Welcome!`, which is no message",
    ),
    case("result-first", "id=1; result '[]'; hello; query; straight", "crashed", "first line is no `hello`"),
    case("hello-twice", "hello; query; hello; straight; query", "crashed", "says `hello` again"),
    case(
        "other-protocol",
        "protocol=2; hello; query; straight",
        "crashed",
        "speaks protocol 2; 1 is accepted",
    ),
    case(
        "no-world",
        "worlds=; hello; query; straight",
        "crashed",
        "names no world; at least one is accepted",
    ),
    case(
        "no-name",
        "name=; hello; query; straight",
        "crashed",
        "the planner's name is empty; one is accepted",
    ),
    case(
        "long-name",
        "name=$(printf '%0101d' 0); hello; query; straight",
        "crashed",
        "the planner's name has 101 characters; at most 100 are accepted",
    ),
    case(
        "other-version",
        "version=2; hello; query; straight",
        "crashed",
        "says that it is version `2`; the study asks for `1`",
    ),
    case(
        "other-world",
        "world=plane; hello; query; straight",
        "crashed",
        "does not plan in worlds of kind grid",
    ),
    case("other-id", "hello; query; id=77; straight; query", "crashed", "answers query 77; its query is"),
    case(
        "flood",
        "hello; query; yes '{}' | tr -d '\\n' & sleep 100",
        "crashed",
        "more than its limit of output",
    ),
    case("flood-of-lines", "hello; query; yes ''", "crashed", "more than its limit of output"),
    case("loud-log", "hello; query; head -c 30000000 /dev/zero >&2; straight; query", "solved", ""),
    case(
        "too-large",
        "hello; query; head -c 400000000 /dev/zero | tail -c 400000000 > /dev/null || exit 9; straight",
        "crashed",
        "(exit status: 9)",
    ),
    case(
        "children",
        "hello; query; sleep 1001 & (trap '' TERM; setsid sleep 1002) & straight; query",
        "solved",
        "",
    ),
    case(
        "orphans",
        "hello; query; (setsid sh -c 'trap \"\" TERM; sleep 1003; :' &); exit 4",
        "crashed",
        "ended before its result",
    ),
    case(
        "orphans-without-a-mark",
        "hello; query; (setsid env -i sh -c 'trap \"\" TERM; sleep 1004; :' &); sleep 0.1; exit 4",
        "crashed",
        "ended before its result",
    ),
    case(
        "result-before-its-query",
        r#"id=1; both=$(hello; result '[[0,1],[299,200]]'); echo "$both"; sleep 100"#,
        "crashed",
        "before it had a query",
    ),
    case(
        "too-many-questions",
        r#"hello; query; printf '{"type":"ask","id":1,"valid":[[0,1]'; yes ',[0,1]' | head -n 100000 | tr -d '\n'; echo ']}'; query"#,
        "crashed",
        "asks 100001 questions at once; 100000 are accepted",
    ),
    case(
        "escapes",
        r"hello; query; printf '\033]0;mine\007a\nb\033[2J' >&2; exit 3",
        "crashed",
        r"its log ends: ‹escape›]0;mine‹control character U+0007›a\nb‹escape›[2J",
    ),
    case("secrets", r#"hello; query; [ -z "$REPLAN_TEST_SECRET" ] || exit 9; straight; query"#, "solved", ""),
    case(
        "better-than-optimal",
        r#"hello; query; result "[$start,$goal]" ',"cost":1.5'; query"#,
        "rejected",
        "the claimed cost is 1.5",
    ),
    case(
        "elsewhere",
        r#"hello; query; result "[$start,[1,1]]"; query"#,
        "rejected",
        "not from start to goal",
    ),
    case(
        "from-elsewhere",
        r#"hello; query; result "[[1,1],$goal]"; query"#,
        "rejected",
        "the path goes from [1, 1] to [299, 200], not from start to goal",
    ),
    case("nowhere", "hello; query; result '[]'; query", "rejected", "the path is empty"),
    case(
        "standing-still",
        r#"hello; query; result "[$start,$start,$goal]"; query"#,
        "rejected",
        "the path stands still at [0, 1]",
    ),
    case(
        "id-in-parts",
        "hello; query; id=$id.0; straight; query",
        "crashed",
        "expected a whole number of 0 or more",
    ),
    case(
        "through-a-wall",
        r#"hello; query; result "[$start,[0,0],[299,0],$goal]"; query"#,
        "rejected",
        "enters the blocked cell [150, 0]",
    ),
    case(
        "other-world's-points",
        "hello; query; result '[[0,0,0]]'; query",
        "crashed",
        "2 finite numbers are accepted",
    ),
    case(
        "odd-question",
        r#"hello; query; echo '{"type":"ask","id":1,"valid":[[1,2,3]]}'; query"#,
        "crashed",
        "a configuration of 3 numbers; 2 are accepted",
    ),
    case(
        "question-about-an-arm",
        r#"hello; query; echo '{"type":"ask","id":1,"fk":[[1,2]]}'; query"#,
        "crashed",
        "needs an arm, and this world has none",
    ),
    case(
        "cut-off",
        r#"hello; query; printf '{"type":"incumbent","id":%s,"cost":null,"path":[%s,%s]}\n' "$id" "$start" "$goal"; sleep 100"#,
        "solved",
        "",
    ),
    case("stops-itself", "hello; query; kill -STOP $$; straight", "time_spent", "0.5 s were spent"),
    case("ends-its-group", "hello; query; kill -9 0", "crashed", "(signal: 9"),
    case("closes-its-output", "hello; query; exec >&-; sleep 100", "crashed", "ended before its result"),
    case("closes-its-input", "hello; query; exec <&-; straight", "solved", ""),
    case("stays-after-quit", "hello; trap '' TERM; query; straight; while :; do sleep 1; done", "solved", ""),
    case("empty-lines", "echo; echo; hello; query; echo; straight; query", "solved", ""),
    case(
        "other-line-ends",
        r#"cr=$(printf '\r'); hello | sed "s/$/$cr/"; query; straight | sed "s/$/$cr/"; query"#,
        "solved",
        "",
    ),
    case(
        "two-on-a-line",
        r#"hello; query; printf '%s' "$(straight)"; straight; query"#,
        "crashed",
        "which is no message: trailing characters",
    ),
    case(
        "nested",
        r"hello; query; yes '[' | head -n 20000 | tr -d '\n'; echo; query",
        "crashed",
        "which is no message",
    ),
    case(
        "bad-bytes",
        r#"hello; query; printf '{"type":"\377"}\n'; query"#,
        "crashed",
        "which is no message: byte 10 is not UTF-8",
    ),
    case("null-bytes", r"hello; query; printf '\0\0\n'; query", "crashed", "which is no message"),
    case("other-type", r#"hello; query; echo '{"type":"bye"}'; query"#, "crashed", "unknown variant `bye`"),
    case("too-large-a-number", "hello; query; result '[[0,1e999]]'; query", "crashed", "number out of range"),
    case(
        "id-below-0",
        "hello; query; id=-1; straight; query",
        "crashed",
        "expected a whole number of 0 or more",
    ),
    case(
        "half-a-result",
        r#"hello; query; printf '{"type":"result","id":%s' "$id"; exit 0"#,
        "crashed",
        "ended before its result (exit status: 0)",
    ),
    case(
        "half-a-result-for-ever",
        r#"hello; query; printf '{"type":"result","id":%s' "$id"; sleep 100"#,
        "time_spent",
        "0.5 s were spent",
    ),
    case("log-without-end", "hello; query; yes >&2 & straight; query", "solved", ""),
    case("good-after-all", "hello; while query; do straight; done", "solved", ""),
];
