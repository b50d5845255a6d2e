"""State and command are one contiguous array each, in the declared order, so that a step in C can be given both."""

from __future__ import annotations

import ctypes
from dataclasses import fields

import numpy as np
import pytest

from skillc_runtime.backends.control_process.link import KINDS, CommandView, StateView, make_command, make_state

JOINTS = 7
STATE = {"stamp_s": 1, "speed_share": 1, "q": 7, "dq": 7, "target": 7, "effort": 7, "wrench": 6}
COMMAND = {"kind": 1, "values": 7, "pose": 7, "twist": 6, "on_flange": 7, "axes": 4, "stiffness": 6, "push": 6}


class CState(ctypes.Structure):
    """The state of an arm with seven joints, as it is declared in C."""

    _fields_ = [(name, ctypes.c_double * size) for name, size in STATE.items()]


class CCommand(ctypes.Structure):
    """The command, as it is declared in C."""

    _fields_ = [(name, ctypes.c_double * size) for name, size in COMMAND.items()]


@pytest.mark.parametrize(("view", "sizes"), [(make_state(JOINTS), STATE), (make_command(JOINTS), COMMAND)])
def test_the_views_are_the_consecutive_parts_of_one_array(view: StateView | CommandView, sizes: dict[str, int]) -> None:
    assert [field.name for field in fields(view)] == ["buffer", *sizes]
    assert view.buffer.dtype == np.float64
    assert view.buffer.flags.c_contiguous
    view.buffer[:] = np.arange(view.buffer.size)
    parts = [getattr(view, name) for name in sizes]
    assert [part.size for part in parts] == list(sizes.values())
    np.testing.assert_array_equal(np.concatenate(parts), view.buffer)


def test_a_step_gets_them_by_their_addresses() -> None:
    """A function with the types of C reads the state and writes the command, and nothing is copied."""

    @ctypes.CFUNCTYPE(None, ctypes.POINTER(CState), ctypes.POINTER(CCommand))
    def step(state: ctypes._Pointer[CState], command: ctypes._Pointer[CCommand]) -> None:
        command.contents.kind[0] = KINDS.index("position")
        for joint in range(JOINTS):
            command.contents.values[joint] = state.contents.q[joint] + 0.001 * state.contents.dq[joint]

    state, command = make_state(JOINTS), make_command(JOINTS)
    state.q[:], state.dq[:] = np.arange(7.0), 1.0
    addresses = (ctypes.c_void_p(each.buffer.ctypes.data) for each in (state, command))
    kinds = (ctypes.POINTER(CState), ctypes.POINTER(CCommand))
    step(*(ctypes.cast(address, kind) for address, kind in zip(addresses, kinds, strict=True)))
    assert KINDS[int(command.kind[0])] == "position"
    np.testing.assert_allclose(command.values, np.arange(7.0) + 0.001)
    assert np.isnan(command.pose).all()
