"""Pictures that show themselves in notebooks and can be written to files."""

from __future__ import annotations

from base64 import b64encode
from dataclasses import dataclass
from pathlib import Path

from skillc.errors import RequestError
from skillc.services.reporting.files import writing_to
from skillc.values.arguments import AnyPath, require_path


@dataclass(frozen=True, slots=True)
class Picture:
    """A drawing as SVG; `mermaid` is the same for Markdown, empty if there is no such form."""

    title: str
    svg: str
    mermaid: str = ""

    def save(self, path: AnyPath) -> Path:
        """Write it to a file whose ending says the form, `.svg`, `.mmd` or `.mermaid`; return its path.

        RequestError for another ending, SkillcError if the file cannot be written.
        """
        file = require_path(path, "the file")
        texts = {".svg": self.svg, ".mmd": self.mermaid, ".mermaid": self.mermaid}
        if not texts.get(file.suffix):
            raise RequestError(f"{file}: a picture is written as .svg" + (", .mmd or .mermaid" if self.mermaid else ""))
        with writing_to(file.parent):
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(texts[file.suffix], encoding="utf-8")
        return file

    def _repr_svg_(self) -> str:
        return self.svg


@dataclass(frozen=True, slots=True)
class Figure:
    """A figure of a report, in a file; notebooks show it."""

    path: Path

    @property
    def name(self) -> str:
        """The name of its file, without suffix."""
        return self.path.stem

    def _repr_png_(self) -> bytes:
        return self.path.read_bytes()


@dataclass(frozen=True, slots=True)
class Film:
    """The film of a run, in a file; notebooks play it."""

    path: Path

    def _repr_html_(self) -> str:
        content = b64encode(self.path.read_bytes()).decode("ascii")
        return f'<video controls loop style="max-width: 100%" src="data:video/mp4;base64,{content}"></video>'
