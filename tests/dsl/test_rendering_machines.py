"""Diagnostics as services read them: SARIF 2.1.0 and GitHub's workflow commands."""

import json
import os
from pathlib import Path

import pytest
from jsonschema.protocols import Validator
from jsonschema.validators import validator_for

from skillc_dsl.diagnostics import Diagnostic, Fix, Label
from skillc_dsl.rendering import github, sarif
from skillc_dsl.source import Span

PROBLEMS = [
    Diagnostic(
        "missing-space-after-colon",
        Span("lab 1/ä.skill", 2, 5, 2, 9),
        "100% wrong: a, b",
        "type\none",
        labels=(Label(Span("/opt/robot.ttl", 12, 1, 12, 4), "the class"), Label(Span("a.skill", 1, 1, 2, 1), "")),
        fix=Fix(Span("lab 1/ä.skill", 2, 9, 2, 9), " ", "insert a space"),
    ),
    Diagnostic("unused-let", Span("a.skill", 4, 5, 6, 2), "never read", severity="warning"),
    Diagnostic("unused-let", Span("a.skill", 9, 5, 9, 5), "never\x1b read", severity="warning"),
]
RULES = {"unused-let": sarif.SarifRule("unused-let", "A let that nothing reads", "Delete it.")}


def closed(required: list[str], **properties: object) -> dict[str, object]:
    """Return the schema of an object of the specification, with no other properties than those."""
    return {"type": "object", "required": required, "properties": properties, "additionalProperties": False}


def listed(items: object) -> dict[str, object]:
    return {"type": "array", "items": items, "uniqueItems": True, "minItems": 1}


COUNT = {"type": "integer", "minimum": 1}
TEXT = {"type": "string", "minLength": 1}
MESSAGE = closed(["text"], text=TEXT, markdown=TEXT)
ARTIFACT = closed(["uri"], uri={"type": "string", "pattern": r"^[\w!-~]+$"}, uriBaseId=TEXT)
REGION = closed(["startLine"], startLine=COUNT, startColumn=COUNT, endLine=COUNT, endColumn=COUNT)
PHYSICAL = closed(["artifactLocation"], artifactLocation=ARTIFACT, region=REGION)
LOCATION = closed([], id={"type": "integer", "minimum": -1}, physicalLocation=PHYSICAL, message=MESSAGE)
REPLACEMENT = closed(["deletedRegion"], deletedRegion=REGION, insertedContent=closed([], text={"type": "string"}))
CHANGE = closed(["artifactLocation", "replacements"], artifactLocation=ARTIFACT, replacements=listed(REPLACEMENT))
FIX = closed(["artifactChanges"], description=MESSAGE, artifactChanges=listed(CHANGE))
RESULT = closed(
    ["message"],
    ruleId=TEXT,
    ruleIndex={"type": "integer", "minimum": 0},
    level={"enum": ["none", "note", "warning", "error"]},
    message=MESSAGE,
    locations=listed(LOCATION),
    relatedLocations=listed(LOCATION),
    fixes=listed(FIX),
)
RULE = closed(["id"], id=TEXT, name=TEXT, shortDescription=MESSAGE, help=MESSAGE)
DRIVER = closed(["name"], name=TEXT, semanticVersion=TEXT, rules={"type": "array", "items": RULE, "uniqueItems": True})
RUN = closed(
    ["tool"],
    tool=closed(["driver"], driver=DRIVER),
    columnKind={"enum": ["utf16CodeUnits", "unicodeCodePoints"]},
    originalUriBaseIds={"type": "object", "additionalProperties": closed([], description=MESSAGE, uri=TEXT)},
    results={"type": "array", "items": RESULT},
)
LOG = {
    **closed(["version", "runs"], version={"const": "2.1.0"}, runs={"type": "array", "items": RUN}),
}
LOG["properties"] = {**LOG["properties"], "$schema": {"type": "string", "format": "uri"}}  # type: ignore[dict-item]


def schema() -> dict[str, object]:
    """Return OASIS's schema from the file that SARIF_SCHEMA names, else what it says of the objects used here."""
    path = os.environ.get("SARIF_SCHEMA")
    return json.loads(Path(path).read_text("utf-8")) if path else LOG


def validator() -> Validator:
    return validator_for(schema())(schema())


def rendered(problems: list[Diagnostic]) -> dict[str, list[dict[str, list[dict[str, object]]]]]:
    return json.loads(sarif.render(problems, {}, RULES, "1.2.3"))


@pytest.mark.parametrize("problems", [PROBLEMS, PROBLEMS[:1], []])
def test_sarif_keeps_to_its_schema(problems: list[Diagnostic]) -> None:
    assert [error.message for error in validator().iter_errors(rendered(problems))] == []


@pytest.mark.parametrize("key", ["level", "message", "locations"])
def test_the_schema_refuses_what_is_wrong(key: str) -> None:
    log = rendered(PROBLEMS)
    log["runs"][0]["results"][0][key] = 3  # type: ignore[assignment]
    assert not validator().is_valid(log)


def test_sarif_says_everything() -> None:
    run = rendered(PROBLEMS)["runs"][0]
    first, second, third = run["results"]
    rules = run["tool"]["driver"]["rules"]  # type: ignore[call-overload]
    assert [rules[result["ruleIndex"]]["id"] for result in (first, second, third)] == [p.name for p in PROBLEMS]
    assert rules[1]["help"]["text"] == "Delete it."
    assert first["message"] == {"text": "100% wrong: a, b\ntype\none"}
    place = first["locations"][0]["physicalLocation"]  # type: ignore[index]
    assert place["artifactLocation"] == {"uri": "lab%201/%C3%A4.skill", "uriBaseId": "ROOT"}
    assert place["region"] == {"startLine": 2, "startColumn": 5, "endLine": 2, "endColumn": 9}
    elsewhere = first["relatedLocations"][0]["physicalLocation"]["artifactLocation"]  # type: ignore[index]
    assert elsewhere == {"uri": "file:///opt/robot.ttl"}
    replacement = first["fixes"][0]["artifactChanges"][0]["replacements"][0]  # type: ignore[index]
    assert replacement["insertedContent"] == {"text": " "}
    assert (second["level"], third["message"]) == ("warning", {"text": "never\x1b read"})


def test_workflow_commands_escape_what_the_runner_would_read() -> None:
    assert github.render(PROBLEMS, {}).splitlines() == [
        "::error file=lab 1/ä.skill,line=2,endLine=2,col=5,endColumn=9,title=missing-space-after-colon"
        "::100%25 wrong: a, b%0Atype%0Aone",
        "::warning file=a.skill,line=4,endLine=6,title=unused-let::never read",
        "::warning file=a.skill,line=9,endLine=9,col=5,endColumn=5,title=unused-let"
        "::never\N{REPLACEMENT CHARACTER} read",
    ]
    odd = Diagnostic("odd", Span("C:\\a,b%.skill", 1, 1, 1, 2), "x\r\ny")
    assert github.render([odd], {}) == (
        "::error file=C%3A\\a%2Cb%25.skill,line=1,endLine=1,col=1,endColumn=2,title=odd::x%0D%0Ay\n"
    )
