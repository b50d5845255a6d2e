"""When skillc itself fails, the editor has fresh problems all the same, and the next edit is analysed again."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from types import SimpleNamespace

import pytest
from lsprotocol import types

from skillc.lsp import libraries
from skillc.lsp.session import Session
from skillc_compiler.ide.analysis import Analysis, AnalysisInput, analyse
from skillc_dsl.diagnostics import Outcome
from skillc_dsl.parsing.parser import parse
from skillc_model.skills import SkillLibrary

GOOD = 'skill Rest { noplan }\nimpl waiting of Rest { run python "skillc.primitives:StandIn" }\n'
ILL = GOOD + "# it fails\nskill Walk { in arm ArmDevice }\n"


@dataclass
class Editor:
    """What the server says to an editor."""

    workspace: SimpleNamespace = field(default_factory=lambda: SimpleNamespace(position_encoding="utf-16"))
    told: dict[str, list[types.Diagnostic]] = field(default_factory=dict)

    def text_document_publish_diagnostics(self, params: types.PublishDiagnosticsParams) -> None:
        self.told[params.uri] = list(params.diagnostics)

    def codes(self, uri: str) -> list[object]:
        return [each.code for each in self.told[uri] if each.severity == types.DiagnosticSeverity.Error]


def fail() -> Outcome[SkillLibrary]:
    raise RuntimeError("what nobody thought of")


@pytest.fixture
def uri(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """A file in a folder of its own; reports go there, too."""
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr("tempfile.tempdir", None)
    return (tmp_path / "a.skill").as_uri()


@pytest.mark.parametrize("late", [False, True], ids=["while resolving", "while checking"])
def test_a_failure_is_told_and_the_next_edit_is_analysed(
    uri: str, late: bool, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    def failing(library: AnalysisInput, parsed_by: object, memo: object) -> Analysis:
        found = analyse(library, parse)
        if "# it fails" in library.sources["a.skill"].text:
            if not late:
                raise RuntimeError("what nobody thought of")
            found.__dict__["compiled"] = property(lambda self: fail())
        return found

    monkeypatch.setattr(libraries, "analyse", failing)
    editor = Editor()
    session = Session(editor)  # type: ignore[arg-type]
    session.libraries.write(uri, GOOD)
    session.publish()
    assert editor.codes(uri) == []
    for _ in range(2):
        session.libraries.write(uri, ILL)
        session.publish()
        assert editor.codes(uri) == ["internal-error", "syntax"]
    (report,) = tmp_path.glob("skillc-crash-*.txt")
    assert report.name in editor.told[uri][0].message
    session.libraries.write(uri, GOOD)
    session.publish()
    assert editor.codes(uri) == []
