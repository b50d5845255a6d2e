"""Makes untrusted text safe to print: control and bidirectional characters are replaced."""

from __future__ import annotations

import re

from skillc_dsl.encoding import REPLACEMENT

_UNSAFE = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u2028-\u202e\u2066-\u2069\ud800-\udfff]")


def printable(text: str) -> str:
    """Return the text with each unsafe character replaced by one character; tabs and line feeds are kept."""
    return _UNSAFE.sub(REPLACEMENT, text)


def escaped(text: str) -> str:
    """Return JSON text with these characters as escapes, which are equivalent in its strings."""
    return _UNSAFE.sub(lambda found: f"\\u{ord(found.group()):04x}", text)
