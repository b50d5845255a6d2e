"""A cell says that its loop goes round, whatever else it has to say."""

from __future__ import annotations

import socket
import time

from skillc.cells.frames import FrameReader
from skillc.cells.mailbox import ALIVE_S, Outbox
from skillc.cells.messages import Alive, CellAnswer, Report


def test_who_answers_all_the_time_is_heard_to_be_alive() -> None:
    here, there = socket.socketpair()
    with here, there:
        outbox = Outbox(here)
        end = time.monotonic() + 4 * ALIVE_S
        while time.monotonic() < end:
            outbox.rounds += 1
            outbox.send(CellAnswer(number=outbox.rounds, result=b"sample"))
            time.sleep(ALIVE_S / 20)
        outbox.close(5.0)
        here.shutdown(socket.SHUT_WR)
        reader, reports = FrameReader(there, Report), list[Report]()  # type: ignore[arg-type]
        while (report := reader.read()) is not None:
            reports.append(report)
    rounds = [each.rounds for each in reports if isinstance(each, Alive)]
    assert len(rounds) >= 2 and rounds == sorted(set(rounds)), "more than the first, and each time further"
    assert sum(isinstance(each, CellAnswer) for each in reports) == outbox.rounds
