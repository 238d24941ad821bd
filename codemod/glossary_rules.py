"""The glossary: exhibit, prepared, ledger, replicate, draw. (Readings are in reading_rules.)"""
from engine import *

RUST = ['src/**/*.rs', 'tests/**/*.rs', 'benches/**/*.rs']


def words_of(mapping):
    """A function of an identifier: its words exchanged by `mapping` (lower case, singular and plural apart)."""
    def one(ident):
        out = []
        for part in re.split(r'(_)', ident):
            pieces = re.findall(r'[A-Z]+(?=[A-Z][a-z])|[A-Z]?[a-z0-9]+|[A-Z0-9]+', part) if part != '_' else [part]
            if ''.join(pieces) != part: pieces = [part]
            for p in pieces:
                low = p.lower()
                if low in mapping:
                    new = mapping[low]
                    if p.isupper() and len(p) > 1: new = new.upper()
                    elif p[0].isupper(): new = new[0].upper() + new[1:]
                    p = new
                out.append(p)
        return ''.join(out)
    return one


def rename_words(src, mapping, accept=None, keep=(), captures=True):
    """Exchanges words within identifiers of code, of format captures and of code in comments."""
    one = words_of(mapping)
    change = lambda name: name if name in keep else one(name)
    ts = tokens(src)
    out = []
    for i, (k, t) in enumerate(ts):
        if k == 'ident':
            if t not in keep and (accept is None or accept(ts, i)): t = one(t)
        elif k == 'str' and captures and '{' in t:
            t = CAPTURE.sub(lambda m: '{' + change(m.group(1)) + re.sub(r'(\w+)\$', lambda n: change(n.group(1)) + '$', m.group(2)) + '}', t)
        elif k == 'comment':
            t = TICKED.sub(lambda m: re.sub(r'\b[A-Za-z_]\w*\b', lambda n: change(n.group()), m.group()), t)
        out.append(t)
    return ''.join(out)


def each_string(src, f):
    return ''.join(f(t) if k == 'str' else t for k, t in tokens(src))

def each_comment(src, f):
    return ''.join(f(t) if k == 'comment' else t for k, t in tokens(src))

def each_text(src, f):
    return ''.join(f(t) if k in ('str', 'comment') else t for k, t in tokens(src))


def subs(pairs):
    rx = [(re.compile(p), r) for p, r in pairs]
    def f(t):
        for p, r in rx: t = p.sub(r, t)
        return t
    return f


def case(pairs):
    """The same with a capital first letter."""
    return pairs + [(p[:1] + p[1:], r) for p, r in []] + [
        (re.sub(r'^(\\b)?\(?\??:?([a-z])', lambda m: m.group(0)[:-1] + m.group(2).upper(), p), r[:1].upper() + r[1:]) for p, r in pairs if re.match(r'^(\\b)?[a-z]', p)]


TRACE = {'exhibit': 'trace', 'exhibits': 'traces'}
TRACE_PROSE = subs([(r'\ban exhibit\b', 'a trace'), (r'\bAn exhibit\b', 'A trace'), (r'\bexhibit(s?)\b', r'trace\1'), (r'\bExhibit(s?)\b', r'Trace\1'), (r'\bEXHIBITS\b', 'TRACES')])
INVENTORY_PROSE = subs([(r'\ba ledger\b', 'an inventory'), (r'\bA ledger\b', 'An inventory'), (r'\bledger\b', 'inventory'), (r'\bLedger\b', 'Inventory')])
# `replicates = 24` in specs within tests, and the word.
REPLICATE_PROSE = subs([(r'\ba replicate\b', 'an instance'), (r'\breplicate(s?)\b', r'instance\1'), (r'\bReplicate(s?)\b', r'Instance\1')])
PREPARED_PROSE = subs([(r'\bprepared object(s?)\b', r'preprocessed object\1'), (r'\bPrepared object(s?)\b', r'Preprocessed object\1'), (r'\bprepared_bytes\b', 'preprocessing_bytes'),
    (r'\.prepared\b', '.preprocessing'), (r'"prepared"', '"preprocessing"'), (r"'prepared'", "'preprocessing'"), (r'\bprepared\.parquet\b', 'preprocessing.parquet'),
    (r'\bprepared_columns\b', 'preprocessing_columns')])

