"""What is too deep, too long or too wrong is refused where it begins, and everything else is understood."""

import pytest

from skillc_dsl import syntax as s
from skillc_dsl.encoding import MOST_CHARACTERS
from skillc_dsl.formatting.formatter import format_source
from skillc_dsl.parsing.nesting import DEEPEST
from skillc_dsl.parsing.parser import MOST_PROBLEMS, parse
from skillc_dsl.source import Source

DEEP = {
    "seq": lambda n: f"do {'seq { ' * n}wait 1 s{' }' * n}",
    "par": lambda n: f"do {'par all { ' * n}wait 1 s{' }' * n}",
    "while": lambda n: f"do {'while a == b max 3 { ' * n}wait 1 s{' }' * n}",
    "for": lambda n: f"do {'for x in y { ' * n}wait 1 s{' }' * n}",
    "else if": lambda n: f"do if a == b {{ wait 1 s }}{' else if a == b { wait 1 s }' * (n - 1)}",
    "sum": lambda n: f"let x = a{' + a' * n}",
    "product": lambda n: f"let x = a{' * a' * n}",
    "parentheses": lambda n: f"let x = {'(' * n}a{')' * n}",
    "not": lambda n: f"pre {'not ' * n}a == b",
    "implies": lambda n: f"pre {'a == b implies ' * n}a == b",
    "exists": lambda n: f"pre {'exists q: C (' * n}a == b{')' * n}",
    "call": lambda n: f"let x = {'f(' * n}a{')' * n}",
    "member": lambda n: f"let x = a{'.b' * n}",
}


@pytest.mark.slow
@pytest.mark.parametrize("kind", DEEP)
@pytest.mark.parametrize("levels", [DEEPEST + 1, 4000])
def test_what_is_too_deep_is_one_error_and_the_rest_is_understood(kind: str, levels: int) -> None:
    source = Source("", f"impl one of A {{\n{DEEP[kind](levels)}\nprefer 2\n}}\nimpl two of A {{ do wait 1 s }}\n")
    outcome = parse(source)
    assert {problem.name for problem in outcome.diagnostics} == {"nesting-too-deep"}
    assert [problem.span.line for problem in outcome.diagnostics] == [2]
    assert outcome.value.declarations[-1].name.text == "two"
    assert format_source(source).value == source.text


@pytest.mark.parametrize("kind", DEEP)
def test_what_is_as_deep_as_may_be_is_understood_and_formatted(kind: str) -> None:
    source = Source("", f"impl one of A {{\n{DEEP[kind](DEEPEST)}\n}}\n")
    assert parse(source).diagnostics == ()
    outcome = format_source(source)
    assert outcome.ok
    assert parse(Source("", outcome.value)).diagnostics == ()


def test_many_parts_side_by_side_are_not_deep() -> None:
    conditions, calls = " and ".join(["a == b"] * 500), "wait 1 s\n" * 500
    (declaration,) = parse(
        Source("", f"impl one of A {{\npre {conditions}\ndo seq {{ {calls} }}\n}}\n")
    ).value.declarations
    assert isinstance(declaration, s.ImplementationDeclaration)
    assert len(declaration.members) == 2


@pytest.mark.parametrize(
    "text", ["{\n", "}\n", "skill A {\n", "5 foo\n", "! \n", "a b c\n", "seq { ( } skill\n", '"a\n']
)
def test_garbage_has_a_bounded_number_of_errors(text: str) -> None:
    outcome = parse(Source("", text * 2000))
    assert not outcome.ok
    assert len(outcome.diagnostics) <= MOST_PROBLEMS + 1


def test_a_file_that_is_too_large_is_not_read() -> None:
    line = "class A < B\n"
    fits, too_large = (Source("", "# \n" + line + "#" * (MOST_CHARACTERS - len(line) - 3 + more)) for more in (0, 1))
    assert len(parse(fits).value.declarations) == 1
    assert [problem.name for problem in parse(too_large).diagnostics] == ["file-too-large"]
