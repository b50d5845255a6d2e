"""`skillc check --watch` as a process: it notices changes, survives what is broken and ends with Ctrl-C."""

import queue
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest

from waiting import LONG_S

SOUND = "use skiros\nclass Board < Product\n"


class Watcher:
    """A running `skillc check --watch`, of whose two streams the lines come one by one."""

    def __init__(self, folder: Path) -> None:
        arguments = ["check", "--watch", "--format", "concise", str(folder)]
        main = "import sys; from skillc.cli.main import main; sys.exit(main())"
        self.process = subprocess.Popen(
            [sys.executable, "-u", "-c", main, *arguments],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        )
        self._lines: queue.Queue[str] = queue.Queue()
        threading.Thread(target=self._read, daemon=True).start()

    def until(self, words: str) -> list[str]:
        """Return the lines up to one that holds these words."""
        lines = [self._lines.get(timeout=LONG_S)]
        while words not in lines[-1]:
            lines.append(self._lines.get(timeout=LONG_S))
        return lines

    def _read(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self._lines.put(line)


@pytest.fixture
def library(tmp_path: Path) -> Path:
    folder = tmp_path / "lab"
    folder.mkdir()
    (folder / "a.skill").write_text(SOUND, encoding="utf-8")
    return folder


@pytest.fixture
def watcher(library: Path) -> Iterator[Watcher]:
    running = Watcher(library)
    yield running
    running.process.kill()
    running.process.wait()


@pytest.mark.slow
def test_changes_are_told_and_ctrl_c_ends_with_0(watcher: Watcher, library: Path) -> None:
    assert any("no problems" in line for line in watcher.until("waiting"))
    (library / "a.skill").write_text("class Board < Nothing\n", encoding="utf-8")
    assert any("error[unknown-class]" in line for line in watcher.until("waiting"))
    (library / "a.skill").unlink()
    assert any("there is no .skill file" in line for line in watcher.until("waiting"))
    (library / "b.skill").write_text(SOUND, encoding="utf-8")
    assert any("no problems" in line for line in watcher.until("waiting"))
    watcher.process.send_signal(signal.SIGINT)
    assert watcher.process.wait(LONG_S) == 0


@pytest.mark.slow
def test_a_folder_that_goes_and_comes_back_is_watched_on(watcher: Watcher, library: Path) -> None:
    watcher.until("waiting")
    library.rename(library.parent / "elsewhere")
    watcher.until("the files were removed")
    library.mkdir()
    (library / "a.skill").write_text("class Board < Nothing\n", encoding="utf-8")
    assert watcher.until("error[unknown-class]")


def test_a_path_that_does_not_exist_is_refused() -> None:
    main = "import sys; from skillc.cli.main import main; sys.exit(main())"
    ended = subprocess.run(
        [sys.executable, "-c", main, "check", "--watch", "nowhere"], capture_output=True, text=True, timeout=LONG_S
    )
    assert ended.returncode == 2
    assert "there is no file or folder nowhere" in ended.stderr
