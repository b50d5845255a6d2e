"""The server in a container, as the page for administrators shows it: what it names is in the image, and it works."""

from __future__ import annotations

import os
import re
import shlex
import signal
import socket
import subprocess
import sys
import time
from itertools import pairwise
from pathlib import Path

import pytest
import trustme

from docs.pages import ROOT, blocks
from running_cells.yard import write_yard

PAGE = ROOT / "docs/server-administration.md"
IMAGE = (ROOT / "Dockerfile").read_text("utf-8")
COMMAND = next(each.text for each in blocks(PAGE) if each.text.startswith("docker run"))
WORDS = shlex.split(COMMAND.replace("\\\n", " "))
SERVER = WORDS[WORDS.index("skillc", WORDS.index("--health-start-period")) + 1 :]


def find_options(name: str) -> list[str]:
    """Return the values of an option of the command."""
    return [value for option, value in pairwise(WORDS) if option == name]


def test_what_the_command_names_is_in_the_image() -> None:
    (user,), (port,) = find_options("--user"), find_options("--publish")
    state = find_options("--volume")[0].partition(":")[2]
    assert re.search(rf"useradd .*\b{user} && install .*--owner {user} .*{state}\n", IMAGE)
    assert f"\nEXPOSE {port.partition(':')[2]}\n" in IMAGE and find_options("--bind") == [f"0.0.0.0:{port[:4]}"]
    assert '\nENTRYPOINT ["skillc"]\n' in IMAGE and "\nWORKDIR /work\n" in IMAGE
    assert find_options("--state") == [state]


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="the image has Linux")
def test_its_server_becomes_healthy_and_ends_in_time(tmp_path: Path) -> None:
    folders = {each.split(":")[1]: tmp_path / str(number) for number, each in enumerate(find_options("--volume"))}
    for each in folders.values():
        each.mkdir()
    write_yard(folders["/work"], 100)
    (folders["/work"] / "yard.ttl").rename(folders["/work"] / "cell.ttl")
    certificate = trustme.CA().issue_cert("cells.example.org")
    certificate.cert_chain_pems[0].write_to_path(str(folders["/etc/skillc/tls"] / "chain.pem"))
    certificate.private_key_pem.write_to_path(str(folders["/etc/skillc/tls"] / "key.pem"))
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = str(free.getsockname()[1])

    def place(word: str) -> str:
        for inside, outside in folders.items():
            word = word.replace(inside, str(outside))
        return word.replace("0.0.0.0:8421", f"0.0.0.0:{port}")

    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    command = (sys.executable, "-m", "skillc", *map(place, SERVER))
    server = subprocess.Popen(command, cwd=folders["/work"], env=environment)
    try:
        health = shlex.split(find_options("--health-cmd")[0].replace("8421", port))
        assert health[0] == "python"
        end = time.monotonic() + 60.0
        while subprocess.run((sys.executable, *health[1:]), capture_output=True, check=False).returncode != 0:
            assert server.poll() is None and time.monotonic() < end
            time.sleep(0.2)
        assert (folders["/var/lib/skillc"] / "admin.token").is_file()
    finally:
        server.send_signal(signal.SIGTERM)
        code = server.wait(float(find_options("--stop-timeout")[0]))
    assert code == 0
