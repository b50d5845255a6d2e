"""The fenced blocks of the documentation, and what it takes to do what a page says."""

from __future__ import annotations

import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest
from click.testing import CliRunner

from docs.installing import install, use
from skillc.cli.main import skillc

ROOT = Path(__file__).parents[2]
NO_NOTICE_S = 3600.0
FENCE = re.compile(r"^```(\w+)(?: ([^\n]+))?\n(.*?)^```$", re.MULTILINE | re.DOTALL)


@dataclass(frozen=True, slots=True)
class Block:
    """A fenced block: its language, the words after it, its text."""

    language: str
    words: str
    text: str


def blocks(page: Path) -> Iterator[Block]:
    """Yield the blocks of a page in their order."""
    for found in FENCE.finditer(page.read_text(encoding="utf-8")):
        yield Block(found[1], found[2] or "", found[3])


class Reader:
    """Someone who follows a page: writes its files, makes its changes, types its commands, compares what is printed.

    `sh` is typed and ends with the exit code of `exit=N`, else 0; `text` is found in what the last commands printed,
    line by line; `diff FILE` changes a file; `python run` is executed; any other language with a word after it is a
    file of that name. `console` blocks are not followed. Films are not made: they take most of the time, and other
    tests make them.
    """

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.monkeypatch = monkeypatch
        # Pages show what is printed on a machine that is quick enough to need no notice that it goes on.
        monkeypatch.setattr("skillc.cli.progress.slow_notice.FIRST_AFTER_S", NO_NOTICE_S)
        self.printed = ""
        self.done = 0

    def follow(self, page: Path) -> None:
        for block in blocks(page):
            match block.language:
                case "console":
                    pass
                case "sh":
                    self.type(block)
                case "text":
                    self.compare(block.text)
                case "diff":
                    self.change(Path(block.words), block.text)
                case "python" if block.words == "run":
                    exec(compile(block.text, "page", "exec"), {})
                case _ if block.words:
                    Path(block.words).write_text(block.text, encoding="utf-8")
                case _:
                    pass

    def type(self, block: Block) -> None:
        printed = []
        expected = int(block.words.removeprefix("exit=") or 0)
        for line in block.text.splitlines():
            output, code = self.call(shlex.split(line))
            assert code == expected, f"{line}\n{output}"
            printed.append(output)
            self.done += 1
        self.printed = "\n".join(printed)

    def call(self, words: list[str]) -> tuple[str, int]:
        match words:
            case ["cd", folder]:
                self.monkeypatch.chdir(folder)
                return "", 0
            case ["pip", "install", "."]:
                site = Path("site-packages").absolute()
                install(Path(), site)
                use(site, self.monkeypatch)
                return "", 0
            case ["skillc", *arguments]:
                if arguments[0] == "report" or (arguments[0] == "run" and "--out" in arguments):
                    arguments.append("--no-film")
                result = CliRunner().invoke(skillc, arguments)
                return result.output, result.exit_code
            case ["pytest", *arguments]:
                return self.call(["python", "-m", "pytest", "-q", "-p", "no:cacheprovider", *arguments])
            case ["python", *arguments]:
                ran = subprocess.run([sys.executable, *arguments], capture_output=True, text=True, check=False)
                return ran.stdout + ran.stderr, ran.returncode
            case _:
                raise ValueError(f"no reader types {words}")

    def compare(self, expected: str) -> None:
        place = 0
        for line in expected.splitlines():
            place = self.printed.find(line.strip(), place)
            assert place >= 0, f"not printed: {line}\n{self.printed}"

    def change(self, file: Path, difference: str) -> None:
        lines = difference.splitlines(keepends=True)
        old = "".join(line[1:] for line in lines if line[0] in " -")
        new = "".join(line[1:] for line in lines if line[0] in " +")
        text = file.read_text(encoding="utf-8")
        assert text.count(old) == 1, f"{file} has these lines {text.count(old)} times:\n{old}"
        file.write_text(text.replace(old, new), encoding="utf-8")
