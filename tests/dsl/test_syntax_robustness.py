"""Whatever the text, the parser ends, yields a file, and says what is wrong."""

from collections.abc import Callable

import pytest
from examples import EVERYTHING, PICK, VOCABULARY, WHOLE, WIPE
from hypothesis import given, settings
from hypothesis import strategies as st

from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Outcome
from skillc_dsl.encoding import decode
from skillc_dsl.parsing.lexer import tokenize
from skillc_dsl.parsing.parser import parse
from skillc_dsl.parsing.tables import load_tables
from skillc_dsl.source import Source

WORDS = [(t.start_pos or 0, t.end_pos or 0) for t in tokenize(Source("", WHOLE)).value]
EDITS: dict[str, Callable[[str, str], str]] = {
    "delete": lambda word, other: "",
    "double": lambda word, other: f"{word} {word}",
    "swap": lambda word, other: other,
}


def check(outcome: Outcome[s.File], text: str) -> None:
    """A file comes out, and every place is in the text."""
    lines = text.split("\n")
    assert isinstance(outcome.value, s.File)
    for diagnostic in outcome.diagnostics:
        span = diagnostic.span
        assert 1 <= span.line <= span.end_line <= len(lines)
        assert 1 <= span.column <= len(lines[span.line - 1]) + 1
        assert diagnostic.message


@settings(max_examples=40)
@given(st.lists(st.tuples(st.sampled_from(sorted(EDITS)), st.sampled_from(WORDS), st.sampled_from(WORDS)), max_size=6))
def test_random_edits(edits: list[tuple[str, tuple[int, int], tuple[int, int]]]) -> None:
    text = WHOLE
    for kind, (start, end), (other_start, other_end) in sorted(edits, key=lambda edit: edit[1], reverse=True):
        text = text[:start] + EDITS[kind](WHOLE[start:end], WHOLE[other_start:other_end]) + text[end:]
    check(parse(Source("", text)), text)


@settings(max_examples=75)
@given(st.text(alphabet=st.sampled_from('skil{}()[]:.,=<>"#\n -+*/_aé5m°\t\r\0�')))
def test_random_text(text: str) -> None:
    check(parse(Source("", text)), text)


@pytest.mark.parametrize("text", [PICK, WIPE, EVERYTHING], ids=["pick", "wipe", "everything"])
def test_truncated_files(text: str) -> None:
    data = text.replace("gone", "größe").encode()
    beginnings = 0
    for cut in range(0, len(data), 7):
        source = decode("cut.skill", data[:cut])
        outcome = parse(source)
        check(outcome, source.text)
        if source.text.count("{") > source.text.count("}"):
            assert not outcome.ok
            beginnings += 1
    assert beginnings > 50


@pytest.mark.parametrize("before", ["", "skill ", "impl x of ", "skill X {\n    ", "impl x of X {\n    do "])
def test_a_file_that_ends_after_any_word(before: str) -> None:
    words = load_tables().words
    assert len(words) > 50
    for word in words:
        check(parse(Source("", before + word)), before + word)


def test_a_broken_member_costs_only_itself() -> None:
    whole = parse(Source("", PICK)).value.declarations[0]
    assert isinstance(whole, s.SkillDeclaration)
    lines = PICK.split("\n")
    tried = 0
    for index, line in enumerate(lines):
        if line.startswith("    ") and not line.lstrip().startswith("duration"):
            broken = "\n".join([*lines[:index], line.split("   ")[0] + "    hold , ,", *lines[index + 1 :]])
            outcome = parse(Source("", broken))
            (skill,) = outcome.value.declarations
            assert isinstance(skill, s.SkillDeclaration)
            assert len(skill.members) == len(whole.members) - 1
            assert [d.span.line for d in outcome.diagnostics] == [index + 1]
            tried += 1
    assert tried == 15


def test_an_unterminated_text_ends_with_its_line() -> None:
    outcome = parse(Source("", 'task t {\n    scene "a.ttl\n    goal a contain b\n}\n'))
    assert [(d.name, d.span.line) for d in outcome.diagnostics] == [("unterminated-string", 2)]
    (task,) = outcome.value.declarations
    assert isinstance(task, s.TaskDeclaration)
    assert task.scene is not None
    assert (task.scene.value, task.goal_text) == ("a.ttl", "a contain b")


def test_bytes_that_are_no_text() -> None:
    outcome = parse(decode("a.skill", b"\xef\xbb\xbfclass A < B\r\n# caf\xe9\r\nclass C < D\r\n"))
    assert [(d.name, d.span.line, d.span.column) for d in outcome.diagnostics] == [("encoding", 2, 6)]
    assert len(outcome.value.declarations) == 2


NO_TEXT = [
    ("skill A { }".encode("utf-16"), 1, "UTF-16"),
    ("skill A { }".encode("utf-16-le"), 1, "UTF-16"),
    ("skill A { }".encode("utf-32"), 1, "UTF-32"),
    (b"\x7fELF\x02\x01\x01" + bytes(range(256)) * 8, 8, "NUL"),
    (b"# fine\nskill A { }\n\x00\x00", 1, "NUL"),
    (b"skill \xe9t\xe9 {\n    in \xe0: B\n}\nskill \xe8 {", 7, "nor at 3 later places"),
]


@pytest.mark.parametrize(("data", "column", "words"), NO_TEXT)
def test_a_file_in_another_encoding_is_told_once(data: bytes, column: int, words: str) -> None:
    (problem,) = parse(decode("a.skill", data)).diagnostics
    assert (problem.name, problem.span.column) == ("encoding", column)
    assert words in problem.message
    assert "UTF-8" in problem.help


@pytest.mark.parametrize("text", ["(" * 3000, "not " * 3000, "f(" * 1000 + ")" * 1000, "a + " * 3000 + "a"])
def test_deep_text(text: str) -> None:
    whole = f"impl x of Y {{\npre {text}\n}}"
    check(parse(Source("", whole)), whole)


def test_an_empty_file_is_a_file() -> None:
    for text in ("", "\n", "# nothing"):
        outcome = parse(Source("", text))
        assert outcome.diagnostics == ()
        assert outcome.value == s.File("", (), ())


def test_headers_are_read_without_declarations() -> None:
    header = VOCABULARY.split("class", 1)[0]
    assert len(parse(Source("", header)).value.header) == 3


def test_two_braces_that_are_missing_at_one_place_end_there() -> None:
    text = "task go {\n    do A(b: c do seq {do seq {  d, e: 2)\n}\n"
    outcome = parse(Source("", text))
    assert outcome.diagnostics
    assert all(problem.span.line == problem.span.end_line == 2 for problem in outcome.diagnostics)
