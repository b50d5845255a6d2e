"""JSON Schemas (draft 2020-12) of the files that skillc writes and reads, made from the types in the code."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from importlib.resources import files
from typing import Any, NamedTuple

import msgspec

ADDRESS = "https://w3id.org/skillc/schema"
DRAFT = "https://json-schema.org/draft/2020-12/schema"
RESULT_FORMAT = 2
DIAGNOSTICS_FORMAT = PROJECT_FORMAT = 1
"""Raised with every change of these documents that is not only a new field with a default."""


MAX_NAMED = 6
"""A union of more types than this is named after the first."""


class SchemaOf(NamedTuple):
    """What a schema describes, the version of the format, and the type that is the document."""

    title: str
    description: str
    version: int
    type: Any


def read_schema(name: str) -> str:
    """Return the text of the schema of that name, as it ships."""
    return files("skillc").joinpath("schemas", f"{name}.schema.json").read_text("utf-8")


def make_schema(name: str) -> dict[str, Any]:
    """Return the schema of that name, made from the code."""
    about = SCHEMAS[name]()
    (schema,), components = msgspec.json.schema_components((about.type,), ref_template="#/$defs/{name}")
    head = {
        "$schema": DRAFT,
        "$id": f"{ADDRESS}/{name}-{about.version}.json",
        "title": about.title,
        "description": about.description,
        "version": about.version,
    }
    body = {key: value for key, value in schema.items() if key not in head}
    unions: dict[str, dict[str, Any]] = {}
    document: dict[str, Any] = _select_by_tag({**head, **body, "$defs": components}, unions)
    document["$defs"].update(unions)
    return document


def _select_by_tag(schema: Any, unions: dict[str, dict[str, Any]]) -> Any:
    """Return a schema in which the tag of a union selects its alternative; the unions are added to `unions`.

    With `anyOf` a validator tries every alternative at each level: its time grows exponentially with the depth of a
    tree, and it reports a mistake for all of them.
    """
    if isinstance(schema, list):
        return [_select_by_tag(each, unions) for each in schema]
    if not isinstance(schema, dict):
        return schema
    if "discriminator" not in schema:
        return {key: _select_by_tag(value, unions) for key, value in schema.items()}
    tag, alternatives = schema["discriminator"]["propertyName"], schema["discriminator"]["mapping"]
    name = "Or".join(reference.rpartition("/")[2] for reference in alternatives.values())
    if len(alternatives) > MAX_NAMED:
        name = f"{name[: name.index('Or')]}Or{len(alternatives) - 1}Others"
    union = {
        "type": "object",
        "properties": {tag: {"enum": list(alternatives)}},
        "required": [tag],
        "allOf": [
            {"if": {"properties": {tag: {"const": value}}, "required": [tag]}, "then": {"$ref": reference}}
            for value, reference in alternatives.items()
        ],
    }
    assert unions.setdefault(name, union) == union, f"two unions have the name {name}"
    rest = {key: value for key, value in schema.items() if key not in ("anyOf", "discriminator")}
    return {**rest, "$ref": f"#/$defs/{name}"}


def format_schema(schema: Mapping[str, Any]) -> str:
    """Return a schema as the text of a file."""
    return json.dumps(schema, indent=1, ensure_ascii=False) + "\n"


def _library() -> SchemaOf:
    from skillc_model.skills import FORMAT, SkillLibrary

    what = "A compiled library, library.json, as `skillc compile` writes it. Terms and individuals are IRIs."
    return SchemaOf("skillc library", what, FORMAT, SkillLibrary)


def _events() -> SchemaOf:
    from skillc_runtime.recording.envelope import Envelope
    from skillc_runtime.recording.events import FORMAT

    what = "A line of events.jsonl, which `skillc run --out` writes. Terms and individuals are IRIs with labels."
    return SchemaOf("skillc event", what, FORMAT, Envelope)


def _result() -> SchemaOf:
    from skillc_runtime.evaluation.report.result import TaskResult

    what = "The result of a task: result.json and `skillc run --json`. Individuals are IRIs with labels."
    return SchemaOf("skillc result", what, RESULT_FORMAT, TaskResult)


def _diagnostics() -> SchemaOf:
    from skillc_dsl.rendering.json import DiagnosticData

    what = "What `skillc check --json` prints. Lines and columns count from 1, the end column is exclusive."
    return SchemaOf("skillc diagnostics", what, DIAGNOSTICS_FORMAT, list[DiagnosticData])


def _signals() -> SchemaOf:
    from skillc_runtime.recording.signals.files import FORMAT, SignalDictionary

    what = "The data dictionary signals.json of `skillc run --signals`."
    return SchemaOf("skillc signals", what, FORMAT, SignalDictionary)


def _project() -> SchemaOf:
    from skillc.services.project.manifest import Manifest

    return SchemaOf("skillc project", "The contents of skillc.toml.", PROJECT_FORMAT, Manifest)


SCHEMAS: Mapping[str, Callable[[], SchemaOf]] = {
    "library": _library,
    "events": _events,
    "result": _result,
    "diagnostics": _diagnostics,
    "signals": _signals,
    "project": _project,
}
