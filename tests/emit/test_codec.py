"""library.json: what is written is read back, and anything else is refused with what to do."""

from __future__ import annotations

import json

import pytest

from emit.samples import wiping
from skillc_model.codec import LibraryError, dumps, loads
from skillc_model.skills import FORMAT


def test_a_library_is_read_back() -> None:
    assert loads(dumps(wiping()), "sample.json") == wiping()


def test_another_format_is_refused_before_its_content_is_looked_at() -> None:
    old = {**json.loads(dumps(wiping())), "format": FORMAT - 1}
    del old["vocabulary"]
    with pytest.raises(
        LibraryError, match=rf"^old has format {FORMAT - 1}, .* reads {FORMAT}; compile the library again"
    ):
        loads(json.dumps(old).encode(), "old")


@pytest.mark.parametrize("text", ["", "{", "[]", "{}", '{"format": "two"}', f'{{"format": {FORMAT}}}'])
def test_what_is_no_library_is_refused(text: str) -> None:
    with pytest.raises(LibraryError, match=r"^x is not a compiled library .*`skillc compile`"):
        loads(text.encode(), "x")
