"""From the bytes of a file to its text; files that are not UTF-8 text are told once each."""

from __future__ import annotations

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Source, Span

REPLACEMENT = "\N{REPLACEMENT CHARACTER}"
"""What decoding puts in the place of each byte that is not UTF-8."""
MOST_CHARACTERS = 500_000
"""What is longer is no file that somebody wrote."""
_BYTE_ORDER_MARK = 2 * REPLACEMENT
_NUL = "\0"


def decode(path: str, data: bytes) -> Source:
    """Return the text of a file; bytes that are not UTF-8 become U+FFFD, which `parse` reports as `encoding`."""
    text = data.decode("utf-8-sig", errors="replace")
    return Source(path, text.replace("\r\n", "\n"))


def not_text(source: Source) -> Diagnostic | None:
    """Return the problem of a file that is in another encoding from end to end, or no text at all."""
    if _NUL not in source.text:
        return None
    if source.text.startswith(_BYTE_ORDER_MARK) or source.text[1:2] == _NUL or source.text.startswith(_NUL):
        return _problem(source, 0, "the file is UTF-16 or UTF-32, not UTF-8")
    return _problem(source, source.text.index(_NUL), "the file is no text: it has NUL bytes")


def too_large(source: Source) -> Diagnostic | None:
    """Return the problem of a file that is too long to be read."""
    if len(source.text) <= MOST_CHARACTERS:
        return None
    return Diagnostic(
        "file-too-large",
        Span(source.path, 1, 1, 1, 2),
        f"the file has {len(source.text):,} characters, and {MOST_CHARACTERS:,} are read at most",
        "split it into several files, which import each other",
    )


def wrong_bytes(source: Source) -> Diagnostic | None:
    """Return the problem of a file with some bytes that are not UTF-8, at the first of them."""
    position = source.text.find(REPLACEMENT)
    if position < 0:
        return None
    count = source.text.count(REPLACEMENT)
    later = f", nor at {count - 1} later place{'s' * (count > 2)}" if count > 1 else ""
    return _problem(source, position, f"the file is not UTF-8 here{later}")


def _problem(source: Source, position: int, message: str) -> Diagnostic:
    line = source.text.count("\n", 0, position) + 1
    column = position - source.text.rfind("\n", 0, position)
    return Diagnostic("encoding", Span(source.path, line, column, line, column + 1), message, "save it as UTF-8")
