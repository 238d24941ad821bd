"""Types and functions whose names riddle → what they are. (files, old, new)."""
from engine import *

TYPES = [
    # engine
    ('src/engine/planner/lattice26_astar.rs', 'Found', 'LatticePath'),
    ('src/engine/planner/*.rs', 'Manner', 'TipSearchOptions'),
    ('src/engine/search/*.rs', 'Asked', 'AnswerWithinLimit'),
    (['src/engine/**', 'benches/**'], 'Terms', 'SideInputs'),
    ('src/engine/kinematics/ik/*.rs', 'Ahead', 'ShoulderSolution'),
    ('src/engine/kinematics/ik/offset_wrist.rs', 'Hand', 'WristSolution'),
    ('src/engine/space/cell/**', 'Doubt', 'UnsettledPath'),
    ('src/engine/space/cell/**', 'Pace', 'StepSchedule'),
    # audit and proofs
    (['src/**/coverage/scan.rs', 'src/**/coverage.rs'], 'Found', 'Occurrence'),
    (['src/**/reach.rs', 'src/**/checks/grimmer.rs'], 'Asked', 'SumQuery'),
    ('src/**/report.rs', 'Told', 'TestOutcome'),
    # render
    ('src/render/figure/draws.rs', 'Asked', 'DrawsFigure'),
    ('src/render/figure/sweep_curves/across.rs', 'Other', 'SweepSetting'),
    ('src/render/figure/sweep_curves/across.rs', 'RowOf', 'PrintedRowSpec'),
    ('src/render/figure/plane_search.rs', 'PanelOf', 'SearchPanel'),
    ('src/render/figure/cost_over_time.rs', 'Found', 'CostHistory'),
    # cli
    ('src/cli/list.rs', 'Found', 'LoadedFiles'),
    ('src/cli/status.rs', 'Found', 'ShardProgress'),
    ('src/cli/witness.rs', 'Hunt', 'WitnessSearch'),
    ('src/cli/witness.rs', 'Found', 'FoundWitness'),
    ('src/cli/compare.rs', 'Asked', 'CompareOptions'),
    # base
    ('src/base/settings/validate.rs', 'Found', 'FoundFaults'),
    # crosscheck
    ('src/crosscheck/*.rs', 'Asked', 'AnswerFiles'),
    # analysis
    ('src/analysis/witness.rs', 'Hunt', 'WitnessSearch'),
    (['src/analysis/found.rs', 'src/analysis/claims.rs', 'src/analysis/settle.rs', 'src/analysis/criterion/**', 'src/analysis/rule/**',
      'src/analysis/statistic.rs', 'src/analysis/criterion_result.rs', 'src/analysis/verdict_rule.rs', 'src/analysis/class.rs'], 'Found', 'CriterionResult'),
    ('src/analysis/**', 'Weighed', 'CappedFinding'),
    (['src/analysis/**', 'src/page/**', 'src/render/**', 'src/cli/show.rs', 'src/cli/verdicts.rs'], 'Finding', 'CriterionFinding'),
    (['src/analysis/**', 'src/page/**', 'src/render/**', 'src/cli/**', 'tests/it/**'], 'Judged', 'ClaimVerdict'),
    ('src/analysis/criterion/on_every.rs', 'That', 'Condition'),
    ('src/analysis/criterion/on_every.rs', 'Says', 'CaseOutcome'),
    ('src/analysis/across/by_reading.rs', 'Found', 'SharedResult'),
    ('src/analysis/across/effects.rs', 'Found', 'OptionEffect'),
    ('src/analysis/**', 'EffectOf', 'EffectOfOption'),
    (['src/analysis/compare.rs', 'src/analysis/compare/*.rs'], 'Asked', 'CompareOptions'),
    (['src/analysis/claims.rs', 'src/analysis/meaning.rs', 'src/analysis/history.rs'], 'Asked', 'TestRole'),
    ('src/analysis/shown.rs', 'Found', 'CostHistory'),
    (['src/analysis/**', 'src/render/**'], 'OfDraw', 'InstanceStatistic'),
    (['src/analysis/**', 'src/render/**'], 'OfAll', 'OverallStatistic'),
    # external
    ('src/external/*.rs', 'Found', 'QueryResult'),
    ('src/external/process.rs', 'Said', 'PlannerOutput'),
    ('src/external/*.rs', 'Asked', 'QuestionCounts'),
    # study
    ('src/study/*.rs', 'Terms', 'StudyContext'),
    ('src/study/task/identify_endpoints.rs', 'Found', 'VariantPairs'),
    ('src/study/task/null_rate.rs', 'Asked', 'NullRateQuestion'),
    (['src/study/paper.rs', 'src/study/paper/*.rs', 'tests/it/registries.rs'], 'Asked', 'TestRole'),
    (['src/study/**', 'src/page/replay/arm.rs'], 'Stance', 'ArmPlacement'),
    ('src/study/family/conditioned.rs', 'Of', 'ConditionedFamily'),
    ('src/study/store/pick.rs', 'Found', 'TraceIndex'),
    ('src/study/plan.rs', 'Other', 'Differences'),
    # tests
    ('tests/it/*.rs', 'Said', 'ProgramOutput'),
]
# Names that only this file declares or takes in: nothing else called so may be renamed by accident.
DECLARED = r'(?:struct|enum|type|trait)\s+{0}\b|[{{:,\s]{0}\s*[,}};]|as {0}\b|::{0}\b|\b{0}\b'

