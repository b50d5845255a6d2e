"""The memo of queries: answers are those of a computation from nothing, and nothing is computed twice."""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Iterable

import pytest

from skillc_dsl.query import KEPT, Memo, QueryCycle


class Sheet:
    """A sheet whose cells are numbers or sums of other cells; `computed` counts how often each was added up."""

    def __init__(self, memo: Memo) -> None:
        self.memo, self.computed = memo, Counter[str]()
        self.numbers: dict[str, int] = {}
        self.sums: dict[str, tuple[str, ...]] = {}

    def value(self, cell: str) -> int:
        """Return the value of a cell as it is now."""
        self.memo.begin()
        self._numbers, self._sums = (self.memo.table(n, t) for n, t in (("numbers", self.numbers), ("sums", self.sums)))
        return self._value(cell)

    def _value(self, cell: str) -> int:
        return self.memo.ask("value", (), lambda: self._add(cell), name=cell)

    def _add(self, cell: str) -> int:
        self.computed[cell] += 1
        parts = self._sums.get(cell)
        return (self._numbers.get(cell) or 0) if parts is None else sum(map(self._value, parts))


@pytest.mark.parametrize("seed", range(30))
def test_after_any_edits_an_answer_is_that_of_a_computation_from_nothing(seed: int) -> None:
    chance, sheet = random.Random(seed), Sheet(Memo())
    for number in range(60):
        cell = chance.randrange(8)
        sheet.numbers, sheet.sums = dict(sheet.numbers), dict(sheet.sums)
        if chance.random() < 0.5:
            sheet.numbers[f"c{cell}"] = chance.randrange(3)
        elif chance.random() < 0.3:
            sheet.sums.pop(f"c{cell}", None)
        else:
            sheet.sums[f"c{cell}"] = tuple(f"c{chance.randrange(cell + 1, 10)}" for _ in range(chance.randrange(3)))
        fresh = Sheet(Memo())
        fresh.numbers, fresh.sums = sheet.numbers, sheet.sums
        assert sheet.value("c0") == fresh.value("c0"), number


def test_only_what_reads_something_that_changed_is_computed_again() -> None:
    sheet = Sheet(Memo())
    sheet.numbers, sheet.sums = {"a": 1, "b": 2}, {"all": ("x", "y"), "x": ("a",), "y": ("b",)}
    assert sheet.value("all") == 3
    sheet.numbers = {"a": 1, "b": 5}
    sheet.computed.clear()
    assert sheet.value("all") == 6
    assert sheet.computed == {"all": 1, "y": 1, "b": 1}


def test_what_reads_an_answer_that_is_the_same_again_is_not_computed_again() -> None:
    memo, asked = Memo(), list[str]()

    def length(text: str) -> int:
        words = memo.same("words", "text", tuple(text.split()))
        return memo.ask("length", (words,), lambda: asked.append(text) or len(words))

    assert [length(each) for each in ("a b", "a  b", "a", "a b ")] == [2, 2, 1, 2]
    assert asked == ["a b", "a"]


def test_a_query_that_asks_for_its_own_answer_is_refused() -> None:
    sheet = Sheet(Memo())
    sheet.sums = {"a": ("b",), "b": ("a",)}
    with pytest.raises(QueryCycle, match="own answer"):
        sheet.value("a")
    sheet.sums = {"a": ("b",)}
    assert sheet.value("a") == 0


def test_a_cancelled_query_leaves_nothing_behind() -> None:
    memo, answers = Memo(), [KeyboardInterrupt, 7]

    def answer() -> int:
        found = answers.pop(0)
        if isinstance(found, int):
            return found
        raise found

    with pytest.raises(KeyboardInterrupt):
        memo.ask("outer", (), lambda: memo.ask("inner", (), answer))
    assert memo.ask("outer", (), lambda: memo.ask("inner", (), answer)) == 7
    assert memo.ask("inner", (), answer) == 7


def test_answers_that_are_not_asked_for_are_forgotten_but_not_while_nobody_asks_the_query() -> None:
    memo, computed = Memo(), list[str]()

    def ask(query: str, name: str) -> None:
        memo.ask(query, (), lambda: computed.append(name), name=name)

    ask("one", "a")
    ask("other", "b")
    for _ in range(3 * KEPT):
        memo.begin()
        ask("one", "c")
    ask("one", "a")
    ask("other", "b")
    assert computed == ["a", "b", "c", "a"]


class Shelf:
    """A store in memory."""

    def __init__(self) -> None:
        self.kept: dict[tuple[str, tuple[str | bytes, ...]], object] = {}

    def load(self, query: str, inputs: Iterable[str | bytes]) -> object | None:
        return self.kept.get((query, tuple(inputs)))

    def save(self, query: str, inputs: Iterable[str | bytes], answer: object) -> None:
        self.kept[query, tuple(inputs)] = answer


def test_a_stored_answer_is_that_of_an_earlier_process() -> None:
    shelf = Shelf()

    def length(memo: Memo, text: str) -> int:
        return memo.ask("length", (), lambda: len(text), name=text, saved=lambda: (text,))

    assert (length(Memo(shelf), "abc"), length(Memo(shelf), "ab")) == (3, 2)
    shelf.kept["length", ("abc",)] = 30
    assert [length(Memo(shelf), "abc"), length(Memo(shelf), "ab"), length(Memo(), "abc")] == [30, 2, 3]
