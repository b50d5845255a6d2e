"""Rewrites JSON Schemas so that generators of clients understand them: in the part of the language that all know."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

NO_NAMES: Mapping[str, str] = {}


def simplify_arrays(schema: Any, references: Mapping[str, str] = NO_NAMES) -> Any:
    """Return a schema, or a document with schemas, in which arrays of a fixed length have one schema for all items.

    `prefixItems` with `items: false`, which msgspec makes of tuples, stops generators. The lengths stay; if the items
    differ, each may be any of them. `references` are replaced.
    """
    if isinstance(schema, str):
        return references.get(schema, schema)
    if isinstance(schema, list | tuple):
        return [simplify_arrays(each, references) for each in schema]
    if not isinstance(schema, Mapping):
        return schema
    found = {name: simplify_arrays(each, references) for name, each in schema.items() if name != "prefixItems"}
    if isinstance(schema.get("prefixItems"), list | tuple):
        found["items"] = _join(simplify_arrays(schema["prefixItems"], references))
    elif schema.get("items") is False:
        found["items"] = {}
    return found


def name_type(name: str) -> str:
    """Return a name for a type of which others have the same name, `package.module.Type`: `ModuleType`."""
    module, _, kind = name.rpartition(".")
    words = module.rpartition(".")[2].split("_") if module else ()
    return "".join(map(str.capitalize, words)) + kind


def _join(schemas: list[Any]) -> Any:
    different = [each for number, each in enumerate(schemas) if each not in schemas[:number]]
    return different[0] if len(different) == 1 else {"anyOf": different}
