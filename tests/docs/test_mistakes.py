"""The mistakes of docs/mistakes.md are reported as the page says, each as one error; its picture is what is shown."""

from __future__ import annotations

import pytest

from docs.mistakes_page import PAGE, PICTURE, SHOWN, Mistake, check_mistake, draw_picture, read_library, read_mistakes
from docs.pages import FENCE

TEXT = PAGE.read_text(encoding="utf-8")
LIBRARY = read_library(TEXT)
MISTAKES = list(read_mistakes(TEXT))


def test_the_library_has_no_problem() -> None:
    nothing = Mistake("packing.skill", LIBRARY["packing.skill"], LIBRARY["packing.skill"], "")
    assert check_mistake(LIBRARY, nothing).strip() == ""


@pytest.mark.parametrize("mistake", MISTAKES, ids=lambda each: each.new.strip()[:24])
def test_a_mistake_is_one_message_as_the_page_says(mistake: Mistake) -> None:
    assert check_mistake(LIBRARY, mistake) == mistake.printed
    lines = mistake.printed.splitlines()
    assert [line.partition("[")[0] for line in lines if line.startswith(("error[", "warning["))] == ["error"]


def test_the_page_has_ten_mistakes() -> None:
    assert len(MISTAKES) == FENCE.sub("", TEXT).count("\n## ") == 10


def test_the_picture_is_what_is_shown() -> None:
    assert PICTURE.read_text(encoding="utf-8") == draw_picture(LIBRARY, MISTAKES[SHOWN])
