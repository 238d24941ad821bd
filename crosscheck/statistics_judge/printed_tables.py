"""The claims that cells and rows of a paper's own tables are, with settings as written claims have them."""

import copy
from collections.abc import Iterator
from decimal import Decimal
from typing import Any

Settings = dict[str, Any]


def claims_of(paper: Settings) -> list[Settings]:
    """Every claim of a paper: those of its tables, each row before its cells, then the others."""
    made = [claim for table in paper.get("table", []) for claim in of_table(table)]
    claims = made + copy.deepcopy(paper.get("claim", []))
    cells = [claim["id"] for claim in made if "printed" in claim]
    for claim in claims:
        name_cells(claim, cells)
    return claims


def of_table(table: Settings) -> Iterator[Settings]:
    """The claims of one table."""
    every = [
        (column, name)
        for column in table["column"]
        for name in ([column["id"]] if isinstance(column["id"], str) else column["id"])
    ]
    columns = [(column, name) for column, name in every if "difference" not in column]
    begin = table.get("claims", table["id"])
    for row in table["row"]:
        cells = [
            of_cell(f"{begin}.{row['id']}.{name}", printed, (table, column, row), name)
            for printed, (column, name) in zip(row["printed"], columns, strict=True)
            if printed != "N/A"
            and "none" not in {**table, **column}
            and "same_as" not in row.get("cell", {}).get(name, {})
        ]
        cells += differences((table, row), every, cells)
        parts = [cell["id"] for cell in cells if "untestable" not in cell] + row.get("with", [])
        if len(parts) > 1:
            whole = {"id": f"{begin}.{row['id']}", **row.get("whole", {}), "cells": parts}
            layers = [{"select": table.get("select", {})}, row.get("whole", {})]
            yield {**whole, **judged(layers, untestable=False, names={"{row}": row["id"]})}
        yield from cells


def differences(
    around: tuple[Settings, Settings], columns: list[tuple[Settings, str]], cells: list[Settings]
) -> list[Settings]:
    """The cells of columns that the paper does not print: what one column has more than another."""
    table, row = around
    begin = f"{table.get('claims', table['id'])}.{row['id']}"
    names = {name: row.get("cell", {}).get(name, {}).get("id", f"{begin}.{name}") for _, name in columns}
    known = {cell["id"]: cell for cell in cells}
    spoilt = [part["untestable"] for part in (table, row) if "untestable" in part]
    spoilt_columns = {name for column, name in columns if "untestable" in column}
    found = []
    for column, name in columns:
        of = column.get("difference", [])
        ids = [names[one] for one in of]
        if not of or spoilt or {name, *of} & spoilt_columns or not all(one in known for one in ids):
            continue
        more, less = (Decimal(known[one]["printed"]) for one in ids)
        cell = of_cell(names[name], f"{more - less:f}", (table, column, row), name)
        found.append({**cell, "difference": ids})
    return found


def of_cell(name: str, printed: str, around: tuple[Settings, Settings, Settings], column: str) -> Settings:
    """The claim that one cell is; the nearest of what is around it comes last."""
    row = around[-1]
    own = row.get("cell", {}).get(column, {})
    layers = [*around, own]
    kept = {key: own[key] for key in ("digits", "holds_when") if key in own}
    reasons = [layer["untestable"] for layer in layers if "untestable" in layer]
    if reasons:
        kept["untestable"] = reasons[-1]
    names = {"{row}": row["id"], "{column}": column}
    asked = judged(layers, untestable=bool(reasons), names=names)
    return {"id": own.get("id", name), "printed": printed, **kept, **asked}


def judged(layers: list[Settings], *, untestable: bool, names: dict[str, str]) -> Settings:
    """Rules and criteria with their settings: the nearest layer that names any says which, all say how."""
    of: Settings = {}
    for layer in layers:
        of.update(layer.get("select", {}))
    found: Settings = {}
    for kind in ("rule", "check"):
        named = [layer for layer in layers if layer.get(kind)]
        if not named or (kind == "check" and untestable and named[-1] is not layers[-1]):
            continue
        found[kind] = {}
        for criterion in named[-1][kind]:
            settings: Settings = {}
            for layer in named:
                merge(settings, layer[kind].get(criterion, {}))
            found[kind][criterion] = laid_over(of, settings) if kind == "check" else settings
    shown = [layer["shows"] for layer in layers if layer.get("shows")]
    if shown:
        found["shows"] = {
            criterion: [laid_over(of, settings) for settings in tables]
            for criterion, tables in shown[-1].items()
        }
    return filled(found, names)


def laid_over(of: Settings, settings: Settings) -> Settings:
    """Settings with what all around them select; what looks in several places names it beside these."""
    if "in" in settings:
        keys = {"metric": "metric", "contender": "contenders", "against": "against"}
        return {**{to: of[key] for key, to in keys.items() if key in of}, **copy.deepcopy(settings)}
    under: Settings = {"select": copy.deepcopy(of)} if of else {}
    merge(under, settings)
    return under


def merge(under: Settings, over: Settings) -> None:
    """Put one table on top of another, tables into tables."""
    for key, value in over.items():
        if isinstance(value, dict) and isinstance(under.get(key), dict):
            merge(under[key], value)
        else:
            under[key] = copy.deepcopy(value)


def filled(value: Any, names: dict[str, str]) -> Any:  # noqa: ANN401
    """Ids in the place of their names, in all texts."""
    if isinstance(value, str):
        for name, own in names.items():
            value = value.replace(name, own)
        return value
    if isinstance(value, list):
        return [filled(inner, names) for inner in value]
    if isinstance(value, dict):
        return {key: filled(inner, names) for key, inner in value.items()}
    return value


def name_cells(value: Any, cells: list[str]) -> None:  # noqa: ANN401
    """Put the cells that begin so in the place of names that end in `.*`, in lists of claims."""
    for inner in value if isinstance(value, list) else value.values():
        if isinstance(inner, list | dict):
            name_cells(inner, cells)
    if isinstance(value, dict) and isinstance(value.get("claims"), list):
        value["claims"] = [
            cell
            for name in value["claims"]
            for cell in (
                [own for own in cells if own.startswith(name[:-1])] if name.endswith(".*") else [name]
            )
        ]
