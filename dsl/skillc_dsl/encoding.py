"""From the bytes of a file to its text; each file that is not UTF-8 is reported once."""

from __future__ import annotations

import errno
import io
import re
import stat
import zlib
from pathlib import Path

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Source, Span

REPLACEMENT = "\N{REPLACEMENT CHARACTER}"
"""The character that decoding puts in the place of each byte that is not UTF-8."""
MOST_CHARACTERS = 500_000
"""The maximum length of a file; longer files are not read."""
MOST_BYTES = 4 * MOST_CHARACTERS + 4
"""More bytes than MOST_CHARACTERS can take in UTF-8."""
_NO_UTF_8 = re.compile("[\udc80-\udcff]")
"""What Python puts in the place of bytes that are not UTF-8: halves of characters, which no UTF-8 has."""
_NUL = "\0"
_GZIP = b"\x1f\x8b"
"""The first bytes of what gzip has compressed."""
MOST_UNPACKED = 512 * 2**20
"""The maximum length in bytes of what a compressed file contains; longer content is not read."""


def decode(path: str, data: bytes) -> Source:
    """Return the text of a file; bytes that are not UTF-8 become U+FFFD, which `parse` reports as `encoding`."""
    text = normalise_text(data.decode("utf-8", errors="surrogateescape"))
    unreadable = tuple(match.start() for match in _NO_UTF_8.finditer(text))
    return Source(path, _NO_UTF_8.sub(REPLACEMENT, text) if unreadable else text, unreadable)


def normalise_text(text: str) -> str:
    """Return a text without a byte order mark, and with LF at the end of each line."""
    return normalise_newlines(text.removeprefix("\ufeff"))


def normalise_newlines(text: str) -> str:
    """Return a text with LF at the end of each line, for CR LF, CR and LF.

    Form feeds, U+0085 and U+2028 do not end a line, as in editors and the Language Server Protocol.
    """
    return text.replace("\r\n", "\n").replace("\r", "\n")


def split_lines(text: str) -> list[str]:
    """Return the lines of a text, each with its end."""
    lines = text.split("\n")
    return [*(f"{line}\n" for line in lines[:-1]), *([lines[-1]] if lines[-1] else [])]


def read_file(path: Path, most: int = -1) -> bytes:
    """Return the content of a file, `most` bytes of it at most; OSError for a pipe, a device or a folder."""
    status = path.stat()
    if not stat.S_ISREG(status.st_mode):
        raise OSError(errno.EINVAL, "it is not a regular file", str(path))
    with path.open("rb", buffering=0) as file:
        return file.read(most if 0 <= most < status.st_size else -1)


def is_packed(content: bytes) -> bool:
    """Whether the content of a file is compressed by gzip."""
    return content.startswith(_GZIP)


def unpack(content: bytes) -> bytes:
    """Return what is in a file that gzip has compressed, other content as it is.

    OSError if it is damaged, or longer than MOST_UNPACKED.
    """
    if not is_packed(content):
        return content
    import gzip  # few files are compressed

    try:
        with gzip.GzipFile(fileobj=io.BytesIO(content)) as file:
            found = file.read(MOST_UNPACKED + 1)
    except (OSError, EOFError, zlib.error) as error:
        raise OSError(errno.EINVAL, "it is compressed by gzip, and damaged: make or copy it again") from error
    if len(found) > MOST_UNPACKED:
        raise OSError(errno.EFBIG, f"it is compressed, and contains more than {MOST_UNPACKED // 2**20} MB")
    return found


def pack(content: bytes) -> bytes:
    """Return content compressed by gzip, without the time."""
    import gzip

    return gzip.compress(content, mtime=0)


def report_not_text(source: Source) -> Diagnostic | None:
    """Return the problem of a file that is in another encoding from end to end, or no text at all."""
    if _NUL not in source.text:
        return None
    if source.unreadable[:2] == (0, 1) or source.text[1:2] == _NUL or source.text.startswith(_NUL):
        return _problem(source, 0, "the file is UTF-16 or UTF-32, not UTF-8")
    return _problem(source, source.text.index(_NUL), "the file is not text: it has NUL bytes")


def report_too_large(source: Source) -> Diagnostic | None:
    """Return the problem of a file that is too long to be read."""
    if len(source.text) <= MOST_CHARACTERS:
        return None
    return Diagnostic(
        "file-too-large",
        Span(source.path, 1, 1, 1, 2),
        f"the file is longer than {MOST_CHARACTERS:,} characters, so it is not read",
        "split it into several files, which import each other",
    )


def report_wrong_bytes(source: Source) -> Diagnostic | None:
    """Return the problem of a file with some bytes that are not UTF-8, at the first of them."""
    if not source.unreadable:
        return None
    first, *others = source.unreadable
    later = f", nor at {len(others)} later place{'s' * (len(others) > 1)}" if others else ""
    return _problem(source, first, f"the file is not UTF-8 here{later}")


def _problem(source: Source, position: int, message: str) -> Diagnostic:
    line = source.text.count("\n", 0, position) + 1
    column = position - source.text.rfind("\n", 0, position)
    return Diagnostic("encoding", Span(source.path, line, column, line, column + 1), message, "save it as UTF-8")
