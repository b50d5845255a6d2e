"""Tables from the cache parse as fresh ones do, and a bad cache costs nothing but time."""

from pathlib import Path

from examples import WHOLE

from skillc_dsl.grammar import grammar_text
from skillc_dsl.tables import parser_of


def test_kept_tables_parse_alike(tmp_path: Path) -> None:
    fresh = parser_of(grammar_text(), None).parse(WHOLE)
    assert parser_of(grammar_text(), tmp_path / "new").parse(WHOLE) == fresh
    (kept,) = (tmp_path / "new").iterdir()
    assert parser_of(grammar_text(), tmp_path / "new").parse(WHOLE) == fresh
    kept.write_bytes(kept.read_bytes()[:-5])
    assert parser_of(grammar_text(), tmp_path / "new").parse(WHOLE) == fresh


def test_a_folder_that_cannot_be_made_is_no_obstacle(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    assert parser_of(grammar_text(), tmp_path / "file").parse("class A < B").children
