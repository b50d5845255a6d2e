"""Columns are counted in UTF-16 on the wire, whatever letters stand before them; or in what the editor asks for."""

from __future__ import annotations

import sys

import pytest
from lsprotocol import types

from editor.desk import Desk
from skillc.lsp.positions import PositionConverter, column_at, count_units
from skillc_dsl.source import Span

UTF_8, UTF_16, UTF_32 = (kind.value for kind in types.PositionEncodingKind)
SAMPLES = ["", "arm", "Größe", "🦾 arm", "a🦾ß\u2028b\x0cc"]
LETTERS = """use rparts

## Bewegt den Träger 🦾 zügig.
skill Überfahren {{
    in   träger: ArmDevice
    opt  höhe:   Length = 3 cm  # 🦾🦾 größer
    {0}
    noplan
}}
"""


@pytest.mark.parametrize("encoding", [UTF_8, UTF_16, UTF_32])
@pytest.mark.parametrize("line", SAMPLES)
def test_columns_go_there_and_back(line: str, encoding: str) -> None:
    for index in range(len(line) + 1):
        assert column_at(line, count_units(line[:index], encoding), encoding) == index + 1
    assert column_at(line, count_units(line, encoding) + 7, encoding) == len(line) + 1


def test_units_are_those_of_the_codecs() -> None:
    for line in SAMPLES:
        assert count_units(line, UTF_8) == len(line.encode())
        assert count_units(line, UTF_16) == len(line.encode("utf-16-le")) // 2
        assert count_units(line, UTF_32) == len(line)
    assert sys.maxunicode > 0xFFFF


def test_a_place_inside_a_letter_is_after_it() -> None:
    assert column_at("🦾x", 1, UTF_16) == 2


def test_a_span_beyond_the_text_is_at_its_line() -> None:
    lines = PositionConverter({"a": "x"}, UTF_16)
    assert lines.range(Span("a", 3, 9, 3, 12)) == types.Range(types.Position(2, 0), types.Position(2, 0))
    assert lines.range(Span("nowhere", 1, 1, 1, 1)) == types.Range(types.Position(0, 0), types.Position(0, 0))


@pytest.mark.asyncio(loop_scope="session")
async def test_problems_after_foreign_letters_are_at_their_place(desk: Desk) -> None:
    line = 'pre  länge: höhe < höehe and "🦾🦾" == hoch'
    desk.open("letters.skill", LETTERS.format(line))
    found = await desk.problems("letters.skill")
    wrong = {str(p.message).split("`")[-2]: p.range for p in found if p.code == "unknown-parameter"}
    assert wrong["höhe"].start == types.Position(6, 4 + line.index("höehe"))
    hoch = next(p.range for p in found if "`hoch`" in p.message)
    assert hoch.start == types.Position(6, 4 + line.index("hoch") + 2)
    assert hoch.end.character - hoch.start.character == len("hoch")


@pytest.mark.asyncio(loop_scope="session")
async def test_names_after_foreign_letters_are_found(desk: Desk) -> None:
    text = LETTERS.format('pre  "🦾🦾" == "ß" and trä|ger.deviceState != Fault')
    found = await desk.client.text_document_references_async(
        types.ReferenceParams(types.ReferenceContext(include_declaration=True), *desk.at("letters.skill", text))
    )
    assert [place.range.start for place in found or ()] == [types.Position(4, 9), types.Position(6, 27)]
