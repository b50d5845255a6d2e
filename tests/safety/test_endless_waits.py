"""No wait in the product is endless: each has a time limit, or a comment that says what else ends it."""

from __future__ import annotations

from pathlib import Path

import pytest

from safety.endless_waits import find_endless_waits, find_unneeded_marks

ROOT = Path(__file__).parents[2]
FILES = sorted(
    file
    for folder in ("dsl", "ontology", "compiler", "runtime", "app", "skills_src")
    for file in (ROOT / folder).rglob("*.py")
)

WAITS = [
    ("thread.join()", "thread.join(5.0)"),
    ("process.wait()", "process.wait(timeout=5.0)"),
    ("process.communicate()", "process.communicate(timeout=5.0)"),
    ("process.communicate(b'text')", "process.communicate(b'text', 5.0)"),
    ("lock.acquire()", "lock.acquire(timeout=5.0)"),
    ("lock.acquire()", "lock.acquire(blocking=False)"),
    ("with self._lock: pass", "with self._locked(): pass"),
    ("with Lock(): pass", "with store.locked(fcntl.LOCK_SH): pass"),
    ("import queue\nrequests.get()", "import queue\nrequests.get(timeout=5.0)"),
    ("from queue import Queue\nrequests.get()", "from contextvars import ContextVar\nfolders.get()"),
    ("from queue import Queue\nrequests.put(3)", "from queue import Queue\nrequests.put_nowait(3)"),
    ("from concurrent.futures import Future\nfuture.result()", "attempt.result()"),
    ("connection.recv()", "poller.poll(5.0)"),
    ("import select\npoller.poll()", "import select\nprocess.poll()"),
    ("server.accept()", "server.settimeout(5.0)"),
    ("select.select(readers, (), ())", "select.select(readers, (), (), 5.0)"),
    ("os.waitpid(pid, 0)", "os.waitpid(pid, os.WNOHANG)"),
    ("fcntl.flock(file, fcntl.LOCK_EX)", "fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)"),
    ("subprocess.run(command)", "subprocess.run(command, timeout=5.0)"),
    ("urlopen(address)", "urlopen(address, timeout=5.0)"),
    ("http.client.HTTPConnection(host)", "http.client.HTTPConnection(host, timeout=5.0)"),
    ("signal.pause()", "tree.pause()"),
    ("sys.stdin.read()", "file.read()"),
    ("input('name? ')", "console.input(prompt)"),
    ("while not ready():\n    time.sleep(0.1)", "while not ready() and cancel.reason is None:\n    time.sleep(0.1)"),
    ("while True:\n    time.sleep(0.1)", "for _ in range(10):\n    time.sleep(0.1)"),
    ("async def serve():\n    await ready.wait()", "async def serve():\n    await wait_for(ready, 5.0)"),
    ("from watchfiles import watch\nwatch(folder)", "watch(folder)"),
    ("thread.join()  # wait ends: soon", "thread.join()  # wait ends: with the process that it belongs to"),
    ("file.read()\n# wait ends: with the process\n\nthread.join()", "# wait ends: with the process\nthread.join()"),
]


@pytest.mark.parametrize(("endless", "limited"), WAITS)
def test_an_endless_wait_is_found_and_a_limited_one_is_not(endless: str, limited: str) -> None:
    assert len(find_endless_waits(endless)) == 1
    assert find_endless_waits(limited) == []


def test_a_comment_that_explains_no_wait_is_found() -> None:
    assert find_unneeded_marks("# wait ends: with the process\nfile.read()") == [1]
    assert find_unneeded_marks("# wait ends: with the process\nthread.join()") == []


@pytest.mark.slow
def test_no_wait_in_the_product_is_endless() -> None:
    assert len(FILES) > 500
    found = {file: find_endless_waits(file.read_text("utf-8")) for file in FILES}
    assert [f"{file.relative_to(ROOT)}:{line}: {text}" for file in found for line, text in found[file]] == []


def test_every_explanation_belongs_to_a_wait() -> None:
    explained = [file for file in FILES if "# wait ends" in file.read_text("utf-8")]
    assert len(explained) > 10
    assert [(file, lines) for file in explained if (lines := find_unneeded_marks(file.read_text("utf-8")))] == []
