"""Python is read once while it is the same: what has changed, moved or come is read again after `refresh`."""

from __future__ import annotations

from pathlib import Path

import pytest

from skillc_compiler.python.info import ClassInfo, NoModule, NoName
from skillc_compiler.python.targets import Targets


def test_a_module_that_has_changed_or_come_is_read_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(tmp_path))
    package, targets = tmp_path / "own_primitives", Targets()
    package.mkdir()
    (package / "__init__.py").touch()
    (package / "look.py").write_text("class Look:\n    def tick(self): ...\n", encoding="utf-8")
    first = targets.read("own_primitives.look", "Look")
    assert isinstance(first, ClassInfo)
    assert isinstance(targets.read("own_primitives.push", "Push"), NoModule)
    targets.refresh()
    assert targets.read("own_primitives.look", "Look") is first
    (package / "look.py").write_text("class Gaze:\n    def tick(self): ...\n", encoding="utf-8")
    (package / "push.py").write_text("class Push: ...\n", encoding="utf-8")
    assert targets.read("own_primitives.look", "Look") is first
    targets.refresh()
    assert targets.read("own_primitives.look", "Look") == NoName(("Gaze",))
    assert isinstance(targets.read("own_primitives.push", "Push"), ClassInfo)
