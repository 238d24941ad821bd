"""Renames in a Rust tree by token, scoped by file, safe to apply twice."""
import fnmatch, os, re, subprocess, sys
sys.path.insert(0, '/tmp/codemod')
from rust_tokens import tokens


class Tree:
    def __init__(self, root):
        self.root = root
        listed = subprocess.run(['git', '-C', root, 'ls-files', '-co', '--exclude-standard'], capture_output=True, text=True).stdout.split('\n')
        self.files = [f for f in listed if f and os.path.isfile(f'{root}/{f}')]
        self.cache, self.changed = {}, set()
        self.log = []

    def read(self, f):
        if f not in self.cache:
            self.cache[f] = open(f'{self.root}/{f}', encoding='utf-8').read()
        return self.cache[f]

    def write(self, f, text):
        if text != self.read(f):
            self.cache[f] = text
            self.changed.add(f)

    def save(self):
        for f in sorted(self.changed):
            with open(f'{self.root}/{f}', 'w', encoding='utf-8') as out: out.write(self.cache[f])
        self.changed.clear()

    def match(self, globs):
        globs = [globs] if isinstance(globs, str) else globs
        out = []
        for f in self.files:
            for g in globs:
                neg = g.startswith('!')
                if fits(f, g.lstrip('!')):
                    if neg: break
                    out.append(f); break
        return out

    def has(self, globs, pattern):
        return any(re.search(pattern, self.read(f)) for f in self.match(globs))

    def move(self, old, new):
        if old in self.files and not os.path.exists(f'{self.root}/{new}'):
            self.save()
            os.makedirs(os.path.dirname(f'{self.root}/{new}'), exist_ok=True)
            subprocess.run(['git', '-C', self.root, 'mv', old, new], check=True)
            self.files[self.files.index(old)] = new
            if old in self.cache: self.cache[new] = self.cache.pop(old)

    def move_dir(self, old, new):
        for f in [f for f in self.files if f.startswith(old + '/')]:
            self.move(f, new + f[len(old):])


def fits(f, g):
    if '**' not in g: return fnmatch.fnmatchcase(f, g) and f.count('/') == g.count('/')
    rx = re.escape(g).replace(r'\*\*/', '(?:.*/)?').replace(r'\*\*', '.*').replace(r'\*', '[^/]*')
    return re.fullmatch(rx, f) is not None


def next_sig(ts, i, step=1):
    i += step
    while 0 <= i < len(ts) and ts[i][0] in ('ws', 'comment'): i += step
    return i if 0 <= i < len(ts) else None


CAPTURE = re.compile(r'(?<!\{)\{(?=[A-Za-z_])(\w+)((?:[:!][^{}]*(?:\{\w+\}[^{}]*)?)?)\}')


def in_strings(text, mapping):
    """Renames what format strings capture: `{old}`, `{old:?}`, `{x:old$}`."""
    def one(m):
        name, spec = m.group(1), m.group(2)
        spec = re.sub(r'(\w+)\$', lambda n: mapping.get(n.group(1), n.group(1)) + '$', spec)
        return '{' + mapping.get(name, name) + spec + '}'
    return CAPTURE.sub(one, text)


TICKED = re.compile(r'`[^`\n]*`|\]\([A-Za-z_:]+(?:\(\))?\)')


def in_comments(text, mapping):
    def span(m):
        return re.sub(r'\b[A-Za-z_]\w*\b', lambda n: mapping.get(n.group(), n.group()), m.group())
    return TICKED.sub(span, text)


def rename_idents(src, mapping, accept=None, strings=True, comments=True, prose_types=True):
    """Renames identifier tokens; `accept(ts, i)` may refuse one."""
    ts = tokens(src)
    out = []
    types = {k: v for k, v in mapping.items() if k[0].isupper()}
    for i, (k, t) in enumerate(ts):
        if k == 'ident' and t in mapping and (accept is None or accept(ts, i)):
            t = mapping[t]
        elif k == 'str' and strings and '{' in t:
            t = in_strings(t, mapping)
        elif k == 'comment' and comments:
            t = in_comments(t, mapping)
        out.append(t)
    return ''.join(out)


def not_call(ts, i):
    """No function's name and no method's: followed by no parenthesis."""
    n = next_sig(ts, i)
    p = next_sig(ts, i, -1)
    if p is not None and ts[p][1] == 'fn': return False
    return n is None or ts[n][1] != '('


def impl_ranges(ts, name):
    """Token ranges of `impl … name … { }` blocks and of `trait name`."""
    out, i = [], 0
    depth = 0
    while i < len(ts):
        k, t = ts[i]
        if k == 'ident' and t in ('impl', 'trait'):
            p = next_sig(ts, i, -1)
            if p is None or ts[p][1] in ('}', ';', ']', ')', 'pub', '{', 'unsafe', 'mod') or ts[p][0] == 'ident' and ts[p][1] in ('pub',):
                j = i
                head = []
                while ts[j][1] not in ('{', ';'):
                    if ts[j][0] == 'ident': head.append(ts[j][1])
                    j += 1
                if ts[j][1] == '{':
                    d, e = 0, j
                    while True:
                        if ts[e][0] == 'punct':
                            if ts[e][1] == '{': d += 1
                            elif ts[e][1] == '}':
                                d -= 1
                                if d == 0: break
                        e += 1
                    last = head[head.index('for') + 1:] if 'for' in head[1:] else head[1:]
                    last = last[:last.index('where')] if 'where' in last else last
                    if name in last: out.append((j, e))
                    i = j
        i += 1
    return out


def rename_assoc(src, ty, old, new, define):
    """`ty::old` → `ty::new`; in `define` also `fn old` and `Self::old` inside `impl ty`."""
    ts = tokens(src)
    ranges = impl_ranges(ts, ty) if define else []
    out = []
    for i, (k, t) in enumerate(ts):
        if k == 'ident' and t == old:
            p = next_sig(ts, i, -1)
            inside = any(a < i < b for a, b in ranges)
            if p is not None and ts[p][1] == 'fn' and inside: t = new
            elif p is not None and ts[p][1] == ':' and ts[p-1][1] == ':':
                q = next_sig(ts, p - 1, -1)
                if q is not None and (ts[q][1] == ty or (ts[q][1] == 'Self' and inside)): t = new
                elif q is not None and ts[q][1] == '>':
                    pass
        elif k == 'comment':
            t = re.sub(rf'\b{ty}::{old}\b', f'{ty}::{new}', t)
            if any(a < i < b for a, b in ranges):
                t = re.sub(rf'\bSelf::{old}\b', f'Self::{new}', t)
        out.append(t)
    return ''.join(out)
