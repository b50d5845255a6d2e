"""Documents a field of a struct once, for JSON Schema, the command line, keyword arguments and forms."""

from __future__ import annotations

import msgspec


def documented(text: str, section: str = "Options", metavar: str = "") -> msgspec.Meta:
    """Return what annotates a field: its documentation, where a help lists it, and what stands there for its value."""
    return msgspec.Meta(description=text, extra={"section": section, "metavar": metavar})
