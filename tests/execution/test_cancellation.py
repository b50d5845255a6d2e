"""A token ends all work that was given a part of it."""

import pickle
from math import inf

import pytest

from skillc_runtime.cancellation import Cancelled, CancelToken


def test_work_may_go_on_until_it_is_cancelled() -> None:
    token = CancelToken()
    token.check()
    assert token.reason is None and token.remaining_s == inf
    token.cancel("the operator stopped it")
    token.cancel("and somebody else")
    assert token.reason == token.cancelled_because == "the operator stopped it" and token.remaining_s == 0.0
    with pytest.raises(Cancelled, match="the operator stopped it"):
        token.check()


def test_after_its_deadline_work_is_out_of_time_and_not_cancelled() -> None:
    token = CancelToken(0.0)
    assert token.reason == "it ran out of time" and token.cancelled_because is None and token.remaining_s == 0.0
    with pytest.raises(Cancelled, match="it ran out of time"):
        token.check()


def test_a_part_ends_with_the_whole_and_the_whole_not_with_the_part() -> None:
    whole = CancelToken(1000.0)
    part, short = whole.limited(inf), whole.share(0.0)
    assert part.remaining_s <= 1000.0 and short.reason is not None and part.limited(2000.0).remaining_s <= 1000.0
    part.share(0.5).cancel("only this")
    assert whole.reason is None and part.reason is None
    whole.cancel("all")
    assert part.reason == part.limited(1.0).reason == "all"


def test_a_copy_in_another_process_keeps_deadline_and_reason() -> None:
    token = CancelToken(1000.0)
    copy = pickle.loads(pickle.dumps(token.limited(inf)))
    assert 0.0 < copy.remaining_s <= 1000.0
    token.cancel("here")
    assert copy.reason is None and pickle.loads(pickle.dumps(token)).reason == "here"
