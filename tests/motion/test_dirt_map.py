"""A map of dirt is one text, and the rectangles with its dirty cells are what is wiped."""

from itertools import combinations

import numpy as np
import pytest

from skillc_runtime.motion.coverage import CoverageMap
from skillc_runtime.motion.dirt_map import (
    CLEAN,
    DIRTY,
    SPARED,
    UNSEEN,
    DirtMap,
    area,
    find_dirty_boxes,
    find_dirty_parts,
    format_dirt_map,
    parse_dirt_map,
)
from skillc_runtime.motion.layout import Hole, Layout
from skillc_runtime.motion.pose import Pose

SIZE = (0.3, 0.4)
LETTERS = {"u": UNSEEN, "c": CLEAN, "d": DIRTY, "s": SPARED}


def drawn(*rows: str) -> DirtMap:
    """Return a map of certain cells, drawn with the greatest y on top."""
    cells = "".join(reversed(rows))
    state = bytes(LETTERS[each] for each in cells)
    return DirtMap(len(rows[0]), len(rows), state, bytes(0 if each == "u" else 10 for each in cells))


def test_shares_count_what_is_to_be_worked_on_and_what_was_not_seen_is_not_clean() -> None:
    dirt = drawn("cccd", "uccs", "csss")
    assert (dirt.clean_share, dirt.dirty_share) == (6 / 8, 1 / 8)
    assert drawn("ss").clean_share == 1.0


@pytest.mark.parametrize("text", ["1x1 1c", "2x3 5c9 1d", "4x2 3u 2d0 2c 1s", "60x80 4700c 100d8"])
def test_a_map_is_read_as_it_was_written(text: str) -> None:
    assert format_dirt_map(parse_dirt_map(text)) == text


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ("", "is written as"),
        ("2x2 4x", "is written as"),
        ("0x2 1c", "is written as"),
        ("2x2 3c", "3 cells in place of 2 x 2"),
        ("2x2 5c", "more than 2 x 2"),
    ],
)
def test_what_is_no_map_is_refused(text: str, wrong: str) -> None:
    with pytest.raises(ValueError, match=wrong):
        parse_dirt_map(text)


def random_map(seed: int) -> DirtMap:
    rng = np.random.default_rng(seed)
    state = np.full((40, 30), CLEAN, dtype=np.uint8)
    for _ in range(int(rng.integers(1, 7))):
        row, column = int(rng.integers(0, 38)), int(rng.integers(0, 28))
        state[row : row + int(rng.integers(1, 9)), column : column + int(rng.integers(1, 9))] = DIRTY
    confidence = rng.integers(0, 11, state.shape).astype(np.uint8)
    return DirtMap(30, 40, state.tobytes(), confidence.tobytes())


@pytest.mark.parametrize("seed", range(20))
def test_rectangles_hold_all_that_is_dirty_stay_on_the_surface_and_are_joined_where_that_is_no_more(seed: int) -> None:
    dirt = random_map(seed)
    assert parse_dirt_map(format_dirt_map(dirt)) == dirt
    boxes = find_dirty_boxes(dirt, SIZE)
    for one, other in combinations(boxes, 2):
        both = (min(one[0], other[0]), min(one[1], other[1]), max(one[2], other[2]), max(one[3], other[3]))
        assert area(both) > area(one) + area(other)
    for x0, y0, x1, y1 in boxes:
        assert -0.15 - 1e-9 <= x0 < x1 <= 0.15 + 1e-9
        assert -0.2 - 1e-9 <= y0 < y1 <= 0.2 + 1e-9
        assert min(x1 - x0, y1 - y0) >= 0.12 - 1e-9
    x, y = np.linspace(-0.145, 0.145, 30), np.linspace(-0.195, 0.195, 40)
    inside = Layout(np.array(SIZE), find_dirty_parts(dirt, SIZE)).work_mask(x, y)
    assert inside[np.frombuffer(dirt.state, np.uint8).reshape(40, 30) == DIRTY].all()


def test_far_spots_are_wiped_apart_and_near_ones_together() -> None:
    far = drawn("d" + 28 * "c" + "d", *(38 * ["c" * 30]), "c" * 30)
    assert len(find_dirty_boxes(far, SIZE)) == 2
    near = drawn(*(20 * ["c" * 30]), "c" * 10 + "dccd" + "c" * 16, *(19 * ["c" * 30]))
    ((x0, _, x1, _),) = find_dirty_boxes(near, SIZE)
    assert x1 - x0 == pytest.approx(0.12)


def test_a_surface_is_dirty_where_its_map_says_so_until_it_is_wiped() -> None:
    layout = Layout(np.array(SIZE), holes=(Hole(np.array([0.1, 0.15]), np.array([0.1, 0.1])),))
    there = CoverageMap(Pose(np.zeros(3), np.eye(3)), layout, 1.0, parse_dirt_map("3x4 11c 1d"))
    assert there.wiped_share == 1.0, "the only dirty cell is in the hole"
    there = CoverageMap(Pose(np.zeros(3), np.eye(3)), Layout(np.array(SIZE)), 1.0, parse_dirt_map("3x4 2u 9c 1d"))
    assert there.wiped_share == pytest.approx(9 / 12), "what was not seen is taken for dirty"
    there.dose[there.y > 0.1] = 1.0
    assert there.wiped_share == pytest.approx(10 / 12)
    assert there.rubbed_share(0.0) == pytest.approx(3 / 12), "being clean is not being rubbed"
