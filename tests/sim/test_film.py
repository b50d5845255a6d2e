"""The film of a run has its size and rate, and says how the run ended; its loop is below its limit."""

from __future__ import annotations

from pathlib import Path

import av
import pytest
from click.testing import CliRunner
from PIL import Image

from skillc.cli.main import skillc
from skillc_runtime.film.captions import ENDINGS, STRIP_PIXELS
from skillc_runtime.film.picture_files import LOOP_BYTES
from skillc_runtime.film.rendering import RenderingError, check_rendering

WORDS = ("run", "--scene", "panda_desk", "--call", "TakePosture(arm: lab:Panda-1)", "--backend", "kinematic", "--gif")


@pytest.mark.sim
def test_a_film_and_its_loop_can_be_read_back(tmp_path: Path) -> None:
    try:
        check_rendering()
    except RenderingError as error:
        pytest.skip(str(error))
    result = CliRunner().invoke(skillc, [*WORDS, "--out", str(tmp_path)])
    assert result.exit_code in (0, 3), result.output
    with av.open(str(tmp_path / "film.mp4")) as film:
        assert film.streams.video[0].average_rate == 25
        pictures = [frame.to_ndarray(format="rgb24") for frame in film.decode(video=0)]
    assert {each.shape for each in pictures} == {(540, 960, 3)}
    last = pictures[-1][-STRIP_PIXELS * 3 // 4 :]
    assert last[:, :300].max() > 200, "how the run ended is written at the left"
    background = last[3:9, 450:525].reshape(-1, 3).mean(axis=0)
    assert any(background == pytest.approx(colour, abs=12) for colour in ENDINGS.values())
    assert (tmp_path / "film.gif").stat().st_size <= LOOP_BYTES
    with Image.open(tmp_path / "film.gif") as loop:
        assert loop.n_frames > 1


def test_a_loop_needs_a_folder() -> None:
    result = CliRunner().invoke(skillc, WORDS)
    assert result.exit_code == 2
    assert "--gif writes a film, which requires --out" in result.stderr
