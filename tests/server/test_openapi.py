"""The OpenAPI document is one that generators of clients in any language understand."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import msgspec

from skillc.contract.api.endpoint import JSON, PREFIX
from skillc.contract.api.endpoints import ENDPOINTS
from skillc.server.http.openapi import EXAMPLES, PATH_EXAMPLES, find_tag, make_openapi, name_type, simplify_arrays

WORD = re.compile(r"([a-z0-9]+(-[a-z0-9]+)*)?")
"""A word, or none."""
DOCUMENT = msgspec.json.decode(msgspec.json.encode(make_openapi(ENDPOINTS, PREFIX)))
OPERATIONS = [each for path in DOCUMENT["paths"].values() for each in path.values()]
SCHEMAS = DOCUMENT["components"]["schemas"]


def walk(value: Any) -> Iterator[dict[str, Any]]:
    """Yield all objects in a value."""
    if isinstance(value, dict):
        yield value
    for each in value.values() if isinstance(value, dict) else value if isinstance(value, list) else ():
        yield from walk(each)


def test_schemas_use_what_all_generators_know() -> None:
    arrays = [each for each in walk(DOCUMENT) if each.get("type") == "array"]
    assert len(arrays) > 100 and all(isinstance(each.get("items"), dict) for each in arrays)
    assert not [each for each in walk(DOCUMENT) if "prefixItems" in each]
    tuples = [each for each in arrays if each.get("minItems") == each.get("maxItems") == 3]
    assert tuples and all(each["items"] for each in tuples), "the length of a tuple stays"
    assert all(name.isidentifier() and each.get("title", name) == name for name, each in SCHEMAS.items())
    references = {each["$ref"] for each in walk(DOCUMENT) if "$ref" in each}
    assert references and {each.rpartition("/")[2] for each in references} <= SCHEMAS.keys()


def test_words_are_written_as_words_of_paths_are_but_for_those_of_the_language() -> None:
    of_language = walk([SCHEMAS[name] for name in ("Arithmetic", "Compare", "PlainType")])
    own = {word for each in of_language for word in each.get("enum", ())}
    words = {word for each in walk(DOCUMENT) for word in each.get("enum", ()) if isinstance(word, str)}
    assert len(words - own) > 100
    assert [each for each in words - own if not WORD.fullmatch(each)] == []


def test_operations_have_what_clients_are_made_of() -> None:
    tags, names = {each["name"] for each in DOCUMENT["tags"]}, [each["operationId"] for each in OPERATIONS]
    assert len(names) == len(set(names)) == len(ENDPOINTS) + 2
    assert {tag for each in OPERATIONS for tag in each["tags"]} == tags and DOCUMENT["servers"]
    for each in OPERATIONS:
        answers, name = each["responses"], each["operationId"]
        (success,) = [status for status in answers if status.startswith("2")]
        assert len(each["tags"]) == 1 and each["summary"] and all(it["description"] for it in answers.values()), name
        contents = answers[success].get("content", {})
        assert (success == "204") == (not contents), name
        assert all(content.get("schema") for content in contents.values()), name
        assert each["security"] == [] or {"401", "403", "422"} <= answers.keys(), name


def test_examples_are_what_the_server_takes() -> None:
    with_body = {each.name: each for each in ENDPOINTS if each.body is not None}
    assert EXAMPLES.keys() <= with_body.keys()
    for name, example in EXAMPLES.items():
        body = next(each for each in OPERATIONS if each["operationId"] == name)["requestBody"]
        assert msgspec.convert(body["content"][JSON]["example"], with_body[name].body) == example, name
    assert PATH_EXAMPLES.keys() <= {part for each in ENDPOINTS for part in each.path_parameters}


def test_the_tag_is_the_innermost_resource() -> None:
    paths = ("/cells/{cell}/pace", "/cells/{cell}/world/edits", "/jobs/{job}/result", "/metrics")
    assert [find_tag(each) for each in paths] == ["cells", "world", "jobs", "server"]


def test_tuples_of_different_items_take_any_of_them() -> None:
    text, number = {"type": "string"}, {"type": "number"}
    made = {"type": "array", "minItems": 3, "maxItems": 3, "prefixItems": [text, number, text], "items": False}
    expected = {"type": "array", "minItems": 3, "maxItems": 3, "items": {"anyOf": [text, number]}}
    assert simplify_arrays({"a": made}) == {"a": expected}
    assert simplify_arrays({"$ref": "#/a.b.c"}, {"#/a.b.c": "#/BC"}) == {"$ref": "#/BC"}
    assert (name_type("a.run_commands.Retry"), name_type("Retry")) == ("RunCommandsRetry", "Retry")
