"""Stores folders of model collections in the user's cache; missing ones are fetched by Git, which verifies them.

Only the requested folders of a collection are fetched, at its commit, without history. A repository's address
can be changed as with any use of Git: `git config --global url.MIRROR.insteadOf ADDRESS`.
"""

from __future__ import annotations

import os
import subprocess
import tempfile
from pathlib import Path

from skillc_dsl.cache import VARIABLE, cache_folder
from skillc_runtime.film.looks import Collection, LooksError

SLOW_BYTES_S, SLOW_S = 1000, 30
"""A connection that is slower than this for this time is closed."""

GIT_LIMIT_S = 1800.0
"""How long one command of Git may take."""

CONFUSING = ("GIT_DIR", "GIT_WORK_TREE", "GIT_INDEX_FILE", "GIT_OBJECT_DIRECTORY", "GIT_COMMON_DIR")
"""Variables that make Git work on another repository, for example in a hook."""


def model_file(collection: Collection, path: str) -> Path:
    """Return a model's file, fetched with its folder if necessary; LooksError with instructions if that fails."""
    folder, _, rest = path.partition("/")
    kept = _place(collection) / folder
    if not kept.is_dir():
        _fetch(collection, folder, kept)
    if not (kept / rest).is_file():
        raise LooksError(f"there is no {rest} in {kept}; remove that folder to have it fetched again")
    return kept / rest


def _place(collection: Collection) -> Path:
    """Return the folder of a collection in the cache."""
    base = cache_folder()
    if base is None:
        raise LooksError(f"there is no home to keep {collection.name} in; name a folder in {VARIABLE}")
    return base / "looks" / collection.name / collection.commit


def _fetch(collection: Collection, folder: str, kept: Path) -> None:
    """Fetch a folder completely or not at all; other processes may do the same."""
    try:
        kept.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=kept.parent, prefix=".new-") as new:
            _check_out(collection, folder, new)
            if not Path(new, folder).is_dir():
                raise LooksError(f"{collection.name} has no folder {folder} at commit {collection.commit}")
            if not kept.is_dir():
                Path(new, folder).replace(kept)
    except FileNotFoundError as error:
        raise _fetch_error(collection, folder, kept, "git is not installed") from error
    except subprocess.TimeoutExpired as error:
        raise _fetch_error(collection, folder, kept, f"git did not end within {GIT_LIMIT_S:g} s") from error
    except subprocess.CalledProcessError as error:
        raise _fetch_error(collection, folder, kept, _git_error(error.stderr)) from error
    except OSError as error:
        raise LooksError(f"cannot write to {kept.parent}: {error.strerror or error}") from error


def _check_out(collection: Collection, folder: str, place: str) -> None:
    """Check out one folder of the collection; only its files are fetched."""
    _git(place, "init", "--quiet")
    _git(place, "remote", "add", "origin", collection.repository)
    _git(place, "fetch", "--quiet", "--depth", "1", "--filter", "blob:none", "origin", collection.commit)
    _git(place, "sparse-checkout", "set", "--no-cone", f"/{folder}/")
    _git(place, "checkout", "--quiet", collection.commit)


def _git(place: str, *words: str) -> None:
    patience = ("-c", f"http.lowSpeedLimit={SLOW_BYTES_S}", "-c", f"http.lowSpeedTime={SLOW_S}")
    environment = {name: value for name, value in os.environ.items() if name not in CONFUSING}
    subprocess.run(
        ["git", *patience, *words],
        cwd=place,
        env={**environment, "GIT_TERMINAL_PROMPT": "0", "LC_ALL": "C"},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        check=True,
        timeout=GIT_LIMIT_S,
    )


def _git_error(stderr: bytes) -> str:
    """Return the reason that Git gives: its last line that begins with `fatal`, else its last line."""
    lines = [line for line in stderr.decode(errors="replace").splitlines() if line.strip()]
    fatal = [line for line in lines if line.startswith("fatal: ")]
    return (fatal or lines or ["git failed"])[-1].removeprefix("fatal: ")


def _fetch_error(collection: Collection, folder: str, kept: Path, why: str) -> LooksError:
    return LooksError(
        f"the models of {collection.name} are not in the cache and cannot be fetched: {why}\n"
        f"by hand: put the folder {folder} of {collection.repository} at commit {collection.commit[:12]} "
        f"into {kept.parent}"
    )
