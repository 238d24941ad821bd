"""Studies whose groups and contenders are like others: with what these have in the place of what they leave out."""

from typing import Any


def whole(study: dict[str, Any], paper: dict[str, Any]) -> dict[str, Any]:
    """The spec of a study of the paper, with every group and contender complete."""
    parts = {part: complete(study.get(part, []), paper.get(part, [])) for part in ("problems", "contender")}
    return {**study, **{part: entries for part, entries in parts.items() if entries}}


def complete(entries: list[dict[str, Any]], shared: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Entries that may be like one above, or like one that is shared: settings and choices departed from key by key."""
    found: list[dict[str, Any]] = complete(shared, []) if shared else []
    own = len(found)
    for entry in entries:
        base = next((one for one in [*found[own:], *found[:own]] if one["label"] == entry.get("like")), {})
        laid = {key: {**base.get(key, {}), **entry.get(key, {})} for key in ("settings", "departs")}
        found.append({**base, **entry, **{key: table for key, table in laid.items() if table}})
    return found[own:]
