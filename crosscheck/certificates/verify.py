"""Verifies one certificate, by the rule of its check."""

from __future__ import annotations

from certificates import counting, ranges
from certificates.spans import RefusedError, need, printed

FORMAT = "replan audit certificate 1"
FIELDS = {"format", "check", "premises", "numbers", "given", "steps"}
Refused = RefusedError

RULES = {**counting.RULES, **ranges.RULES}


def verify(certificate: object) -> None:
    """Refuses the certificate, with the reason, unless every step of it holds and together they prove it."""
    try:
        need(
            isinstance(certificate, dict) and set(certificate) == FIELDS,
            f"the fields are not {sorted(FIELDS)}",
        )
        need(certificate["format"] == FORMAT, f"the format is not {FORMAT!r}")
        need(certificate["check"] in RULES, f"there is no rule for {certificate['check']!r}")
        premises = certificate["premises"]
        need(
            isinstance(premises, list) and premises and all(isinstance(p, str) for p in premises),
            "no premises",
        )
        spans = []
        for number in certificate["numbers"]:
            need(
                set(number) == {"name", "printed", "significant", "digits", "span"},
                "a number has other fields",
            )
            need(isinstance(number["name"], str), "a number has no name")
            span = printed(number["printed"], number["digits"], number["significant"])
            need(span.written() == number["span"], f"{number['printed']} stands for {span.written()}")
            spans.append(span)
        steps = certificate["steps"]
        need(isinstance(steps, list), "the steps are no list")
        rule, fields = RULES[certificate["check"]]
        given = certificate["given"]
        need(isinstance(given, dict) and set(given) == fields, f"what is given is not {sorted(fields)}")
        rule(spans, given, steps)
    except (KeyError, TypeError, ValueError, IndexError, ZeroDivisionError, AttributeError) as error:
        raise RefusedError(f"it is not well formed: {error!r}") from error
