"""The parser's tables: made from the grammar once, then kept in the user's cache folder, which is much faster."""

from __future__ import annotations

import hashlib
import io
import os
import sys
import tempfile
from pathlib import Path

import lark
from lark import Lark


def cache_folder() -> Path | None:
    """Return skillc's folder in the user's cache, None for a user without a home."""
    try:
        base = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    except RuntimeError:
        return None
    return base / "skillc" if base.is_absolute() else None


def parser_of(grammar: str, folder: Path | None) -> Lark:
    """Return the parser of `grammar`, from `folder` if it is there and intact; else make and keep it."""
    if folder is None:
        return _make(grammar)
    key = f"{lark.__version__} {sys.version_info[:2]}\n{grammar}"
    path = folder / f"grammar-{hashlib.sha256(key.encode()).hexdigest()[:16]}"
    try:
        content = path.read_bytes()
    except OSError:
        content = b""
    if content and hashlib.sha256(content[32:]).digest() == content[:32]:
        return Lark.load(io.BytesIO(content[32:]))
    parser = _make(grammar)
    _keep(parser, path)
    return parser


def _make(grammar: str) -> Lark:
    return Lark(grammar, parser="lalr", lexer="basic", keep_all_tokens=True, maybe_placeholders=False)


def _keep(parser: Lark, path: Path) -> None:
    """Write the tables whole or not at all; a folder that cannot be written only costs time."""
    content = io.BytesIO()
    parser.save(content)
    try:
        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        with tempfile.NamedTemporaryFile(dir=path.parent, delete=False) as file:
            file.write(hashlib.sha256(content.getvalue()).digest() + content.getvalue())
        Path(file.name).replace(path)
    except OSError:
        return
