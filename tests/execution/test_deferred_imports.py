"""Imports that are put off until something in the module is used."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from skillc_runtime.platforms.python_modules import defer_import


def test_a_deferred_module_is_executed_at_its_first_use(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Importing it executes nothing; its names, and its own modules, are there when they are used."""
    package = tmp_path / "seldom_used"
    package.mkdir()
    (package / "__init__.py").write_text("import seldom_used.part\nNUMBER = 3\n")
    (package / "part.py").write_text("")
    monkeypatch.syspath_prepend(str(tmp_path))
    defer_import("seldom_used")
    import seldom_used

    assert "seldom_used.part" not in sys.modules
    assert seldom_used.NUMBER == 3
    assert "seldom_used.part" in sys.modules
    assert sys.modules["seldom_used"].NUMBER == 3
    defer_import("no_such_module")
    assert "no_such_module" not in sys.modules
