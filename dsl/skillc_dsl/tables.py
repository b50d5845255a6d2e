"""The parser's tables: made from the grammar once, then kept in the user's cache folder, which is much faster."""

from __future__ import annotations

import hashlib
import io
import sys
from pathlib import Path

import lark
from lark import Lark

from skillc_dsl.keeping import keep, kept


def parser_of(grammar: str, folder: Path | None) -> Lark:
    """Return the parser of `grammar`, from `folder` if it is there and intact; else make and keep it."""
    if folder is None:
        return _make(grammar)
    key = f"{lark.__version__} {sys.version_info[:2]}\n{grammar}"
    path = folder / f"grammar-{hashlib.sha256(key.encode()).hexdigest()[:16]}"
    tables = kept(path)
    if tables is not None:
        return Lark.load(io.BytesIO(tables))
    parser = _make(grammar)
    content = io.BytesIO()
    parser.save(content)
    keep(path, content.getvalue())
    return parser


def _make(grammar: str) -> Lark:
    return Lark(grammar, parser="lalr", lexer="basic", keep_all_tokens=True, maybe_placeholders=False)
