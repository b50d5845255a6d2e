"""What holds for tests of looks at tasks in space that say nothing of cures."""

import pytest

from skillc.services.space import look


@pytest.fixture
def incurable(monkeypatch: pytest.MonkeyPatch) -> None:
    """Look for no cures in this test, which takes longer than all else: what it says is not of them."""
    monkeypatch.setattr(look, "find_cure", lambda *given: "")
