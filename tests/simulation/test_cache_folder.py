"""The language and the runtime, which may not know each other, keep what they keep in the same folder."""

from pathlib import Path

import pytest

from skillc_dsl import cache
from skillc_dsl.cache import cache_folder

HERE = Path.cwd()


@pytest.mark.parametrize(
    ("environment", "folder"),
    [
        ({"SKILLC_CACHE": "/own", "XDG_CACHE_HOME": "/cache"}, Path("/own")),
        ({"SKILLC_CACHE": "own"}, HERE / "own"),
        ({"XDG_CACHE_HOME": "/cache"}, Path("/cache/skillc")),
        ({"SKILLC_CACHE": "", "XDG_CACHE_HOME": "", "HOME": "/home/me"}, Path("/home/me/.cache/skillc")),
        ({"XDG_CACHE_HOME": "cache"}, None),
    ],
    ids=["own", "relative", "user's", "home", "no place"],
)
def test_all_packages_keep_things_in_one_folder(
    environment: dict[str, str], folder: Path | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("SKILLC_CACHE", "XDG_CACHE_HOME"):
        monkeypatch.delenv(name, raising=False)
    for name, value in environment.items():
        monkeypatch.setenv(name, value)
    assert cache_folder.cache_folder() == cache.cache_folder() == folder


def test_without_a_home_nothing_is_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    def homeless() -> Path:
        raise RuntimeError("Could not determine home directory.")

    for name in ("SKILLC_CACHE", "XDG_CACHE_HOME"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(Path, "home", homeless)
    assert cache_folder.cache_folder() is None
    assert cache.cache_folder() is None
