"""Tables from the cache parse as fresh ones do, and a bad cache costs nothing but time."""

from pathlib import Path

from examples import WHOLE

from skillc_dsl.parsing.grammar import grammar_text, make_parser


def test_kept_tables_parse_alike(tmp_path: Path) -> None:
    fresh = make_parser(grammar_text(), None).parse(WHOLE)
    assert make_parser(grammar_text(), tmp_path / "new").parse(WHOLE) == fresh
    (kept,) = (tmp_path / "new").iterdir()
    assert make_parser(grammar_text(), tmp_path / "new").parse(WHOLE) == fresh
    kept.write_bytes(kept.read_bytes()[:-5])
    assert make_parser(grammar_text(), tmp_path / "new").parse(WHOLE) == fresh


def test_a_folder_that_cannot_be_made_is_no_obstacle(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    assert make_parser(grammar_text(), tmp_path / "file").parse("class A < B").children
