"""TOML files with the places of their keys, and a check of them against a JSON schema.

A key is known by its way from the top of the file: names of tables, and places in lists from 0. What stands in
an inline table or a list has the place of the key that it is written under.
"""

import json
import re
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

Key = tuple[str | int, ...]

HEADER = re.compile(r"\s*(\[\[?)\s*([\w.-]+)\s*\]")
ASSIGNED = re.compile(r"\s*([\w-]+)\s*=")
# How JSON schemas call what Python reads from TOML.
TYPES: dict[str, tuple[type, ...]] = {
    "object": (dict,),
    "array": (list,),
    "string": (str,),
    "integer": (int,),
    "number": (int, float),
    "boolean": (bool,),
}


class Fault(Exception):  # noqa: N818
    """Input that is wrong; the message says where, what was found and what is accepted."""

    code = 2


class Stale(Fault):
    """Stored files that do not fit what they belong to."""

    code = 3


class Written:
    """A TOML file."""

    def __init__(self, path: Path) -> None:
        """Read the file."""
        self.path = path
        try:
            self.text = path.read_text(encoding="utf-8")
            self.table: dict[str, Any] = tomllib.loads(self.text)
        except (OSError, ValueError) as error:
            raise Fault(f"{path}: {error}") from error

    def place(self, key: Key) -> tuple[int, int]:
        """The line and column, from 1, of the nearest key above `key` that stands at the start of a line."""
        places = dict(self.places())
        while key and key not in places:
            key = key[:-1]
        return places.get(key, (1, 1))

    def places(self) -> Iterator[tuple[Key, tuple[int, int]]]:
        """Every key that stands at the start of a line, with its place."""
        inside: Key = ()
        counts: dict[str, int] = {}
        for number, line in enumerate(self.text.splitlines(), 1):
            if header := HEADER.match(line):
                inside = self.table_key(header[2], is_listed=header[1] == "[[", counts=counts)
                yield inside, (number, line.index("[") + 1)
            elif assigned := ASSIGNED.match(line):
                yield (*inside, assigned[1]), (number, assigned.start(1) + 1)

    @staticmethod
    def table_key(name: str, *, is_listed: bool, counts: dict[str, int]) -> Key:
        """The way to the table whose header has this name; `counts` has how many of each list were met."""
        if is_listed:
            counts[name] = counts.get(name, -1) + 1
            # Lists in the table before are not those in this one.
            for inner in [known for known in counts if known.startswith(f"{name}.")]:
                del counts[inner]
        key: list[str | int] = []
        parts = name.split(".")
        for end in range(1, len(parts) + 1):
            key.append(parts[end - 1])
            if (known := counts.get(".".join(parts[:end]))) is not None:
                key.append(known)
        return tuple(key)

    def fault(self, key: Key, message: str) -> Fault:
        """A fault at a key."""
        line, column = self.place(key)
        return Fault(f"{self.path}:{line}:{column}: {message}")

    def check(self, schema: Path) -> None:
        """Refuse whatever the JSON schema in a file does not accept, all of it at once."""
        whole = json.loads(schema.read_text(encoding="utf-8"))
        faults = [str(self.fault(key, message)) for key, message in refused(self.table, whole, whole, ())]
        if faults:
            raise Fault("\n".join(faults))


def refused(
    value: Any,  # noqa: ANN401
    schema: dict[str, Any],
    whole: dict[str, Any],
    at: Key,
) -> Iterator[tuple[Key, str]]:
    """What a schema does not accept of a value, each with its way from the top."""
    if "$ref" in schema:
        schema = whole["$defs"][schema["$ref"].rsplit("/", 1)[1]]
    name = at[-1] if at else "the file"
    wanted = schema.get("type")
    # What may be left out is of a type or null, which TOML has not.
    wanted = wanted[0] if isinstance(wanted, list) else wanted
    if options := [option["const"] for option in schema.get("oneOf", [])]:
        if value not in options:
            yield at, f"`{name}` is {json.dumps(value)}; accepted: {', '.join(map(json.dumps, options))}"
    elif wanted and (not isinstance(value, TYPES[wanted]) or (isinstance(value, bool) and wanted != "boolean")):
        yield at, f"`{name}` is {json.dumps(value, default=str)}; accepted: {wanted}"
    elif isinstance(value, dict):
        yield from refused_keys(value, schema, whole, at)
    elif isinstance(value, list):
        for index, item in enumerate(value):
            yield from refused(item, schema["items"], whole, (*at, index))
    elif not schema.get("minimum", value) <= value <= schema.get("maximum", value):
        limits = f"{schema.get('minimum', 'any')} to {schema.get('maximum', 'any')}"
        yield at, f"`{name}` is {value}; accepted: {limits}"


def refused_keys(
    table: dict[str, Any], schema: dict[str, Any], whole: dict[str, Any], at: Key
) -> Iterator[tuple[Key, str]]:
    """What a schema does not accept of a table."""
    known = schema["properties"]
    for key in (key for key in schema.get("required", []) if key not in table):
        yield at, f"missing key `{key}`"
    for key, value in table.items():
        if key in known:
            yield from refused(value, known[key], whole, (*at, key))
        else:
            yield (*at, key), f"unknown key `{key}`; accepted: {', '.join(known)}"
