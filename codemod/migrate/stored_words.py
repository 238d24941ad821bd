"""stored_words.py RUNS: keys of explorations (and their seal) under the new names."""
import sys, pathlib, gzip, hashlib, re
SEAL = '# sha256 of the lines below: '
for f in sorted(pathlib.Path(sys.argv[1]).rglob('*.toml.gz')):
    text = gzip.decompress(f.read_bytes()).decode()
    head, body = text.split('\n', 1)
    assert head == SEAL + hashlib.sha256(body.encode()).hexdigest(), f
    new = re.sub(r'(?m)^readings = \[', 'interpretations = [', body)
    new = re.sub(r'(?m)^\[\[readings\]\]$', '[[interpretations]]', new)
    new = re.sub(r'(?m)^reading = ', 'interpretation = ', new)
    # `[[together]]` names one by its options
    new = re.sub(r'(?m)^\[together\.reading\]$', '[together.interpretation]', new)
    if new == body: continue
    f.write_bytes(gzip.compress((SEAL + hashlib.sha256(new.encode()).hexdigest() + '\n' + new).encode(), 9, mtime=0))
    print(f, 'rewritten')
