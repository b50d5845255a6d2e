"""Tells texts in another format, which make no sense as Turtle from the first line on."""

from __future__ import annotations

import re

_FORMATS = {
    "RDF/XML": re.compile(r"\s*<(?:\?xml|!DOCTYPE|!ENTITY|rdf:RDF|[\w-]+:[\w-]+[\s>])"),
    "JSON": re.compile(r'\s*(?:\{\s*["}]|\[\s*\{)'),
    "HTML": re.compile(r"\s*<(?:html|head|body)\b", re.IGNORECASE),
    "a skill library": re.compile(r"(?:\s|#[^\n]*\n)*(?:use\s+\w+\s*(?:,|\n)|(?:skill|task|import|impl)\s+[\"\w])"),
}
_CONVERTERS = {"RDF/XML": "xml", "JSON": "json-ld"}


def other_format(text: str) -> tuple[str, str] | None:
    """Return the name of another format that a text is in, and what to do; None for one that may be Turtle."""
    for name, pattern in _FORMATS.items():
        if pattern.match(text):
            option = _CONVERTERS.get(name)
            help_ = f"convert it: `rdfpipe -i {option} -o turtle FILE`" if option else "give a file in Turtle"
            return name, help_
    return None