DRAW = {'draw': 'instance', 'draws': 'instances'}
COMPOUND = subs([(r'\brow_one_draw\b', 'row_one_instance'), (r'\bone_draw\b', 'one_instance'), (r'\bwhole_draws\b', 'whole_instances'), (r'\bsingle_draws\b', 'single_instances'),
    (r'\bmore_draws\b', 'more_instances'), (r'\bmore_draws\b', 'more_instances')])

NOUN_FILES = ['!src/study/explore.rs', 'src/analysis/**/*.rs', 'src/analysis/*.rs', 'src/stats/**/*.rs', 'src/stats/*.rs', 'src/study/*.rs', 'src/study/checked/*.rs', 'src/study/manifest/*.rs', 'src/study/paper/*.rs',
    'src/study/reuse/*.rs', 'src/study/runner/*.rs', 'src/study/store/*.rs', 'src/cli/explorer.rs', 'src/cli/described.rs', 'src/cli/rounds.rs', 'src/cli/confirm.rs', 'src/page/replay/*.rs',
    'tests/it/characteristics/*.rs', 'tests/it/characteristics.rs', 'tests/it/exploring.rs', 'benches/merge.rs']
# Figures draw; what they show are instances.
FIGURE_FILES = ['src/render/figure/**/*.rs', 'src/render/figure/*.rs', 'src/render/tables.rs', 'src/render/comparison.rs', 'src/render/disclaimers.rs', 'src/render/results.rs']


def noun(ts, i):
    """In files of statistics: not what a planner or stream does."""
    n = next_sig(ts, i)
    p = next_sig(ts, i, -1)
    if ts[i][1] == 'draw' and n is not None and ts[n][1] == '(' and p is not None and ts[p][1] == '.' and ts[next_sig(ts, p, -1)][1] == 'family': return False
    if ts[i][1] == 'draws' and n is not None and ts[n][1] == '(' and p is not None and ts[p][1] == '.':
        q = next_sig(ts, p, -1)
        if ts[q][1] in ('planner', 'entry', 'stage'): return False
    return True


def figure_noun(ts, i):
    if ts[i][1] == 'draw':
        n = next_sig(ts, i)
        p = next_sig(ts, i, -1)
        if n is not None and ts[n][1] == '(':
            if p is not None and ts[p][1] == ':':
                q = next_sig(ts, p - 1, -1)
                return ts[q][1] == 'ask'
            return p is not None and ts[p][1] == '.' and False or (p is not None and ts[p][1] == '.' and ts[next_sig(ts, n)][1] == ')' and ts[next_sig(ts, p, -1)][1] in ('row', 'a', 'b'))
        if p is not None and ts[p][1] == ':':
            q = next_sig(ts, p - 1, -1)
            return ts[q][1] == 'Row'
    return True


def traces(tree):
    if tree.has('src/engine/search/observe.rs', r'pub struct Trace\b') and tree.has('src/engine/planner/entry.rs', r'pub struct Exhibit\b'):
        for f in tree.match(['src/engine/**/*.rs', 'src/study/**/*.rs', 'benches/**/*.rs']):
            tree.write(f, rename_idents(tree.read(f), {'Trace': 'VisitOrder'}))
    for f in tree.match(RUST):
        src = tree.read(f)
        if not re.search('exhibit', src, re.I): continue
        src = rename_words(src, TRACE)
        tree.write(f, each_text(src, TRACE_PROSE))
    tree.move('src/study/store/exhibits.rs', 'src/study/store/traces.rs')


def inventory(tree):
    for f in tree.match(RUST):
        src = tree.read(f)
        if not re.search('ledger', src, re.I): continue
        src = rename_words(src, {'ledger': 'inventory'})
        tree.write(f, each_text(src, INVENTORY_PROSE))
    tree.move('src/study/paper/ledger.rs', 'src/study/paper/inventory.rs')


