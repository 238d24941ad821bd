"""The RO-Crate validator finds nothing that a pack must have and lacks. The context is that of the package `rocrate`: no network."""

import io
import sys
from email.message import Message
from importlib.metadata import version
from importlib.resources import files
from urllib.response import addinfourl

import rdflib.parser
from rocrate_validator import models, services

CONTEXT = (files("rocrate") / "data" / "ro-crate.jsonld").read_bytes()
ask = rdflib.parser._urlopen


def from_package(request):
    """The context of RO-Crate without the network."""
    if "ro/crate/1.1/context" not in request.full_url:
        return ask(request)
    headers = Message()
    headers["Content-Type"] = "application/ld+json"
    return addinfourl(io.BytesIO(CONTEXT), headers, request.full_url, 200)


rdflib.parser._urlopen = from_package
result = services.validate(
    models.ValidationSettings(
        rocrate_uri=sys.argv[1],
        profile_identifier="ro-crate-1.1",
        requirement_severity=models.Severity.REQUIRED,
        skip_availability_check=True,
    )
)
# These two fetch the context from the web to see that it is there; where there is no network they say so.
fetches = {"ro-crate-1.1_3.1", "ro-crate-1.1_3.2"}
issues = [issue for issue in result.get_issues() if issue.check.identifier not in fetches or "retr" not in issue.message]
for issue in issues:
    print(f"{issue.check.identifier}: {issue.message}")
assert not issues, "the pack is no RO-Crate 1.1"
checks = len(result.executed_checks)
assert checks > 20, f"only {checks} checks ran"
print(f"roc-validator {version('roc-validator')} passes the pack: {checks} checks of RO-Crate 1.1")
