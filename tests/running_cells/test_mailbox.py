"""A cell says that its loop goes round, whatever else it has to say, and takes no more requests than it can keep."""

from __future__ import annotations

import socket
import time

from skillc.cells.frames import FrameReader, send_frame
from skillc.cells.mailbox import ALIVE_S, MAX_WAITING, Inbox, Outbox
from skillc.contract.messages import Acknowledge, Alive, CellAnswer, CellRequest, Report


def test_who_answers_all_the_time_is_heard_to_be_alive() -> None:
    here, there = socket.socketpair()
    with here, there:
        outbox, rounds = Outbox(here), list[int]()
        reader = FrameReader(there, Report)  # type: ignore[arg-type]
        while len(rounds) < 3:
            outbox.rounds += 1
            outbox.send(CellAnswer(number=outbox.rounds, result=b"sample"))
            while isinstance(report := reader.read(), Alive):
                rounds.append(report.rounds)
            assert isinstance(report, CellAnswer) and report.number == outbox.rounds
            time.sleep(ALIVE_S / 20)
        outbox.close(60.0)
    assert rounds == sorted(set(rounds)), "each time further"


def test_requests_beyond_those_that_may_wait_are_refused_at_once() -> None:
    here, there = socket.socketpair()
    with here, there:
        outbox = Outbox(here)
        inbox = Inbox(here, outbox)
        for number in range(MAX_WAITING + 3):
            send_frame(there, CellRequest(number, Acknowledge()))
        reader, refused = FrameReader(there, Report), dict[int, str]()  # type: ignore[arg-type]
        while len(refused) < 3:
            report = reader.read()
            if isinstance(report, CellAnswer):
                assert report.refused is not None and report.refused.kind == "busy"
                refused[report.number] = report.refused.reason
        assert list(refused) == [MAX_WAITING, MAX_WAITING + 1, MAX_WAITING + 2]
        assert set(refused.values()) == {f"{MAX_WAITING} requests wait for the cell; try again later"}
        taken = [request.number for _ in range(MAX_WAITING) if (request := inbox.take(0.0)) is not None]
        assert taken == list(range(MAX_WAITING)) and inbox.take(0.0) is None
        outbox.close(5.0)
