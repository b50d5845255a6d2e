"""The differences between the Markdown of the pages, which forges show, and that of the site."""

from __future__ import annotations

import re

from skillc_site.diagrams import draw_flowchart

OPENING = re.compile(r"^( *```)([\w-]+)(?: ([^\n`]+))?$", re.MULTILINE)
LANGUAGES = {"ttl": "turtle", "py": "python", "jsonl": "json", "sdf": "xml", "console": "console"}
MERMAID = re.compile(r"^```mermaid\n(.*?)^```$", re.MULTILINE | re.DOTALL)
LIST_AFTER_TEXT = re.compile(r"^(?!\s*(?:[-*] |\d+\. |#|\||```|$))(.+)\n(?=(?:- |1\. ))", re.MULTILINE)


def prepare_page(text: str) -> str:
    """Return a page for the site: names of files become titles of blocks, and lists are set off from what precedes."""
    parts = re.split(r"(^ *```.*?^ *```$)", text, flags=re.MULTILINE | re.DOTALL)
    return "".join(_block(part) if part.lstrip().startswith("```") else _set_off(part) for part in parts)


def _block(fenced: str) -> str:
    chart = MERMAID.fullmatch(fenced)
    return draw_flowchart(chart[1]) if chart else OPENING.sub(_opening, fenced)


def _opening(fence: re.Match[str]) -> str:
    language = LANGUAGES.get(fence[2], fence[2])
    words = fence[3] or ""
    titled = f' title="{words}"' if "." in words or words in ("bad", "good") else ""
    return f"{fence[1]} {language}{titled}" if titled else f"{fence[1]}{language}"


def _set_off(text: str) -> str:
    return LIST_AFTER_TEXT.sub(r"\1\n\n", text)