# (files of the definition, type, old function, new function); callers anywhere write `Type::old`.
ASSOC = [
    ('src/stats/proportion.rs', 'Rank', 'of', 'new'),
    ('src/stats/rows.rs', 'Place', 'of', 'new'),
    ('src/stats/rows.rs', 'Level', 'of', 'new'),
    ('src/engine/planner/joint_astar/states.rs', 'Around', 'of', 'new'),
    ('src/engine/geometry/lanes/distance.rs', 'RoughSolid', 'of', 'from_solid'),
    ('src/engine/geometry/lanes/distance.rs', 'RoughBox', 'of', 'from_box'),
    ('src/engine/geometry/convex/printed.rs', 'Lines', 'of', 'between'),
    ('src/engine/geometry/convex/distance.rs', 'Beyond', 'of', 'new'),
    ('src/engine/kinematics/rough.rs', 'RoughChain', 'of', 'from_chain'),
    ('src/render/figure/grid_search.rs', 'Map', 'of', 'new'),
    ('src/render/canvas.rs', 'Type', 'of', 'regular'),
    ('src/render/chart/marks.rs', 'Points', 'of', 'unlabelled'),
    ('src/cli/rounds.rs', 'Rounds', 'of', 'new'),
    ('src/cli/drawn.rs', 'Drawn', 'of', 'new'),
    ('src/base/settings/reader.rs', 'Whole', 'of', 'new'),
    ('src/base/settings/accepted.rs', 'Accepted', 'of', 'shape'),
    ('src/analysis/verdict.rs', 'Estimate', 'of', 'from_bootstrap'),
    ('src/analysis/compare/change.rs', 'Sample', 'of', 'of_metric'),
    ('src/analysis/compare/change.rs', 'Measured', 'of', 'new'),
    ('src/analysis/compare/run.rs', 'Seen', 'of', 'new'),
    ('src/analysis/compare/pair.rs', 'Draws', 'of', 'new'),
    ('src/analysis/compare/pair.rs', 'Instances', 'of', 'new'),
    ('src/analysis/across/count.rs', 'Axes', 'of', 'new'),
    ('src/analysis/across/*.rs', 'SharedResult', 'of', 'new'),
    ('src/analysis/across/*.rs', 'Alone', 'of', 'new'),
    ('src/analysis/across/stored.rs', 'Exploration', 'of', 'new'),
    (['src/analysis/across/stored.rs', 'src/analysis/history.rs'], 'Now', 'of', 'new'),
    ('src/analysis/across/stored.rs', 'ExploredResult', 'of', 'new'),
    ('src/analysis/statistic.rs', 'Share', 'of', 'new'),
    ('src/analysis/selection.rs', 'Selection', 'of', 'all'),
    ('src/analysis/evidence.rs', 'Evidence', 'of', 'held'),
    ('src/analysis/evidence.rs', 'Run', 'of', 'new'),
    ('src/analysis/evidence.rs', 'Index', 'of', 'new'),
    ('src/analysis/shown.rs', 'Savings', 'of', 'new'),
    ('src/analysis/shown.rs', 'Spread', 'of', 'new'),
    ('src/analysis/shown.rs', 'Distribution', 'of', 'new'),
    ('src/analysis/inclusion.rs', 'Inclusion', 'of', 'in_study'),
    ('src/study/paper.rs', 'Paper', 'of', 'with_studies'),
    ('src/study/store/read.rs', 'Stored', 'of', 'read_by'),
    ('src/study/manifest.rs', 'Session', 'of', 'here'),
]

