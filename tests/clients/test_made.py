"""Clients have what the contract says, editors the words of the language: what is made is what would be made now."""

from __future__ import annotations

import pytest

from clients.made import MADE, MadeModule

TOLD = "run `python tests/accept.py`"


@pytest.mark.parametrize("made", MADE, ids=lambda each: each.file.stem)
def test_a_module_is_up_to_date(made: MadeModule) -> None:
    assert made.file.read_text("utf-8") == made.make(), TOLD
