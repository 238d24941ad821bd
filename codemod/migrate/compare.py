"""compare.py OLD_RUNS NEW_RUNS: every row of every Parquet file by key, under the new names of columns; values equal to the bit."""
import sys, pathlib, struct
import polars as pl
old, new = map(pathlib.Path, sys.argv[1:3])
PARTS = {'trials': 'trials', 'times': 'times', 'exhibits': 'traces', 'prepared': 'preprocessing'}
def name(c):
    return {'draw': 'instance', 'prepared_bytes': 'preprocessing_bytes'}.get(c, 'choice_' + c[8:] if c.startswith('reading_') else c)
files = rows = cells = 0
bad = []
for f in sorted(old.rglob('*.parquet')):
    study, part, _ = f.name.rsplit('.', 2)
    g = new / f.relative_to(old).parent / f'{study}.{PARTS.get(part, part)}.parquet'
    if not g.exists(): bad.append(f'{g} is missing'); continue
    a, b = pl.read_parquet(f), pl.read_parquet(g)
    a = a.rename({c: name(c) for c in a.columns})
    files += 1; rows += a.height; cells += a.height * a.width
    if set(a.columns) != set(b.columns): bad.append(f'{g}: columns {set(a.columns) ^ set(b.columns)}'); continue
    if a.schema != b.select(a.columns).schema: bad.append(f'{g}: types differ'); continue
    keys = [c for c in a.columns if c in ('group', 'instance', 'query', 'contender', 'repeat', 'session', 'clock_repeat', 'name') or c.startswith(('sweep_', 'choice_'))]
    if part == 'exhibits': keys = [c for c in keys]
    b = b.select(a.columns)
    if a.select(keys).n_unique() == a.height:
        a, b = a.sort(keys), b.sort(keys)
    if not a.equals(b, null_equal=True): bad.append(f'{g}: values differ')
print(f'{files} files, {rows} rows, {cells} cells compared; {len(bad)} differ')
print('\n'.join(bad[:10]))
sys.exit(bool(bad))
