"""Turns `let (a, b) = (x, y);` of unrelated things into two lets."""
import re, sys
sys.path.insert(0, '/tmp/codemod')
from rust_tokens import tokens

OPEN, CLOSE = {'(': ')', '[': ']', '{': '}'}, {')', ']', '}'}
def sig(ts, i, step):
    i += step
    while 0 <= i < len(ts) and ts[i][0] in ('ws', 'comment'): i += step
    return i

def group_end(ts, i):
    depth = 0
    while True:
        t = ts[i][1]
        if ts[i][0] == 'punct':
            if t in OPEN: depth += 1
            elif t in CLOSE:
                depth -= 1
                if depth == 0: return i
        i += 1

def split(ts):
    """The parts between top-level commas. Generic arguments `a::<B, C>` count as brackets."""
    parts, depth, angle, part = [], 0, 0, []
    i = 0
    bars = False
    while i < len(ts):
        k, t = ts[i]
        if k == 'punct':
            if t in OPEN: depth += 1
            elif t in CLOSE: depth -= 1
            elif t == '<' and depth == 0 and ''.join(x[1] for x in part).rstrip().endswith('::'): angle += 1
            elif t == '<' and angle and depth == 0: angle += 1
            elif t == '>' and angle and depth == 0 and ts[i-1][1] != '-': angle -= 1
            elif t == '|' and depth == 0:
                # a closure's parameters: from a `|` at the start of an operand to the next
                prev = [x for x in part if x[0] not in ('ws', 'comment')]
                if not bars and (not prev or prev[-1][1] in ('=', ',', 'move', '(')): bars = True
                elif bars: bars = False
            elif t == ',' and depth == 0 and not angle and not bars:
                parts.append(part); part = []; i += 1
                continue
        part.append(ts[i]); i += 1
    if [x for x in part if x[0] not in ('ws', 'comment')]: parts.append(part)
    return parts

def text(ts): return ''.join(t for _, t in ts).strip()
def names(ts): return {t.removeprefix('r#') for k, t in ts if k == 'ident' and t not in ('mut', 'ref', 'box')}
def uses(ts):
    found = set()
    for i, (k, t) in enumerate(ts):
        if k == 'ident':
            p = sig(ts, i, -1)
            if p >= 0 and ts[p][1] == '.' and not (p > 0 and ts[p-1][1] == '.'): continue
            found.add(t)
        elif k == 'str':
            found.update(re.findall(r'\{\s*([A-Za-z_]\w*)', t))
            found.update(re.findall(r'[:.](\w+)\$', t))
    return found

PAIRS = [set(p.split()) for p in '''
low high|min max|lo hi|start goal|from to|least greatest|first last|before after|old new|ours theirs|left right|first second|first second third|x y|x y z|a b|dx dy|
lower upper|head tail|width height|row column|rows columns|top bottom|start end|begin end|numerator denominator|sin cos|sine cosine|smallest largest|least most|below above|
into onto|forward backward|front back|near far|here there|one other|one two|left top|source target|parent child|shorter longer|short long|smaller larger|
inner outer|real imaginary|mean sd|mean deviation|even odd|even_odds|shift scale|this that|key value|key field|quotient remainder|whole part|whole rest|
forwards backwards|our their|ours printed|expected actual|wanted got|truth got|want got|elbow_up elbow_down|up down|inside outside|hits chances|hits misses|solved total|
horizontal vertical|along across|slope intercept|sum square|sum squares|seconds nanoseconds|first_row last_row|cells across|opened closed|open closed|
roll pitch yaw|red green blue|q1 q2|l1 l2|previous next|earlier later|early late|earliest latest|out back|in out|
least upper|fewest most|columns rows|tightest widest|narrow wide|negative positive|numerators denominators|across up|east north|stdout stderr|out err|coarse fine|slow fast|
shortest longest|plus minus|forth back|ahead behind|bottom top|added removed|gained lost|from until|true false|yes no|one many|single many|single lanes|single both|starts goals|enter leave|falls rises|hold fail|holds fails|base tool|base_inverse tool_inverse|stretched shifted|greedy optimal|greedy length'''.replace('\n', '').split('|')]
PAIRS = [p for p in PAIRS if p]
STEMS = sorted({w for p in PAIRS for w in p}, key=len, reverse=True)

