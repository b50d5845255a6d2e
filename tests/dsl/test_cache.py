"""The cache folder is where the environment says, else below the home of the user."""

from pathlib import Path

import pytest

from skillc_dsl import cache

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
def test_the_environment_names_the_cache_folder(
    environment: dict[str, str], folder: Path | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("SKILLC_CACHE", "XDG_CACHE_HOME"):
        monkeypatch.delenv(name, raising=False)
    for name, value in environment.items():
        monkeypatch.setenv(name, value)
    assert cache.cache_folder() == folder


def test_without_a_home_nothing_is_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    def homeless() -> Path:
        raise RuntimeError("Could not determine home directory.")

    for name in ("SKILLC_CACHE", "XDG_CACHE_HOME"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(Path, "home", homeless)
    assert cache.cache_folder() is None
