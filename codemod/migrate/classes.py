import sys, tomllib, pathlib
old, new = map(pathlib.Path, sys.argv[1:3])
for f in sorted(old.rglob('verdicts.toml')):
    a = {c['claim']: c for c in tomllib.loads(f.read_text())['claim']}
    b = {c['claim']: c for c in tomllib.loads((new / f.relative_to(old)).read_text())['claim']}
    both = a.keys() & b.keys()
    d = [i for i in both if a[i]['verdict'] != b[i]['verdict']]
    e = [i for i in both if a[i].get('across', {}).get('class') != b[i].get('across', {}).get('class')]
    n = [i for i in both if [x.get('ours', {}).get('value') if x.get('ours') else None for x in a[i].get('finding', [])] != [x.get('ours', {}).get('value') if x.get('ours') else None for x in b[i].get('finding', [])]]
    iv = [i for i in both if [x.get('ours') and x['ours'].get('interval') for x in a[i].get('finding', [])] != [x.get('ours') and x['ours'].get('interval') for x in b[i].get('finding', [])]]
    print(f.parent.name, len(a), len(b), 'both', len(both), 'class differs', d[:8], 'across differs', len(e), e[:5], 'value differs', n[:5], 'interval differs', iv[:5], 'only old', sorted(a.keys()-b.keys())[:5], 'only new', sorted(b.keys()-a.keys())[:5])
