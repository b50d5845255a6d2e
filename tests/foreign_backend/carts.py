"""The back end of the how-to, and its project."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from docs.pages import ROOT, blocks

PAGE = ROOT / "docs/how-to/own-backend.md"
LAB = "http://example.org/lab#"


def write_carts(folder: Path, scene: str = "cell.ttl", replace: Mapping[str, str] | None = None) -> None:
    """Write the project of the page into a folder, with its scene in a file of another name, and other texts."""
    folder.mkdir(parents=True, exist_ok=True)
    for each in blocks(PAGE):
        if each.words and each.language not in ("sh", "text"):
            text = each.text.replace("cell.ttl", scene)
            for before, after in (replace or {}).items():
                text = text.replace(before, after)
            (folder / (scene if each.words == "cell.ttl" else each.words)).write_text(text, "utf-8")
    toml = f'name = "carts"\nscene = "{scene}"\ntask = "carts"\n\n[tool.run]\nbackend = "cart"\n'
    (folder / "skillc.toml").write_text(toml, "utf-8")
