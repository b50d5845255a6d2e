"""Writing a source file anew: whole or not at all, with its permissions, its line ends and its mark of encoding."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from skillc_dsl.encoding import decode

_MARK = b"\xef\xbb\xbf"


class WriteError(Exception):
    """The file could not be written and is as it was; the message says why."""


def rewrite(path: Path, old: str, new: str) -> None:
    """Put `new` where the decoded text `old` is. WriteError if the file is another one by now or cannot be written."""
    target = path.resolve()
    try:
        content = target.read_bytes()
        if decode("", content).text != old:
            raise WriteError(f"{path} was changed by someone else meanwhile; it is left as it is")
        _replace(target, _encoded(new, content))
    except OSError as error:
        raise WriteError(f"{path} cannot be written: {error.strerror}; it is left as it was") from error


def _encoded(text: str, before: bytes) -> bytes:
    """Return the bytes of a text with the line ends and the mark that the file had."""
    dos = before.count(b"\r\n") > before.count(b"\n") // 2
    mac = b"\n" not in before and b"\r" in before
    content = text.replace("\n", "\r\n" if dos else "\r" if mac else "\n").encode()
    return _MARK + content if before.startswith(_MARK) else content


def _replace(target: Path, content: bytes) -> None:
    descriptor, name = tempfile.mkstemp(prefix=".skillc-", dir=target.parent)
    try:
        with os.fdopen(descriptor, "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        Path(name).chmod(target.stat().st_mode & 0o7777)
        Path(name).replace(target)
    except OSError:
        Path(name).unlink(missing_ok=True)
        raise
