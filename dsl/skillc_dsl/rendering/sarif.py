"""Diagnostics as SARIF 2.1.0 (OASIS standard, 2020), which code-scanning services read."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from urllib.parse import quote

from skillc_dsl.diagnostics import Diagnostic, Fix, Label
from skillc_dsl.rendering.printable import escaped
from skillc_dsl.source import Source, Span

SCHEMA = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"
_ROOT = "ROOT"
Object = dict[str, object]


@dataclass(frozen=True, slots=True)
class SarifRule:
    """The documentation of the diagnostics of one name: a summary and a page in Markdown."""

    name: str
    summary: str
    page: str


def render(
    diagnostics: Iterable[Diagnostic], sources: Mapping[str, Source], rules: Mapping[str, SarifRule], version: str
) -> str:
    """Return the log of one run of skillc `version`; `rules` documents the diagnostics by name."""
    found = tuple(diagnostics)
    names = sorted({diagnostic.name for diagnostic in found})
    driver: Object = {
        "name": "skillc",
        "semanticVersion": version,
        "rules": [_rule(name, rules.get(name)) for name in names],
    }
    run: Object = {
        "tool": {"driver": driver},
        "columnKind": "unicodeCodePoints",
        "originalUriBaseIds": {_ROOT: {"description": {"text": "The folder in which skillc was started."}}},
        "results": [_result(diagnostic, names) for diagnostic in found],
    }
    log = {"$schema": SCHEMA, "version": "2.1.0", "runs": [run]}
    return escaped(json.dumps(log, indent=2, ensure_ascii=False)) + "\n"


def _rule(name: str, rule: SarifRule | None) -> Object:
    described: Object = {"id": name, "name": "".join(part.capitalize() for part in name.split("-"))}
    if rule is not None:
        described["shortDescription"] = {"text": rule.summary}
        described["help"] = {"text": rule.page, "markdown": rule.page}
    return described


def _result(diagnostic: Diagnostic, names: Sequence[str]) -> Object:
    text = "\n".join(filter(None, (diagnostic.message, diagnostic.help)))
    result: Object = {
        "ruleId": diagnostic.name,
        "ruleIndex": names.index(diagnostic.name),
        "level": diagnostic.severity,
        "message": {"text": text},
        "locations": [{"physicalLocation": _physical(diagnostic.span)}],
    }
    if diagnostic.labels:
        result["relatedLocations"] = [_related(label, number) for number, label in enumerate(diagnostic.labels)]
    if diagnostic.fix:
        result["fixes"] = [_fix(diagnostic.fix)]
    return result


def _related(label: Label, number: int) -> Object:
    return {"id": number, "physicalLocation": _physical(label.span), "message": {"text": label.message or "here"}}


def _fix(fix: Fix) -> Object:
    replacement: Object = {"deletedRegion": _region(fix.span), "insertedContent": {"text": fix.text}}
    return {
        "description": {"text": fix.message},
        "artifactChanges": [{"artifactLocation": _artifact(fix.span.path), "replacements": [replacement]}],
    }


def _physical(span: Span) -> Object:
    return {"artifactLocation": _artifact(span.path), "region": _region(span)}


def _artifact(path: str) -> Object:
    """Return the location of a file: a relative path is relative to the working directory, others are file URIs."""
    uri = quote(path.replace("\\", "/"))
    return {"uri": f"file://{uri}"} if uri.startswith("/") else {"uri": uri, "uriBaseId": _ROOT}


def _region(span: Span) -> Object:
    """Return the region of a span; as in `Span`, lines and columns count from 1 and the end column is exclusive."""
    return {
        "startLine": span.line,
        "startColumn": span.column,
        "endLine": span.end_line,
        "endColumn": span.end_column,
    }
