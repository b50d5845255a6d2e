"""What is looked up in JSON-LD before it is parsed: contexts on the network, depth, prefixes, and identifiers."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import Any, NamedTuple

FLATTEN = "give the things in it names, and state them beside each other"
_TOO_DEEP = "it is nested too deeply"
INDENT = 256
"""The greatest number of characters between a bracket and a key that are looked at."""
_COLON, _CLOSE = re.compile(r"\s*:"), re.compile(r"\s*\}")
_STRING = re.compile(r'"([^"\\]*(?:\\.[^"\\]*)*)"')


class JsonLdProblem(NamedTuple):
    """What is wrong, what to do about it, and where: line and column from 1."""

    message: str
    help: str
    line: int = 1
    column: int = 1


def find_problem(text: str, deepest: int) -> JsonLdProblem | None:
    """Return why a text cannot be read as JSON-LD, None if nothing is wrong with it as JSON.

    `deepest` is the greatest depth of nested objects and lists.
    """
    try:
        document = json.loads(text.removeprefix("\ufeff"))
    except json.JSONDecodeError as error:
        return JsonLdProblem(f"this file is not JSON: {error.msg}", "correct the file", error.lineno, error.colno)
    except (RecursionError, ValueError) as error:
        reason = _TOO_DEEP if isinstance(error, RecursionError) else "a number is too long"
        return JsonLdProblem(f"this file cannot be read: {reason}", FLATTEN)
    if _depth(text) > deepest:
        return JsonLdProblem(f"this file cannot be read: {_TOO_DEEP}", FLATTEN)
    remote = next(_remote_contexts(document), None)
    if remote is None:
        return None
    at = max(text.find(json.dumps(remote)), 0)
    line, column = text.count("\n", 0, at) + 1, at - text.rfind("\n", 0, at)
    message = f"the context <{remote}> is in another file, and nothing is fetched"
    return JsonLdProblem(message, "write the content of the context into this file", line, column)


def find_prefixes(text: str) -> dict[str, str]:
    """Return the prefixes that the contexts of valid JSON-LD define: terms for IRIs that end with `#` or `/`."""
    found: dict[str, str] = {}
    for context in _contexts(json.loads(text.removeprefix("\ufeff"))):
        for name, value in context.items() if isinstance(context, dict) else ():
            iri = value.get("@id") if isinstance(value, dict) else value
            if isinstance(iri, str) and iri.endswith(("#", "/")) and ":" in iri and not name.startswith("@"):
                found.setdefault(name, iri)
    return found


def find_names(text: str) -> dict[str, tuple[int, int]]:
    """Return where each string that is a value is written: its offsets, quotes included.

    It is where an object is about it (`"@id"`, or a term that means it, beside other keys), else a reference to it,
    else its first place.
    """
    keys = {"@id", *re.findall(r'"([^"\\]+)"\s*:\s*"@id"', text)} - {"@type"}
    subjects, references, others = (
        dict[str, tuple[int, int]](),
        dict[str, tuple[int, int]](),
        dict[str, tuple[int, int]](),
    )
    key, key_at = "", 0
    for match in _STRING.finditer(text):
        if _COLON.match(text, match.end()):
            key, key_at = match[1], match.start()
            continue
        alone = text[max(key_at - INDENT, 0) : key_at].rstrip().endswith("{")
        is_reference = alone and _CLOSE.match(text, match.end())
        found = others if key not in keys else references if is_reference else subjects
        found.setdefault(match[1].replace("\\/", "/"), match.span())
    return others | references | subjects


def _depth(text: str) -> int:
    depth = deepest = 0
    for bracket in re.findall(r"[{}\[\]]", _STRING.sub("", text)):
        depth += 1 if bracket in "{[" else -1
        deepest = max(deepest, depth)
    return deepest


def _contexts(node: Any) -> Iterator[Any]:
    """Yield all contexts of a document, each of a list of contexts on its own."""
    if isinstance(node, dict) and "@context" in node:
        stated = node["@context"]
        yield from stated if isinstance(stated, list) else [stated]
    parts = node.values() if isinstance(node, dict) else node if isinstance(node, list) else ()
    for each in parts:
        yield from _contexts(each)


def _remote_contexts(node: Any) -> Iterator[str]:
    for context in _contexts(node):
        if isinstance(context, str):
            yield context
        elif isinstance(context, dict) and isinstance(context.get("@import"), str):
            yield context["@import"]
