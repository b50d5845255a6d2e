"""Scenes for which there is too little memory are refused before the machine swaps."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from skillc_runtime.scene import memory as room
from skillc_runtime.scene import table
from skillc_runtime.scene.documents import SceneError
from skillc_runtime.scene.load import load_scene, read_scene
from world.lab import NS, VOCABULARY

MEGABYTE = 1_000_000
HEAD = f"@prefix t: <{NS}> . @prefix : <x:y#> .\n:table a t:Location .\n"


def scene(folder: Path, size: int) -> Path:
    """Write a sound scene of about so many bytes."""
    path, line = folder / "scene.ttl", ":box-{0} a t:Product ; t:weight 1.5 . :table t:contain :box-{0} .\n"
    path.write_text(HEAD + "".join(map(line.format, range(size // len(line)))), "utf-8")
    return path


def test_a_file_too_large_for_the_memory_is_not_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = scene(tmp_path, MEGABYTE)
    monkeypatch.setattr(room, "available_bytes", lambda: 10 * MEGABYTE)
    with pytest.raises(SceneError) as caught:
        load_scene(path, VOCABULARY)
    (problem,) = caught.value.problems
    assert problem.name == "unreadable-scene"
    assert "it takes about 0.021 GB of memory, and 0.01 GB are free" in problem.message


def test_a_scene_that_turns_out_to_be_too_large_is_given_up(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    left = iter((90 * MEGABYTE, 80 * MEGABYTE, 30 * MEGABYTE))
    monkeypatch.setattr(room, "available_bytes", lambda: next(left))
    monkeypatch.setattr(table, "AT_ONCE", 100)
    with pytest.raises(SceneError, match=r"a part of it took 0\.05 GB of memory, and 0\.03 GB are free"):
        load_scene(scene(tmp_path, MEGABYTE // 100), VOCABULARY)


def test_mistakes_that_take_too_much_memory_to_find_are_said_to_be_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = scene(tmp_path, MEGABYTE)
    path.write_text(path.read_text("utf-8") + ":box-1 t:wieght 3 .\n", "utf-8")
    monkeypatch.setattr(room, "available_bytes", lambda: 50 * MEGABYTE)
    for reading in (load_scene, read_scene):
        with pytest.raises(SceneError, match="it may contain errors, but there is too little memory"):
            reading(path, VOCABULARY)


@pytest.mark.skipif(sys.platform != "linux", reason="memory is limited and told by Linux")
def test_a_process_with_a_limit_says_so_and_ends(tmp_path: Path) -> None:
    text = f"""
import resource, sys
from pathlib import Path
from skillc_runtime.scene.documents import SceneError
from skillc_runtime.scene import memory as room
from skillc_runtime.scene.load import load_scene
from world.lab import VOCABULARY
used = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (used + {20 * MEGABYTE}, resource.RLIM_INFINITY))
try:
    load_scene(Path(sys.argv[1]), VOCABULARY)
except SceneError as error:
    print(error)
"""
    tests = str(Path(__file__).parents[1])
    command = [
        sys.executable,
        "-c",
        f"import sys; sys.path.insert(0, {tests!r})\n{text}",
        str(scene(tmp_path, 2 * MEGABYTE)),
    ]
    ran = subprocess.run(command, capture_output=True, text=True, check=True)
    assert "cannot read" in ran.stdout and "GB of memory" in ran.stdout


def test_what_is_available_is_told_here() -> None:
    left = room.available_bytes()
    assert sys.platform != "linux" or (left is not None and left > MEGABYTE)