# (files, pattern, replacement): what a receiver or a module tells apart.
TEXTS = [
    ('src/engine/search/observe.rs', r'\bpub fn of\(&self, side: u32\)', 'pub fn one_side(&self, side: u32)'),
    ('src/engine/**', r'\bclosings\.of\(', 'closings.one_side('),
    ('src/engine/space/roadmap/near.rs', r'\bfn of\(&self, config', 'fn neighbours(&self, config'),
    ('src/engine/space/roadmap/mod.rs', r'\bself\.near\.of\(', 'self.near.neighbours('),
    ('src/study/store/read.rs', r'\bfn of\(&self, row: usize\)', 'fn at(&self, row: usize)'),
    ('src/study/store/read.rs', r'\b(\w+)\.of\(row\)', r'\1.at(row)'),
    ('src/study/store/pick.rs', r"\bpub fn of<'s>\(&'s self, owner", "pub fn owned_by<'s>(&'s self, owner"),
    ('src/study/store/pick.rs', r'\bself\.of\(owner\)', 'self.owned_by(owner)'),
    ('src/study/store/tests.rs', r'\bstored\.of\(&', 'stored.owned_by(&'),
    ('src/analysis/evidence.rs', r'\bself\.kept\.of\(', 'self.kept.owned_by('),
    ('src/study/group.rs', r'\bpub fn of\(', 'pub fn family('),
    ('src/study/checked/check.rs', r'\bknown\.of\(', 'known.family('),
    ('src/study/runner.rs', r'\bbuilt\.of\(', 'built.family('),
    ('src/study/reuse.rs', r'\bfn of\(&mut self, index', 'fn of_unit(&mut self, index'),
    ('src/study/reuse.rs', r'\bself\.of\(index', 'self.of_unit(index'),
    ('src/analysis/statistic.rs', r'\bpub fn of\(self, (draw|instance): ', r'pub fn value(self, \1: '),
    ('src/analysis/statistic.rs', r'\bpub fn of\(self, (draws|instances): ', r'pub fn estimate(self, \1: '),
    ('src/analysis/statistic.rs', r'\bself\.of\(&given\(', 'self.estimate(&given('),
    ('src/analysis/criterion/*one_*.rs', r'\b(self\.statistic|of)\.of\((draw|instance)\)', r'\1.value(\2)'),
    ('src/analysis/criterion/within.rs', r'\bself\.statistic\.of\(', 'self.statistic.estimate('),
    ('src/analysis/shown.rs', r'SolvedPercent\.of\(', 'SolvedPercent.value('),
    ('src/analysis/shown.rs', r'\ball\.of\(', 'all.estimate('),
    ('src/analysis/shown.rs', r'::Mean\.of\(', '::Mean.estimate('),
    ('tests/it/characteristics/*.rs', r'\bcounts\.of\(', 'counts.count('),
    ('tests/it/characteristics/scenario.rs', r'\bpub fn of\(&self', 'pub fn count(&self'),
    ('src/**/certificate.rs', r'\bpub fn of\(check', 'pub fn certificate(check'),
    ('src/**/report.rs', r'\bcertificate::of\(', 'certificate::certificate('),
    ('src/**/file_schema.rs', r'\bpub fn of\(kind', 'pub fn schema(kind'),
    (['src/**', 'tests/**'], r'\bfile_schema::of\(', 'file_schema::schema('),
    ('src/**/file_schema.rs', r'\bpub fn of_any_names\(', 'pub fn schema_of_any_names('),
    ('src/**/false_alarms.rs', r'\bfn of\(text', 'fn report_on(text'),
    ('src/**/false_alarms.rs', r'(?<![\w.:])of\((?=[a-z&"])', 'report_on('),
    # said, told, asked
    ('src/page/body.rs', r'\bfn said\(&self, text', 'fn prose_html(&self, text'),
    ('src/page/body.rs', r'\bself\.said\(', 'self.prose_html('),
    ('src/page/replay/*.rs', r'\bfn said\(row', 'fn outcome_text(row'),
    ('src/page/replay/*.rs', r'(?<![\w.:])said\(', 'outcome_text('),
    ('src/page/*readings.rs', r'(?<![\w.:])said\((?=axis|option)', 'option_marks('),
    ('src/engine/search/**', r'(?<=[.] )?\bfn tell\(', 'fn set_length('),
    ('src/engine/**', r'\.tell\(', '.set_length('),
    ('src/engine/space/cell/lanes/crowd.rs', r'\bfn tell\(', 'fn resolve('),
    ('src/engine/space/cell/lanes/crowd.rs', r'\.set_length\(', '.resolve('),
    ('src/engine/search/tests/lattice_astar.rs', r'\btold\(', 'result_bits('),
    ('src/engine/kinematics/ik/tests.rs', r'\bsaid\((?=found|&)', 'lane_outcome('),
    ('src/**/checks/*.rs', r'\bfn said\(&self, prints', 'fn sentence(&self, prints'),
    ('src/**/*.rs', r'\btest\.said\(', 'test.sentence('),
    ('src/**/coverage.rs', r'(?<![\w.:])said\(', 'lines('),
    ('src/**/report/simulation.rs', r'\bfn said\(&self\)', 'fn annotation(&self)'),
    ('src/**/report/simulation/*.rs', r'\bstyle\.said\(', 'style.annotation('),
    ('src/**/meaning.rs', r'\btake_unsaid\(', 'fill_from('),
    ('src/**/*.rs', r'\.take_unsaid\(', '.fill_from('),
    ('src/**/audit/report.rs', r'\bfn tell\(&mut self', 'fn add_finding(&mut self'),
    ('src/**/audit/report.rs', r'\bself\.tell\(', 'self.add_finding('),
    ('src/render/figure/polyhedra.rs', r'\bfn said\(&self', 'fn outcome_text(&self'),
    ('src/render/figure/polyhedra.rs', r'\bself\.said\(', 'self.outcome_text('),
    ('src/render/figure/paired_boxes.rs', r'\bof_so_many\(', 'name_with_count('),
    ('src/render/figure/paired_boxes.rs', r'\bfn asked<', 'fn selection<'),
    ('src/render/figure/paired_boxes.rs', r'\bself\.asked\(', 'self.selection('),
    ('src/render/figure/draws.rs', r'\basked_claim\b', 'claim_of_panel'),
    ('src/render/report.rs', r'(?<![\w.:])said\((?=judged|&)', 'paper_statement('),
    ('src/cli/witness.rs', r'\bfn asked\(&self\)', 'fn request(&self)'),
    ('src/cli/witness.rs', r'\bself\.asked\(\)', 'self.request()'),
    ('src/cli/progress.rs', r'\bfn say\(&mut self\)', 'fn print(&mut self)'),
    ('src/cli/progress.rs', r'\bself\.say\(\)', 'self.print()'),
    ('src/cli/audit.rs', r'\bsay_lines\b', 'print_lines'),
    ('src/cli/*.rs', r'\bnot_said\b', 'print_failed'),
    ('src/cli/crosscheck/statistics.rs', r'(?<![\w.:])asked\(', 'request_json('),
    ('src/cli/status.rs', r'(?<![\w.:])said\((?=found|&)', 'progress_text('),
    ('src/base/settings/document.rs', r'\bpub fn says\(', 'pub fn contains_word('),
    ('src/base/settings/document.rs', r'(?<![\w])says\((?=value|v\b|&|\w)', 'contains_word('),
    (['src/study/**', 'src/cli/**', 'src/analysis/**', 'src/base/**'], r'\bdocument\.says\(', 'document.contains_word('),
    ('src/base/settings/tests.rs', r'(?<![\w.:])said\((?=text|&|")', 'faults_of('),
    ('src/base/settings/error.rs', r'\bsaid_with\b', 'laid_over'),
    ('src/analysis/witness.rs', r'(?<![\w.:])asked(?=<|\()', 'numbers_of_claims'),
    ('src/analysis/claims.rs', r'\bsay_what_settles\b', 'set_what_settles'),
    ('src/analysis/criterion/equals.rs', r'\btruth_said\b', 'truth_name'),
    ('src/analysis/criterion/exists.rs', r'\bfn asked<', 'fn places<'),
    ('src/analysis/criterion/exists.rs', r'\bself\.asked\(', 'self.places('),
    ('src/analysis/criterion/on_every.rs', r'\bfn says\(&self', 'fn outcome_of_case(&self'),
    ('src/analysis/criterion/on_every.rs', r'\bself\.says\(', 'self.outcome_of_case('),
    ('src/analysis/criterion/on_every.rs', r'\bsaid_by\b', 'outcomes'),
    ('src/analysis/criterion/share.rs', r'\bfn said\(self\)', 'fn label(self)'),
    ('src/analysis/criterion/share.rs', r'\bfn said\(&self\)', 'fn description(&self)'),
    ('src/analysis/criterion/share.rs', r'\bself\.said\(\)', 'self.description()'),
    ('src/analysis/criterion/share.rs', r'\b(hits|self\.settings\.hits|settings\.hits|self\.hits|other)\.said\(\)', r'\1.label()'),
    ('src/analysis/criterion/lower.rs', r'\bfn told\(&self', 'fn sentence(&self'),
    ('src/analysis/criterion/lower.rs', r'\bself\.told\(', 'self.sentence('),
    ('src/analysis/criterion/row_one_*.rs', r'\blevel_said\b', 'level_sentence'),
    ('src/analysis/criterion/one_*.rs', r'(?<![\w.:])said\((?=draws|instances|&|set)', 'rank_sentence('),
    ('src/analysis/compare/gate.rs', r'(?<![\w.:])said\(', 'verdict('),
    ('src/analysis/across/hangs.rs', r'\bpub fn said\(', 'pub fn summary('),
    ('src/analysis/**', r'\bhangs::said\(', 'hangs::summary('),
    ('src/analysis/compare.rs', r'\btold_apart\b', 'only_on_one_side'),
    ('src/analysis/together.rs', r'(?<![\w.:])asked(?=<|\()', 'attained_claims'),
    ('src/analysis/selection.rs', r'\bpub fn said\(&self\)', 'pub fn description(&self)'),
    ('src/analysis/selection.rs', r'\bgroups_said\b', 'groups_text'),
    (['src/analysis/**', 'src/render/**', 'src/cli/**', 'src/page/**'], r'\bof\.said\(\)', 'of.description()'),
    ('src/external/process.rs', r'\bfn said\(&mut self', 'fn next_output(&mut self'),
    ('src/external/process.rs', r'\bself\.said\(', 'self.next_output('),
    ('src/external/answer.rs', r'\bpub fn asked\(&self\)', 'pub fn question_counts(&self)'),
    (['src/external/**', 'src/study/**'], r'\bspace\.asked\(\)', 'space.question_counts()'),
    ('src/study/task/null_rate.rs', r'\bfn asked\(&self, base', 'fn question(&self, base'),
    ('src/study/task/null_rate.rs', r'\b(self|null|read)\.asked\(', r'\1.question('),
    ('src/study/paper/claim.rs', r'\bpub fn asked\(&self\)', 'pub fn tests(&self)'),
    ('src/study/paper/claim.rs', r'(?<![\w.:])asked\(', 'tests('),
    (['src/**', 'tests/it/**'], r'\bclaim\.asked\(\)', 'claim.tests()'),
    ('src/study/paper/claim.rs', r'\bself\.asked\(\)', 'self.tests()'),
    ('src/base/settings/document.rs', r'\bself\.says\(', 'self.contains_word('),
    ('src/cli/file_schema.rs', r'&of\(kind\)', '&schema(kind)'),
    ('src/cli/*.rs', r'(?<![\w.])of_any_names\b', 'schema_of_any_names'),
    ('src/cli/progress.rs', r'\bpass\.say\(\)', 'pass.print()'),
    ('src/page/replay/*.rs', r'\buse super::\{Case, said\};', 'use super::{Case, outcome_text};'),
    ('src/render/report/*.rs', r'\bplace, said\}', 'paper_statement, place}'),
    ('src/render/report/*.rs', r'(?<![\w.:])said\(judged\)', 'paper_statement(judged)'),
    ('src/analysis/across/tests.rs', r'\buse super::hangs::said;', 'use super::hangs::summary;'),
    ('src/analysis/across/tests.rs', r'(?<![\w.:])said\(&axes', 'summary(&axes'),
    (['src/**', 'tests/it/**'], r'\bClaim::asked\b', 'Claim::tests'),
    ('src/study/files.rs', r'\bpaper\.says\(', 'paper.contains_word('),
    ('src/**/report/simulation/wide.rs', r'\bturned\.said\(', 'turned.annotation('),
    (['src/**', 'tests/it/**'], r'\basks_as\b', 'tests_alike'),
    (['src/study/**', 'src/analysis/**', 'src/cli/**'], r'\bis_asked\b(?=\(\))', 'is_consistent'),
    (['src/study/**', 'src/analysis/**', 'src/cli/**'], r'\b(ReadingChoice|Interpretation)::is_asked\b', r'\1::is_consistent'),
    ('src/study/reading.rs', r'\bpub fn is_asked\b', 'pub fn is_consistent'),
    ('src/study/choice.rs', r'\bpub fn is_asked\b', 'pub fn is_consistent'),
    ('src/study/store/exhibits.rs', r'\btold\b(?=\(|\))', 'io_error'),
    ('src/study/store/traces.rs', r'\btold\b(?=\(|\))', 'io_error'),
    ('src/study/defaults.rs', r'(?<![\w.:])said\(', 'filled('),
    ('tests/it/follow_on.rs', r'(?<![\w.:])told\(', 'faults_after('),
    ('tests/it/hidden_faults.rs', r'(?<![\w.])(self::)?told\(', r'\1faults_after('),
    ('tests/it/*.rs', r'\bassert_told\b', 'assert_faults'),
    ('tests/it/circles.rs', r'\bfn said\(', 'fn message('),
    ('tests/it/circles.rs', r'\bself\.said\(', 'self.message('),
    ('tests/it/paper.rs', r'\bpub fn said\(&self', 'pub fn output(&self'),
    ('tests/it/**', r'\b(self|bench|toy\.0|\w+)\.said\((?=&|output)', r'\1.output('),
    ('tests/it/across.rs', r'\bpub fn said\(&self, id', 'pub fn class_and_across(&self, id'),
    ('tests/it/**', r'([\w)])\.said\((?="|id|claim)', r'\1.class_and_across('),
    ('tests/it/documented.rs', r'\bunsaid\b', 'silent_keys'),
    ('tests/it/registries.rs', r'(?<![\w.:])asked\(', 'used_criteria('),
    ('src/engine/kinematics/ik/offset_wrist.rs', r'\bfn ahead\(', 'fn shoulder('),
    ('src/engine/kinematics/ik/*.rs', r'\b(self|arm)\.ahead\(', r'\1.shoulder('),
    ('src/engine/kinematics/ik/offset_wrist.rs', r'\bfn hand\(', 'fn wrist('),
    ('src/engine/kinematics/ik/offset_wrist.rs', r'\bself\.hand\(', 'self.wrist('),
    ('src/analysis/**', r'\bweighed\((?=evidence|&|\w)', 'capped_findings('),
    ('src/analysis/**', r'\b(claims|super|super::claims|super::super::claims)::weighed\b', r'\1::capped_findings'),
]

