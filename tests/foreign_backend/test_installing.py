"""What was found of installed back ends is kept until a package is installed or removed."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from skillc.services.project import backends


def install(site: Path, package: str, entries: str) -> Path:
    folder = site / f"{package}-1.0.dist-info"
    folder.mkdir()
    (folder / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {package}\nVersion: 1.0\n")
    (folder / "entry_points.txt").write_text(f"[skillc.backends]\n{entries}\n")
    return folder


def found() -> dict[str, str]:
    """Return the back ends that another process finds beside those of skillc, by name."""
    backends._find_on.cache_clear()
    return {each.name: each.value for each in backends.find_installed() if not each.value.startswith("skillc_")}


@pytest.fixture
def site(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("SKILLC_CACHE", str(tmp_path / "cache"))
    folder = tmp_path / "site"
    folder.mkdir()
    monkeypatch.syspath_prepend(folder)
    return folder


def test_what_was_found_is_read_from_the_cache(site: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    install(site, "cart", "cart = carts:make")
    assert found() == {"cart": "carts:make"}
    monkeypatch.setattr(backends, "entry_points", lambda **_: pytest.fail("packages are read again"))
    assert found() == {"cart": "carts:make"}
    assert backends.require_backend("cart") == "cart"


def test_a_package_that_is_installed_or_removed_later_counts(site: Path) -> None:
    assert found() == {}
    installed = install(site, "cart", "cart = carts:make")
    assert found() == {"cart": "carts:make"}
    install(site, "tram", "tram = trams:make")
    assert found() == {"cart": "carts:make", "tram": "trams:make"}
    shutil.rmtree(installed)
    assert found() == {"tram": "trams:make"}


def test_of_two_with_one_name_the_packages_are_told_again(site: Path) -> None:
    install(site, "cart", "cart = carts:make")
    install(site, "wagon", "cart = wagons:make")
    for _ in range(2):
        found()
        with pytest.raises(Exception, match="two backends `cart`, of cart and wagon"):
            backends.require_backend("cart")