def preprocessing(tree):
    keep = ('ensure_prepared',)
    for f in tree.match(RUST):
        src = tree.read(f)
        if not re.search('prepared', src, re.I): continue
        if 'render/canvas' in f: continue
        src = rename_words(src, {'prepared': 'preprocessing'}, accept=lambda ts, i: len(ts[i][1]) < 40, keep=keep)
        tree.write(f, each_text(src, PREPARED_PROSE))
    tree.move_dir('src/study/prepared', 'src/study/preprocessing')


def shared_instances(tree):
    texts = [
        ('src/study/spec.rs', r'\bpub draw: Option<String>', 'pub shared_instances: Option<String>'),
        ('src/study/group.rs', r'\bpub draw: Option<String>', 'pub shared_instances: Option<String>'),
        (['src/study/**/*.rs', 'src/study/*.rs', 'src/cli/*.rs', 'src/analysis/**/*.rs', 'tests/it/**/*.rs'], r'\b(group|spec|problems|entry)\.draw\b(?!\()', r'\1.shared_instances'),
        (['src/study/checked/*.rs'], r'\bdraw: (group|spec)\.shared_instances', r'shared_instances: \1.shared_instances'),
        ('src/study/runner.rs', r'Some\(draw\) => &\[&self\.study\.paper, "draw", draw, &number\]', 'Some(shared) => &[&self.study.paper, "draw", shared, &number]'),
    ]
    texts.append(('src/study/spec.rs', r'/// What its draws are called: groups of one paper whose draws have one name get the same seeds, draw by draw, so that\n    /// what their settings do can be compared in pairs\. The study and the label if absent\.',
        '/// A name for its instances: groups of one paper with the same name here get the same seeds, instance by instance, so that\n    /// what their settings do can be compared in pairs. The study and the label if absent.'))
    for files, p, r in texts:
        for f in tree.match(files): tree.write(f, re.sub(p, r, tree.read(f)))


def instances(tree):
    shared_instances(tree)
    for f in tree.match(['src/render/figure/work_cell.rs', 'src/render/figure/polyhedra.rs', 'src/render/figure/ask.rs']):
        tree.write(f, rename_idents(tree.read(f), {'replicate': 'number'}))
    for f in tree.match(RUST):
        src = tree.read(f)
        new = rename_words(src, {'replicate': 'instance', 'replicates': 'instances'}, accept=lambda ts, i: True)
        new = each_text(new, REPLICATE_PROSE)
        # specs within tests and templates
        new = each_string(new, subs([(r'(?m)(^|[{,\n\[(] ?|"|\\n)draw = (?=\\?"|")', r'\1shared_instances = '), (r'\bdraw = (?=\d)', 'instance = '), (r'\bdraws = (?=\d|\{)', 'instances = '),
            (r'(?<![-./])\brow_one_draw\b', 'row_one_instance'), (r'\bone_draw\b', 'one_instance')]))
        new = COMPOUND(new)
        tree.write(f, new)
    types = {'DrawKey': 'InstanceKey', 'OneDraw': 'OneInstance', 'RowOneDraw': 'RowOneInstance'}
    for f in tree.match(RUST):
        if any(re.search(rf'\b{t}\b', tree.read(f)) for t in types): tree.write(f, rename_idents(tree.read(f), types))
        tree.write(f, re.sub(r'\bOwner::Draw\b', 'Owner::Instance', tree.read(f)))
    for f in tree.match(NOUN_FILES):
        tree.write(f, rename_words(tree.read(f), DRAW, accept=noun, keep=('draw_text', 'draws_ends')))
    for f in tree.match(FIGURE_FILES):
        tree.write(f, rename_words(tree.read(f), DRAW, accept=figure_noun))
    # Callers elsewhere.
    calls = [
        (['src/**/*.rs', 'tests/**/*.rs', 'benches/**/*.rs'], r'\.has_draw\(', '.has_instance('),
        (['src/**/*.rs', 'tests/**/*.rs', 'benches/**/*.rs'], r'\b(on|key)\.draw\b(?!\()', r'\1.instance'),
        (['src/**/*.rs', 'tests/**/*.rs', 'benches/**/*.rs'], r'\brow\.draw\(\)', 'row.instance()'),
        (['src/**/*.rs', 'tests/**/*.rs', 'benches/**/*.rs'], r'\bRow::draw\b', 'Row::instance'),
        (['src/**/*.rs', 'tests/**/*.rs', 'benches/**/*.rs'], r'\bone_draw::', 'one_instance::'),
        ('src/study/store/*.rs', r'"draw"', '"instance"'),
        ('src/render/figure/draws.rs', r'name: "draws"', 'name: "instances"'),
        ('src/render/figure/draws.rs', r'kind = "draws"', 'kind = "instances"'),
        ('tests/**/*.rs', r'kind = (\\?)"draws(\\?)"', r'kind = \1"instances\2"'),
        (['src/**/*.rs', 'tests/**/*.rs'], r'"group,draw,query', '"group,instance,query'),
    ]
    for files, p, r in calls:
        for f in tree.match(files): tree.write(f, re.sub(p, r, tree.read(f)))
    tree.move('src/analysis/criterion/one_draw.rs', 'src/analysis/criterion/one_instance.rs')
    tree.move('src/analysis/criterion/row_one_draw.rs', 'src/analysis/criterion/row_one_instance.rs')
    tree.move_dir('src/analysis/criterion/row_one_draw', 'src/analysis/criterion/row_one_instance')
    tree.move_dir('src/analysis/criterion/one_draw', 'src/analysis/criterion/one_instance')
    tree.move('src/render/figure/draws.rs', 'src/render/figure/instances.rs')


