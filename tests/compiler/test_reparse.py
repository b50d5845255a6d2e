"""A file that was parsed before gives the same tree and problems after an edit as one that is parsed from nothing."""

import os
import random

import pytest
from edit_sequences import beginnings
from single_edits import apply_edits, single_edit

from skillc_dsl.parsing import reparse
from skillc_dsl.parsing.parser import parse
from skillc_dsl.parsing.reparse import parse_with
from skillc_dsl.query import Memo
from skillc_dsl.source import Source

EDITED = int(os.environ.get("EDITS", "60"))


@pytest.mark.slow
@pytest.mark.parametrize("number", range(len(beginnings())))
def test_edits_are_parsed_as_from_nothing(number: int, monkeypatch: pytest.MonkeyPatch) -> None:
    memo, chance, whole = Memo(), random.Random(number), []
    monkeypatch.setattr(reparse, "parse", lambda source: whole.append(source.text) or parse(source))
    text = "".join(source.text for source in sorted(beginnings()[number].values(), key=lambda each: each.path)[-3:])
    text = "\n".join(line for line in text.split("\n") if not line.startswith(("use ", "import ", "prefix ")))
    edited, spared = text, 0
    for _ in range(EDITED):
        edited = apply_edits(chance.choice([text, text, edited]), [single_edit(text, chance.randrange(10**6))])
        before = len(whole)
        assert parse_with(memo, Source("a.skill", edited)) == parse(Source("a.skill", edited))
        spared += all(len(each.strip()) < len(edited.strip()) for each in whole[before:])
    assert spared > EDITED // 3
