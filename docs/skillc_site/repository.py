"""Links from pages to files of the repository: the files become pages of the site, too."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from pathlib import Path

ROOT = Path(__file__).parents[2]
FENCED = re.compile(r"^ *```.*?^ *```$", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"(?<=\]\()(?!https?:|#|mailto:)([^)\s#]+)(#[^)\s]*)?(?=\))")
IMAGE = re.compile(r'(?<=src=")(?!https?:)([^"#]+)()(?=")')
LANGUAGES = {".py": "python", ".ttl": "turtle", ".xml": "xml", ".toml": "toml", ".skill": "skill", ".json": "json"}
LANGUAGES |= {".yml": "yaml", ".yaml": "yaml", ".md": "markdown", ".ipynb": "json"}


class Links:
    """Rewrites the links of pages, and remembers which files of the repository they lead to.

    `pages` has the name in the site of each file that is a page of it.
    """

    def __init__(self, pages: Mapping[Path, str]) -> None:
        self._pages = pages
        self._files: dict[Path, str] = {}
        self.missing: list[str] = []
        """A sentence for each link that leads to no file of the repository."""

    def rewrite(self, text: str, path: Path, name: str) -> str:
        """Return the Markdown `text` of the file `path` with the links that the page `name` of the site needs."""
        parts, end = [], 0
        for fenced in FENCED.finditer(text):
            parts += [self._rewrite_prose(text[end : fenced.start()], path, name), fenced[0]]
            end = fenced.end()
        return "".join((*parts, self._rewrite_prose(text[end:], path, name)))

    def linked_files(self) -> dict[str, str]:
        """Return a page for each linked file or folder, by its name in the site."""
        return {name: _file_page(path) for path, name in sorted(self._files.items())}

    def _rewrite_prose(self, text: str, path: Path, name: str) -> str:
        def target(link: re.Match[str]) -> str:
            return self._target(link[1], path, name) + (link[2] or "")

        return IMAGE.sub(target, LINK.sub(target, text))

    def _target(self, link: str, path: Path, name: str) -> str:
        file = (path.parent / link).resolve()
        if not file.is_relative_to(ROOT) or not file.exists():
            self.missing.append(f"{path.relative_to(ROOT).as_posix()}: the link '{link}' leads to no file")
            return link
        if file in self._pages:
            target = self._pages[file]
        elif file.is_relative_to(ROOT / "docs") and file.is_file():
            target = file.relative_to(ROOT / "docs").as_posix()
        else:
            target = self._files.setdefault(file, f"files/{file.relative_to(ROOT).as_posix()}.md")
        return os.path.relpath(target, Path(name).parent).replace(os.sep, "/")


def _file_page(path: Path) -> str:
    title = f"# {path.relative_to(ROOT).as_posix()}\n\n"
    if path.is_dir():
        return title + "\n".join(
            f"- `{each.name}`" for each in sorted(path.iterdir()) if not each.name.startswith("__")
        )
    language = LANGUAGES.get(path.suffix, "text")
    return f"---\nsearch:\n  exclude: true\n---\n\n{title}````{language}\n{path.read_text('utf-8')}````\n"