FILES = [('src/analysis/found.rs', 'src/analysis/criterion_result.rs')]

import re
def apply(tree):
    missing = []
    for files, old, new in TYPES:
        hits = 0
        for f in tree.match(files):
            if not f.endswith('.rs') or not re.search(rf'\b{old}\b', tree.read(f)): continue
            text = rename_idents(tree.read(f), {old: new})
            hits += text != tree.read(f)
            tree.write(f, text)
        if not hits: missing.append(('type', old, new, files))
    # What is taken from elsewhere under the old name.
    for f in tree.match('src/**/*.rs') + tree.match('tests/**/*.rs'):
        t = tree.read(f)
        t = re.sub(r'\beffects::Found\b', 'effects::OptionEffect', t)
        t = re.sub(r'\beffects::SharedResult\b', 'effects::OptionEffect', t)
        tree.write(f, t)
    for files, ty, old, new in ASSOC:
        define = set(tree.match(files))
        hits = 0
        for f in tree.match(['src/**/*.rs', 'tests/**/*.rs', 'benches/**/*.rs']):
            src = tree.read(f)
            if ty not in src or old not in src: continue
            text = rename_assoc(src, ty, old, new, f in define)
            hits += text != src
            tree.write(f, text)
        if not hits: missing.append(('fn', ty, old, files))
    for files, pattern, new in TEXTS:
        hits = 0
        for f in tree.match(files):
            if not f.endswith('.rs'): continue
            text = re.sub(pattern, new, tree.read(f))
            hits += text != tree.read(f)
            tree.write(f, text)
        if not hits: missing.append(('text', pattern, new, files))
    for old, new in FILES:
        if old in tree.files:
            tree.move(old, new)
            for f in tree.match('src/analysis/**/*.rs') + tree.match('src/analysis/*.rs'):
                tree.write(f, re.sub(r'\bfound::(?=CriterionResult|\{CriterionResult|Narrows)', 'criterion_result::',
                           re.sub(r'^(\s*(?:pub(?:\([a-z]+\))? )?mod) found;', r'\1 criterion_result;', tree.read(f), flags=re.M)))
    for m in missing: print('   nothing to do:', *m)
