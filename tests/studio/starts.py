"""The starts of the studio and of servers that README, the documentation and `--help` print, and who follows them."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import groupby, product
from pathlib import Path

import click
from click.testing import CliRunner

from docs.pages import ROOT
from skillc.cli.main import skillc
from waiting import LONG_S

PROJECT, TEMPLATE = "my_project", "pick-place"
PORT = "8421"
"""The port that is printed; who follows the page takes one that is free."""
BLOCK = re.compile(r"^```[^\n]*\n(.*?)^```$", re.MULTILINE | re.DOTALL)
TYPED = re.compile(r"(?:^|[\s/])skillc +(studio|serve)\b(.*)")
INLINE = re.compile(r"`skillc\s+(studio|serve)\b([^`]*)`")
PLACES = {"OPTIONS": "", "LIBRARY": PROJECT, "TASK": "clean_whiteboard", "--cell SCENE..": "--cell cell.ttl"}
"""What somebody writes in the place of a word of a usage."""
SHOWN = {
    "clean_whiteboard": ("ur5e_whiteboard", "clean_whiteboard"),
    "sorting:sort_parts": ("panda", "sort_parts"),
    PROJECT: ("cell", ""),
}
"""The cell and the task that a library or a task asks for."""


@dataclass(frozen=True, order=True, slots=True)
class Start:
    """A command as it is printed, and `stand`: whether its reader is in the project, above it, or somewhere else."""

    command: str
    stand: str

    @property
    def words(self) -> list[str]:
        return shlex.split(self.command)

    @property
    def state(self) -> str:
        """The state folder of its server."""
        words = self.words
        return words[words.index("--state") + 1] if "--state" in words else ".skillc"

    @property
    def shown(self) -> tuple[str, str]:
        """The cell and the task that it asks for, empty for whatever there is."""
        cells = [Path(cell).stem for word, cell in zip(self.words, self.words[1:], strict=False) if word == "--cell"]
        cell, task = next((SHOWN[each] for each in self.words if each in SHOWN), ("", ""))
        return (cells[0] if cells else cell), task


def collect_starts() -> dict[Start, str]:
    """Return all starts that are printed, with the first place of each."""
    found = dict[Start, str]()
    for place, text in _read_texts():
        for command in _find_commands(text):
            found.setdefault(Start(command, _find_stand(command, place)), place)
    return found


def of_each_kind(starts: Iterable[Start]) -> Iterator[Start]:
    """Yield the longest start of each kind: those of one command that are typed at one place and show the same."""

    def kind(start: Start) -> tuple[str, str, tuple[str, str]]:
        return start.words[0], start.stand, start.shown

    for _, alike in groupby(sorted(starts, key=kind), kind):
        yield max(alike, key=lambda start: len(start.words))


def _read_texts() -> Iterator[tuple[str, str]]:
    """Yield the name and the text of each page, and of the help of each command."""
    for page in (ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))):
        yield page.relative_to(ROOT).as_posix(), page.read_text(encoding="utf-8")
    for name in skillc.list_commands(click.Context(skillc)):
        yield f"skillc {name} --help", CliRunner().invoke(skillc, [name, "--help"]).output


def _find_commands(text: str) -> Iterator[str]:
    """Yield the commands in the blocks of a page or the lines of a help, and those in its sentences."""
    joined = re.sub(r"\\\n\s*", "", text)
    blocks = BLOCK.findall(joined) or [joined]
    typed = [found for block in blocks for line in block.splitlines() if (found := TYPED.search(line))]
    for found in (*typed, *INLINE.finditer(BLOCK.sub("", joined))):
        rest = found[2].partition(" #")[0].rstrip(" &")
        for given in _expand(rest) if "[" in rest else (rest,):
            command = f"{found[1]} {given}".replace(f" --bind 127.0.0.1:{PORT}", "")
            yield " ".join(command.split())


def _expand(usage: str) -> Iterator[str]:
    """Yield what a usage stands for: all left out, and all given, with each alternative."""
    yield ""
    choices = [each.split("|") for each in re.findall(r"\[([^\]]+)\]", usage)]
    for chosen in product(*choices):
        yield " ".join(PLACES[each] for each in chosen)


def _find_stand(command: str, place: str) -> str:
    if PROJECT in command:
        return "above"
    named = any(each in command for each in (*SHOWN, "wiping"))
    return "elsewhere" if named or (command, place) == ("studio", "README.md") else "project"


def write_stands(root: Path) -> dict[str, Path]:
    """Write what the readers have: a project, and a certificate; return the folders in which they stand."""
    import trustme

    stands = {"above": root, "project": root / PROJECT, "elsewhere": root / "elsewhere"}
    made = CliRunner().invoke(skillc, ["new", str(stands["project"]), "--template", TEMPLATE, "--quiet"])
    assert made.exit_code == 0, made.output
    tls = root / "etc/skillc/tls"
    for folder in (stands["elsewhere"], tls, root / "var/lib/skillc", root / "var/log/skillc"):
        folder.mkdir(parents=True)
    certificate = trustme.CA().issue_cert("127.0.0.1", "cells.example.org")
    certificate.cert_chain_pems[0].write_to_path(str(tls / "chain.pem"))
    certificate.private_key_pem.write_to_path(str(tls / "key.pem"))
    for name in ("chain.pem", "key.pem"):
        shutil.copy(tls / name, stands["project"])
    return stands


@dataclass(frozen=True, slots=True)
class Followed:
    """A start that was typed: its `state` folder, and the files with what it has opened in a browser and printed."""

    state: Path
    opened: Path
    printed: Path

    def find_address(self) -> str:
        """Return the address that it has opened, or printed; empty while there is none."""
        files = [each for each in (self.opened, self.printed) if each.exists()]
        lines = [line for each in files for line in each.read_text(encoding="utf-8").splitlines() if "/#code=" in line]
        return lines[0] if lines else ""


@contextmanager
def followed(start: Start, stands: dict[str, Path], port: int) -> Iterator[Followed]:
    """Type a command as it is printed, but with a port that is free, and absolute paths below ours; end it then."""
    root, stand = stands["above"], stands[start.stand]
    command = re.sub(r"(?<= )/(?=\w)", f"{root}/", start.command).replace(PORT, str(port))
    if start.command.startswith("serve") and "--bind" not in command:
        command += f" --bind 127.0.0.1:{port}"
    typed = Start(command, start.stand)
    found = Followed(stand / typed.state, root / f"opened-{port}", root / f"printed-{port}")
    browser = root / "browser"
    browser.write_text('#!/bin/sh\necho "$2" > "$1.part" && mv "$1.part" "$1"\n', encoding="utf-8")
    browser.chmod(0o755)
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    environment["BROWSER"] = f"{browser} {found.opened} %s"
    words = (sys.executable, "-m", "skillc", *typed.words)
    with found.printed.open("w", encoding="utf-8") as printed:
        process = subprocess.Popen(words, cwd=stand, env=environment, stdout=printed, stderr=subprocess.STDOUT)
        try:
            yield found
        finally:
            if process.poll() is None:
                process.send_signal(signal.SIGTERM)
            process.wait(LONG_S)
    assert process.returncode == 0, found.printed.read_text(encoding="utf-8")
