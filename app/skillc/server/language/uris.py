"""The addresses of texts: `skill:///LIBRARY/PATH` for pages, those of files for a language server."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from urllib.parse import quote, unquote, urlsplit

from skillc.server.library_sources import SourceFile, list_sources
from skillc.server.served_library import ServedLibrary

SCHEME = "skill"
HIDDEN = "skill-hidden"
"""The scheme of a file that pages cannot read, by its name alone."""
URI_KEYS = frozenset({"uri", "targetUri", "rootUri", "oldUri", "newUri", "scopeUri", "baseUri"})


class UnknownText(ValueError):
    """A page names what is no text of its library."""


@dataclass(slots=True)
class TextUris:
    """Translates between the addresses of a library's texts; files that are new are found."""

    library: ServedLibrary
    _sources: dict[str, SourceFile] = field(default_factory=dict)
    _paths: dict[Path, str] = field(default_factory=dict)

    @property
    def _folder(self) -> str:
        return self.library.checked.basis.folders[0]

    @property
    def root(self) -> str:
        """The address of the folder of the library, for a language server."""
        return Path(self._folder).as_uri()

    def from_page(self, message: Any) -> Any:
        """Return a message of a page with the addresses of files; UnknownText for what is no text of the library."""
        return _replace(message, self._find_file)

    def to_page(self, message: Any) -> Any:
        """Return a message for a page: each address of a file, also as a key, is that of a text, each folder a name."""
        return _replace(message, self._find_text, everywhere=True)

    def _find_file(self, uri: str) -> str:
        split = urlsplit(uri)
        library, _, path = unquote(split.path.removeprefix("/")).partition("/")
        if split.scheme != SCHEME or split.netloc or library != self.library.checked.name:
            raise UnknownText(f"{uri[:200]} is no text of the library; write {SCHEME}:///LIBRARY/PATH")
        if path not in self._sources:
            self._look()
        if path not in self._sources:
            raise UnknownText(f"the library has no text `{path[:200]}`")
        return self._sources[path].file.as_uri()

    def _find_text(self, uri: str) -> str:
        folder, colon, rest = uri.partition(":")
        if folder == self._folder:  # of lenses: FOLDER, or FOLDER:TASK
            return f"{self.library.checked.name}{colon}{rest}"
        if not uri.startswith("file:"):
            return uri
        file = Path(unquote(urlsplit(uri).path))
        if file not in self._paths:
            self._look()
        if file not in self._paths:
            return f"{HIDDEN}:///{quote(file.name)}"
        return f"{SCHEME}:///{quote(f'{self.library.checked.name}/{self._paths[file]}')}"

    def _look(self) -> None:
        self._sources = list_sources(self.library)
        self._paths = {each.file: path for path, each in self._sources.items()}


def _replace(value: Any, change: Callable[[str], str], everywhere: bool = False, texts: bool = False) -> Any:
    """Return a JSON value whose addresses are changed: the texts of URI_KEYS.

    `everywhere`: keys and the arguments of commands as well; `texts`: these are such arguments.
    """
    match value:
        case dict():
            return {
                change(key) if everywhere else key: change(item)
                if isinstance(item, str) and key in URI_KEYS
                else _replace(item, change, everywhere, texts or (everywhere and key == "arguments"))
                for key, item in value.items()
            }
        case list():
            return [_replace(item, change, everywhere, texts) for item in value]
        case str() if texts:
            return change(value)
        case _:
            return value
