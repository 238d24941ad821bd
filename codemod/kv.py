import subprocess,re,collections
c=collections.defaultdict(collections.Counter)
fs=subprocess.run(['git','ls-files','experiments/*.toml','src/cli/new'],capture_output=True,text=True).stdout.split()
for f in fs:
    for l in open(f):
        m=re.match(r'\s*([\w.]+)\s*=',l)
        key=m.group(1) if m else ('#' if l.lstrip().startswith('#') else '>')
        for w in re.findall(r'\b(?:draws?|exhibits?|ledger|replicates?|prepared|one_draw|row_one_draw)\b',l.split('=',1)[1] if m else l): c[w][key]+=1
for w in c: print(w,dict(c[w]))
