"""A small Rust tokenizer: lossless, no macro expansion."""
import re

TOKEN = re.compile(r'''
 (?P<ws>\s+)
|(?P<line>//[^\n]*)
|(?P<block>/\*)
|(?P<raw>(?:b|c)?r(?P<hashes>\#*)")
|(?P<str>(?:b|c)?")
|(?P<char>b?'(?:\\(?:x[0-9a-fA-F]{2}|u\{[^}]*\}|.)|[^\\'\n])')
|(?P<life>'[A-Za-z_][A-Za-z0-9_]*)
|(?P<ident>(?:r\#)?[A-Za-z_][A-Za-z0-9_]*)
|(?P<num>[0-9](?:[0-9A-Za-z_]|\.(?=[0-9])|(?<=[eE])[+-](?=[0-9]))*(?:\.(?![.A-Za-z_0-9]))?)
|(?P<punct>.)
''', re.X | re.S)


def tokens(text):
    """[(kind, text)], joined they are the text."""
    out, i, n = [], 0, len(text)
    while i < n:
        m = TOKEN.match(text, i)
        kind = m.lastgroup if m.lastgroup != 'hashes' else 'raw'
        # lastgroup may be an inner group for raw
        if m.group('raw') is not None:
            end = text.index('"' + m.group('hashes'), m.end()) + 1 + len(m.group('hashes'))
            out.append(('str', text[i:end]))
        elif m.group('str') is not None:
            j = m.end()
            while text[j] != '"':
                j += 2 if text[j] == '\\' else 1
            end = j + 1
            out.append(('str', text[i:end]))
        elif m.group('block') is not None:
            depth, j = 1, m.end()
            while depth:
                if text.startswith('/*', j): depth += 1; j += 2
                elif text.startswith('*/', j): depth -= 1; j += 2
                else: j += 1
            end = j
            out.append(('comment', text[i:end]))
        else:
            end = m.end()
            kind = {'line': 'comment'}.get(kind, kind)
            # a number range `0..3` or a method on a tuple field
            if kind == 'num' and m.group().endswith('.') and text[end:end+1] == '.':
                end -= 1
            out.append((kind, text[i:end]))
        i = end
    return out
