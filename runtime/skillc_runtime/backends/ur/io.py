"""The inputs and outputs of a controller, and its speed slider; no real time."""

from __future__ import annotations

from time import monotonic, sleep

from skillc_runtime.backends.ur.exchange import Exchange, ExchangeLost
from skillc_runtime.devices.backend import BackendBroken, BackendUnavailable

RATE_HZ = 50.0

READ = (
    "actual_digital_input_bits", "actual_digital_output_bits", "standard_analog_input0", "standard_analog_input1",
    "standard_analog_output0", "standard_analog_output1", "target_speed_fraction",
)  # fmt: skip

SET = (
    "speed_slider_mask", "speed_slider_fraction", "standard_digital_output_mask", "standard_digital_output",
    "configurable_digital_output_mask", "configurable_digital_output", "tool_digital_output_mask",
    "tool_digital_output", "standard_analog_output_mask", "standard_analog_output_type", "standard_analog_output_0",
    "standard_analog_output_1",
)  # fmt: skip

BANKS = (("standard", 0), ("configurable", 8), ("tool", 16))
"""The kinds of digital outputs, and the number of the first one of each."""

VOLTAGES = 0b11
"""Both analogue outputs are voltages."""

FREE_S = 3.0
"""How long a controller may take to notice that a connection has gone, and to let the next one set the same, in s."""

VOLTS = 10.0
"""The greatest voltage of analogue outputs."""


class UrIo:
    """The inputs and outputs of one controller; digital ones are numbered as in `ur:digitalInput`."""

    def __init__(self, name: str, address: str) -> None:
        """Connect; BackendUnavailable, with what to do."""
        self._name, self._address = name, address
        self._exchange = self._connect()

    def digital_input(self, number: int) -> bool:
        """Return whether a digital input is on."""
        return bool(int(self._exchange.fields["actual_digital_input_bits"]) >> number & 1)

    def digital_output(self, number: int) -> bool:
        """Return whether a digital output is on."""
        return bool(int(self._exchange.fields["actual_digital_output_bits"]) >> number & 1)

    def set_digital_output(self, number: int, on: bool) -> None:
        """Switch a digital output; BackendBroken if the controller does not take that."""
        bank, first = next((bank, first) for bank, first in reversed(BANKS) if number >= first)
        bit = 1 << number - first
        self._set({f"{bank}_digital_output_mask": bit, f"{bank}_digital_output": bit if on else 0})

    def analog_input(self, number: int) -> float:
        """Return an analogue input, 0 or 1, in V or A, as it is set up at the panel."""
        return self._exchange.fields[f"standard_analog_input{number}"]

    def analog_output(self, number: int) -> float:
        """Return an analogue output, 0 or 1, in V."""
        return self._exchange.fields[f"standard_analog_output{number}"]

    def set_analog_output(self, number: int, volts: float) -> None:
        """Set an analogue output, 0 or 1, from 0 to `VOLTS`; BackendBroken."""
        self._set(
            {
                "standard_analog_output_mask": 1 << number,
                "standard_analog_output_type": VOLTAGES,
                f"standard_analog_output_{number}": volts / VOLTS,
            }
        )

    @property
    def speed_share(self) -> float:
        """The share of the commanded speeds that the speed slider lets pass."""
        return self._exchange.fields["target_speed_fraction"]

    def set_speed_share(self, share: float) -> None:
        """Move the speed slider; BackendBroken."""
        self._set({"speed_slider_mask": 1, "speed_slider_fraction": share})

    def find_fault(self) -> str | None:
        """Return that the controller does not answer; None if it does."""
        return self._exchange.fault

    def recover(self) -> None:
        """Connect again if the controller has not answered; BackendUnavailable."""
        if self._exchange.fault is None:
            return
        self._exchange.close()
        until = monotonic() + FREE_S
        while True:
            try:
                self._exchange = self._connect()
                return
            except BackendUnavailable:
                if monotonic() > until:
                    raise
            sleep(0.1)

    def close(self) -> None:
        """Disconnect."""
        self._exchange.close()

    def _connect(self) -> Exchange:
        return Exchange(self._name, self._address, RATE_HZ, READ, SET)

    def _set(self, values: dict[str, float]) -> None:
        try:
            self._exchange.set(values)
        except ExchangeLost as lost:
            raise BackendBroken(str(lost)) from lost