def belongs(ns):
    if all(len(n) <= 2 or re.fullmatch(r'[a-z]\w?\d', n) for n in ns): return True
    s = set(ns)
    if any(s <= p for p in PAIRS) and len(s) > 1: return True
    parts = [n.split('_') for n in ns]
    # `low_m, high_m`, `start_cell, goal_cell`: a pair with an equal rest
    if len({len(p) for p in parts}) == 1:
        differ = [i for i in range(len(parts[0])) if len({p[i] for p in parts}) > 1]
        if len(differ) == 1 and len(parts[0]) > 1:
            d = {p[differ[0]] for p in parts}
            if any(d <= p for p in PAIRS) or all(len(w) == 1 for w in d): return True
            if all(re.fullmatch(r'\d', w) for w in d): return True
    return False

def transform(src, report=None):
    ts = tokens(src)
    out, i = [], 0
    changed = 0
    while i < len(ts):
        k, t = ts[i]
        if k == 'ident' and t == 'let':
            p = sig(ts, i, -1)
            prev = ts[p][1] if p >= 0 else ';'
            # a macro's tokens are left alone by the statement rule too
            if prev in ('{', '}', ';') or (p >= 0 and ts[p][0] == 'punct' and prev == ']' and False):
                j = sig(ts, i, 1)
                if ts[j][1] == '(':
                    e = group_end(ts, j)
                    eq = sig(ts, e, 1)
                    if ts[eq][1] == '=' and ts[eq+1][1] != '=':
                        v = sig(ts, eq, 1)
                        if ts[v][1] == '(':
                            ve = group_end(ts, v)
                            semi = sig(ts, ve, 1)
                            if ts[semi][1] == ';':
                                done = rewrite(ts, i, j, e, v, ve, report)
                                if done is not None:
                                    indent = src_indent(ts, i)
                                    out.append(('code', ('\n' + indent).join(done)))
                                    changed += 1
                                    i = semi + 1
                                    continue
        out.append(ts[i]); i += 1
    return ''.join(t for _, t in out), changed

def src_indent(ts, i):
    if i and ts[i-1][0] == 'ws' and '\n' in ts[i-1][1]: return ts[i-1][1].rsplit('\n', 1)[1]
    return ''

def rewrite(ts, i, j, e, v, ve, report):
    pats, exprs = split(ts[j+1:e]), split(ts[v+1:ve])
    if len(pats) != len(exprs) or len(pats) < 2: return None
    if any(text(p) == '..' for p in pats): return None
    lines = flatten(pats, exprs)
    pn = [n for p, _ in lines for n in [text([x for x in p if x[0] != 'ws' and x[1] != 'mut'])]]
    if any(n == '_' for n in pn): return None
    simple = all(re.fullmatch(r'\w+', n) for n in pn)
    if report is not None: report.append((pn, [text(x) for _, x in lines]))
    if simple and belongs(pn): return None
    # `([ax, ay], [bx, by])`, `((q1, q2), (p1, p2))`: points by their letters
    if not simple and all(re.fullmatch(r'[\[(&]*\w{1,2}(?:, *\w{1,2})*[\])]*', text(p)) for p, _ in lines): return None
    for a in range(len(lines)):
        for b in range(a + 1, len(lines)):
            if names(lines[a][0]) & uses(lines[b][1]): return None
    return [f'let {text(p)} = {text(x)};' for p, x in lines]

def flatten(pats, exprs):
    """`let ((a, b), c) = ((x, y), z)` is three."""
    out = []
    for p, x in zip(pats, exprs):
        out.append((p, x))
    return out

if __name__ == '__main__':
    import subprocess, collections
    root = sys.argv[1]
    files = subprocess.run(['git', '-C', root, 'ls-files', '*.rs'], capture_output=True, text=True).stdout.split()
    report, total = [], 0
    for f in files:
        s = open(f'{root}/{f}').read()
        assert ''.join(t for _, t in tokens(s)) == s, f
        _, c = transform(s, report)
        total += c
    kept = collections.Counter(tuple(p) for p, _ in report if all(re.fullmatch(r'\w+', n) for n in p) and belongs(p))
    gone = collections.Counter(tuple(p) for p, _ in report if not(all(re.fullmatch(r'\w+', n) for n in p) and belongs(p)))
    print(len(report), total, sum(kept.values()))
    print('KEPT'); print('; '.join(f'{",".join(k)}:{v}' for k, v in kept.most_common()))
    print('GONE'); print('; '.join(f'{",".join(k)}:{v}' for k, v in gone.most_common()))
