"""Specs, templates, docs, Python: the glossary in what is not Rust."""
from engine import *
from glossary_rules import subs, DRAW_TEXT, TRACE_PROSE, INVENTORY_PROSE, REPLICATE_PROSE, PREPARED_PROSE

SPECS = ['experiments/**/*.toml', 'src/cli/new/**/*.toml', 'tests/it/**/*.toml']
KEYS = subs([
    (r'(?m)^\[\[ledger\]\]', '[[inventory]]'),
    (r'\breplicates(?=\s*=)', 'instances'), (r'\breplicate(?=\s*=)', 'instance'),
    (r'(?m)(^|[{,]\s*)draw(?=\s*=\s*")', r'\1shared_instances'), (r'\bdraw(?=\s*=\s*\d)', 'instance'),
    (r'\bdraws(?=\s*=\s*[\d{])', 'instances'), (r'\bmore_draws(?=\s*=)', 'more_instances'),
    (r'\bexhibit(s?)(?=\s*=)', r'trace\1'), (r'\brow_one_draw\b', 'row_one_instance'), (r'(?<![-/.\w])one_draw\b(?=\s*[=\].])', 'one_instance'), (r'\.one_draw\b', '.one_instance'),
    (r'\bwhole_draws\b', 'whole_instances'), (r'\bsingle_draws\b', 'single_instances'), (r'\bprepared_bytes\b', 'preprocessing_bytes'),
    (r'\bkind = "draws"', 'kind = "instances"'), (r'\bshow = "prepared"', 'show = "preprocessing"'),
])
# What we wrote ourselves; the paper's words and words that were written before a run stay.
OWN_WORDS = re.compile(r'^(#|caption\b|table_caption\b|notes?\b|why\b|question\b)|^\s*"')


def apply(tree):
    for f in tree.match(SPECS):
        src = KEYS(tree.read(f))
        lines, key = [], ''
        for line in src.split('\n'):
            m = re.match(r'([A-Za-z_][\w.]*)\s*=', line)
            if m: key = m.group(1)
            elif line.startswith('['): key = ''
            own = line.lstrip().startswith('#') or key in ('caption', 'table_caption', 'note', 'notes', 'why', 'question')
            if own: line = INVENTORY_PROSE(TRACE_PROSE(DRAW_TEXT(line)))
            lines.append(line)
        tree.write(f, '\n'.join(lines))
    for f in tree.match(['docs/*.md', 'README.md']):
        if f.endswith('AUDIT.md') or f.endswith('AUDIT_TABLES.md'): continue
        tree.write(f, KEYS(PREPARED_PROSE(REPLICATE_PROSE(INVENTORY_PROSE(TRACE_PROSE(DRAW_TEXT(tree.read(f))))))))
    python(tree)


def python(tree):
    files = ['crosscheck/statistics_judge/*.py', 'crosscheck/tests/test_across.py', 'crosscheck/tests/test_censored.py', 'crosscheck/tests/test_intervals.py', 'crosscheck/tests/test_statistics_judge.py']
    both = subs([(r'"draw"', '"instance"'), (r'"row_one_draw"', '"row_one_instance"'), (r'"one_draw"', '"one_instance"'), (r'\brow_one_draw\b', 'row_one_instance'), (r'\bone_draw\b', 'one_instance'),
        (r'\bwhole_draws\b', 'whole_instances'), (r'\breplicates\b', 'instances'), (r'\bFEWEST_DRAWS\b', 'FEWEST_INSTANCES')])
    code = subs([(r'\b(study|self|cases|own|found)\.draw\b', r'\1.instance'), (r'\bdef draw\(self', 'def instance(self'), (r'\bdraw=', 'instance='), (r'\bdraws\b', 'instances')])
    parts = re.compile(r'("""(?:.|\n)*?"""|f?"(?:[^"\\\n]|\\.)*"|#[^\n]*)')
    def own(src):
        return both(''.join(p if at % 2 else code(p) for at, p in enumerate(parts.split(src))))
    for f in tree.match(files):
        src = own(tree.read(f))
        tree.write(f, DRAW_TEXT(src))
    for f in tree.match(['crosscheck/**/*.py', 'crosscheck/*.py', 'benches/**/*.py']):
        src = tree.read(f)
        src = re.sub(r'\.exhibits\.parquet', '.traces.parquet', re.sub(r'\.prepared\.parquet', '.preprocessing.parquet', src))
        src = re.sub(r'"exhibits"', '"traces"', re.sub(r'"prepared"', '"preprocessing"', src))
        tree.write(f, src)
