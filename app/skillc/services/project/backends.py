"""The back ends in whose cells tasks can run: entry points of installed packages, each imported for its first cell."""

from __future__ import annotations

import os
import sys
from functools import cache
from hashlib import sha256
from importlib.metadata import EntryPoint, EntryPoints, entry_points
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

import msgspec

from skillc.errors import RequestError, ServiceError
from skillc.services.project.project import DEFAULT_BACKEND, SYMBOLIC
from skillc_dsl.cache import cache_folder, delete_oldest, load, store
from skillc_runtime.execution.pace import FAST, REAL

if TYPE_CHECKING:
    from skillc_model.skills import SkillLibrary
    from skillc_runtime.devices.backend import Backend, MakeBackend
    from skillc_runtime.world.state.model import WorldModel

GROUP = "skillc.backends"
"""The group of entry points with the functions that make cells, by the name of the back end."""

BackendName: TypeAlias = str
"""The name of a back end that is installed, or was where a cell or a recording comes from."""

_MOST = 50
"""The most entries in the cache; beyond it the older half is deleted."""

INSTALLED = (".dist-info", ".egg-info")
"""What the names of the folders that describe installed packages end with."""

SIMULATED = ("mujoco", "kinematic")
"""The back ends that are known to begin with all arms at home, unless the cell was saved."""


def find_installed() -> EntryPoints:
    """Return the entry points of all back ends that are installed."""
    return _find_on(tuple(filter(_may_have_packages, sys.path)))


def _may_have_packages(folder: str) -> bool:
    """Whether packages are installed in a folder on the path of modules, or in what is no folder.

    In that of a project are none, and it changes with each new file.
    """
    try:
        return folder.endswith(".egg") or any(name.endswith(INSTALLED) for name in os.listdir(folder or os.curdir))  # noqa: PTH208
    except NotADirectoryError:
        return True
    except OSError:
        return False


@cache
def _find_on(path: tuple[str, ...]) -> EntryPoints:
    """Look for the packages that have back ends on a path of modules, which reads a file of each package there.

    What was found is kept in the cache folder until something is installed or removed.
    """
    entry = _cache_entry(path)
    known = None if entry is None else load(entry)
    if known is not None:
        listed = msgspec.json.decode(known, type=list[tuple[str, str]])
        return EntryPoints(EntryPoint(name, value, GROUP) for name, value in listed)
    found = entry_points(group=GROUP)
    # If two packages offer one name, the refusal names both packages, which the cache does not keep.
    if entry is not None and len(found.names) == len(found):
        store(entry, msgspec.json.encode([(each.name, each.value) for each in found]))
        delete_oldest(entry.parent, _MOST, _MOST // 2)
    return found


def _cache_entry(path: tuple[str, ...]) -> Path | None:
    """Return where is kept what is found on a path of modules, whose folders change when packages are installed."""
    folder = cache_folder()
    if folder is None:
        return None
    seen = [(each, os.stat(each or os.curdir)) for each in path if os.path.exists(each or os.curdir)]  # noqa: PTH110, PTH116
    states = [(each, state.st_ino, state.st_mtime_ns) for each, state in seen]
    return folder / "backends" / sha256(repr((GROUP, states)).encode()).hexdigest()


def list_backends() -> tuple[str, ...]:
    """Return the names of all back ends that are installed, sorted."""
    return tuple(sorted(find_installed().names))


def require_backend(name: object) -> BackendName:
    """Return the name of a back end that is installed; RequestError for any other, with those that are."""
    if isinstance(name, str):
        return _find_entry(name).name
    raise RequestError(f"the backend is a name such as {DEFAULT_BACKEND!r}, not {name!r}")


def make_backend(
    name: BackendName, world: WorldModel, seed: int, saved: bytes | None = None, observed: bool = False
) -> Backend:
    """Return a cell of a back end; where it is simulated, reality differs from the facts as `seed` determines.

    All is as in the cell that was `saved`, if there was one. Devices that are only `observed` are not taken under
    control. RequestError if the back end is not installed, ServiceError if it cannot be used; SheetError or FrameError
    if facts are missing or contradict the models, CheckpointError if what was saved cannot be read.
    """
    from skillc_runtime.devices.backend import BackendStart, BackendUnavailable

    make = _load(_find_entry(name))
    try:
        cell = make(world, BackendStart(seed, saved, observed))
    except BackendUnavailable as error:
        raise ServiceError(f"the backend {name} cannot be used: {error}") from error
    if cell.capabilities.truth is None and not cell.capabilities.symbolic:
        world.forget_hidden()
    return cell


def adapt_library(library: SkillLibrary, backend: BackendName) -> SkillLibrary:
    """Return a library as cells of a back end run it."""
    if backend != SYMBOLIC:
        return library
    from skillc_model.declared import act_as_declared

    return act_as_declared(library)


def check_pace(backend: Backend, factor: float) -> None:
    """Raise RequestError if a cell cannot have a pace: one with a time of its own is neither slower nor faster."""
    if backend.capabilities.lock_step is None and factor not in (REAL, FAST):
        raise RequestError(f"the pace cannot be {factor:g}: the cell has a time of its own, that of the wall clock")


def _find_entry(name: str) -> EntryPoint:
    found = [each for each in find_installed() if each.name == name]
    if not found:
        there = ", ".join(list_backends()) or "none"
        how = f"install the package that has the entry point `{name}` of `{GROUP}`"
        raise RequestError(f"there is no backend `{name}`; there are: {there}. To use another one, {how}")
    if len({each.value for each in found}) > 1:
        owners = " and ".join(sorted(each.dist.name if each.dist is not None else each.value for each in found))
        raise RequestError(f"there are two backends `{name}`, of {owners}: uninstall one of the packages")
    return found[0]


def _load(entry: EntryPoint) -> MakeBackend:
    try:
        make: MakeBackend = entry.load()
    except (ImportError, AttributeError) as error:
        raise ServiceError(f"the backend {entry.name} ({entry.value}) cannot be imported: {error}") from error
    return make
