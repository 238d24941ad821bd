"""Runs each piece of Python of a page and compares what it prints with the text below it; `--write` puts that text there instead."""

import contextlib
import io
import re
import sys
from pathlib import Path

MOST_LINES = 10
PIECE = re.compile(r"^```python\n(.*?)^```\n\n```text\n(.*?)^```\n", re.DOTALL | re.MULTILINE)

path = Path(sys.argv[1])
page = path.read_text(encoding="utf-8")
pieces = PIECE.findall(page)
assert len(pieces) == page.count("```python") >= 5, f"{len(pieces)} pieces have a text below them"
for number, (piece, expected) in enumerate(pieces, 1):
    lines = [line for line in piece.splitlines() if line.strip()]
    assert len(lines) <= MOST_LINES, f"piece {number} has {len(lines)} lines"
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(piece, f"piece {number}", "exec"), {})
    said = printed.getvalue()
    assert said.strip(), f"piece {number} prints nothing"
    if "--write" in sys.argv:
        page = page.replace(f"{piece}```\n\n```text\n{expected}```", f"{piece}```\n\n```text\n{said}```")
    else:
        assert said == expected, f"piece {number} prints\n{said}and not\n{expected}`--write` writes what it prints"
path.write_text(page, encoding="utf-8")
print(f"{len(pieces)} pieces of {path} print what the page shows")