def fingerprint(tree):
    f = 'src/study/family/conditioned.rs'
    if f not in tree.files: return
    src = tree.read(f)
    if '{of:?} {shared}' in src and 'struct ConditionedFamily' in src:
        src = src.replace('{of:?} {shared}', '[{families}] {shared}')
        src = src.replace("""        let text = format!(
            "{} [{families}]""", """        // As lists were sealed from the first on.
        let family = |one: &ConditionedFamily| {
            format!("Of {{ family: {:?}, settings: {:?} }}", one.family, one.settings)
        };
        let families = of.iter().map(family).collect::<Vec<_>>().join(", ");
        let text = format!(
            "{} [{families}]""")
        tree.write(f, src)


SINGULAR = r'(?:[Ii]ts|[Kk]ept|unlucky|normal|[Aa]|[Tt]he|[Oo]ne|[Ee]ach|[Ee]very|[Aa]nother|[Pp]er|same|single|whole|independent|first|second|next|last|other|[Aa]ny|[Nn]o|[Tt]his|[Ww]hich|by|on|in|of|own|more|new|stored|group\'s|last|half a|seeded|most|such a|equal|best|middle)'
PLURAL = r'(?:[Ww]ithout|normal|[Ww]here|[Ww]hatever|six|ten|sixty|thousand|[Ff]orty|[Ii]ndependent|than|[Oo]nly|[Rr]efuses|plain|conditioned|for|[Tt]he|[Aa]ll|[Oo]f|[Nn]o|[Ff]ew|[Ff]ewer|[Mm]ore|[Ss]uch|[Tt]hese|[Tt]hose|[Oo]ur|their|own|[Ii]ts|same|single|whole|independent|first|other|others|[Mm]any|[Oo]ver|[Bb]etween|[Bb]y|[Tt]wo|[Tt]hree|both|different|[Ss]ome|further|only|least|[Ff]ewest|enough|so many|several|agreeing|numbered|[Aa]mong|from|with|on|in|alike|kept|explored|as|than|these|drawn|accepted|[Oo]n|[Bb]ut|\d[\d_,]*|\{\w*(?::[^}]*)?\})'
DRAW_PROSE = [
    (rf'\b(draw) by draw\b', 'instance by instance'), (r'\bDraw by draw\b', 'Instance by instance'),
    (rf"(?<![\w'])({SINGULAR}) draw\b(?!-)", r'\1 instance'), (rf"(?<![\w'])({PLURAL}) draws\b", r'\1 instances'),
    (r"\bdraw's\b", "instance's"), (r"\bdraws'", "instances'"),
    (r'\bDraws (?=of|that|on|kept|under|agree|which|are|whose|with|by|in|at)', 'Instances '),
    (r'\bdraws (?=of (?:a|the|one|each|other|his|its) (?:group|problem|set|study)|that (?:all|agree|have|are|do|differ|none|ran|were|no|it)|on which|agree\b|whose|are\b|differ\b|in which|under which|each\b|behind\b|there are|alone|beside|left)', 'instances '),
    (r'\bDraws (?=below|equal|above)', 'Instances '), (r'\bmore such draw\b', 'more such instance'), (r'\blargest draw\b', 'largest instance'), (r'\bdraws where draws\b', 'instances where instances'),
    (r'\bBy draw\b', 'By instance'), (r'"draw \{(number|draw|instance)\}', r'"instance {\1}'), (r'\bgroup, draw and query\b', 'group, instance and query'), (r'\bdraw, query\b', 'instance, query'), (r'"draws, queries', '"instances, queries'),
    (r'pairs / draws', 'pairs / instances'), (r'second_only,draws,', 'second_only,instances,'), (r'solved,draws,measured', 'solved,instances,measured'), (r'; draws (?=without|that give|of which)', '; instances '), (r': draws of which', ': instances of which'),
    (r'\b(?<=  )draw can have', 'instance can have'), (r'^(///\s+)draw can have', r'\1instance can have'), (r'^(///\s+)draws, (?=and|for)', r'\1instances, '), (r'(?<=  )draws or a larger', 'instances or a larger'), (r'\bholds draw \{', 'holds instance {'),
    (r'"draws on every case', '"draws on every case'), (r', are draws of which', ', are instances of which'), (r"trial's draw\b", "trial's instance"), (r"row's draw\b", "row's instance"), (r'with its draw,', 'with its instance,'),
    (r'\b([Aa])n? (instance)', lambda m: ('An' if m.group(1) == 'A' else 'an') + ' instance'),
    (r'\bhalf an? instance\b', 'half an instance'),
]
DRAW_TEXT = subs(DRAW_PROSE)
PROSE_FILES = [f for f in NOUN_FILES if f[0] != '!'] + FIGURE_FILES + ['src/study/column.rs', 'src/study/plan.rs', 'src/study/lib.rs', 'src/study/paper/*.rs', 'src/study/family/entry.rs', 'src/study/task/*.rs', 'src/cli/*.rs', 'src/page/*.rs', 'src/page/**/*.rs',
    'src/render/*.rs', 'src/render/report/*.rs', 'src/crosscheck/*.rs', 'src/external/*.rs', 'tests/it/*.rs', 'tests/it/**/*.rs', 'src/study/explore.rs', 'src/study/reading.rs', 'src/study/contender.rs', 'src/study/family/mod.rs', 'src/study/family/conditioned/*.rs', 'src/study/family/conditioned.rs']


def prose(tree):
    for f in tree.match(PROSE_FILES):
        src = tree.read(f)
        if re.search(r'\bdraws?\b', src, re.I): tree.write(f, each_text(src, DRAW_TEXT))


def apply(tree):
    fingerprint(tree)
    traces(tree)
    inventory(tree)
    preprocessing(tree)
    instances(tree)
    prose(tree)
    f = 'src/analysis/meaning.rs'
    if f in tree.files:
        tree.write(f, re.sub(r'const RENAMED: \[\(&str, &str\); 3\] =\s*\[\("one_instance", "one_instance"\),.*?\];', 'const RENAMED: [(&str, &str); 0] = [];', tree.read(f), flags=re.S))
