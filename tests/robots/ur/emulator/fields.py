"""The fields of the Real-Time Data Exchange of an e-Series controller, with their types (RTDE guide, PolyScope 5)."""

from __future__ import annotations

import struct

FORMATS = {
    "BOOL": "?",
    "UINT8": "B",
    "UINT32": "I",
    "UINT64": "Q",
    "INT32": "i",
    "DOUBLE": "d",
    "VECTOR3D": "3d",
    "VECTOR6D": "6d",
    "VECTOR6INT32": "6i",
    "VECTOR6UINT32": "6I",
}
"""How a type is packed, in network byte order."""

_NAMES = {
    "DOUBLE": "timestamp actual_execution_time speed_scaling target_speed_fraction actual_momentum actual_main_voltage "
    "actual_robot_voltage actual_robot_current standard_analog_input0 standard_analog_input1 standard_analog_output0 "
    "standard_analog_output1 payload",
    "VECTOR6D": "target_q target_qd target_qdd target_current target_moment actual_q actual_qd actual_current "
    "joint_control_output actual_TCP_pose actual_TCP_speed actual_TCP_force target_TCP_pose target_TCP_speed "
    "joint_temperatures actual_joint_voltage ft_raw_wrench payload_inertia tcp_offset "
    "actual_current_as_torque",
    "VECTOR3D": "actual_tool_accelerometer payload_cog",
    "VECTOR6INT32": "joint_mode",
    "INT32": "robot_mode safety_mode",
    "UINT32": "runtime_state robot_status_bits safety_status_bits",
    "UINT64": "actual_digital_input_bits actual_digital_output_bits",
}
OUTPUTS = {name: kind for kind, names in _NAMES.items() for name in names.split()}
OUTPUTS |= {f"output_int_register_{i}": "INT32" for i in range(48)}
OUTPUTS |= {f"output_double_register_{i}": "DOUBLE" for i in range(48)}

INPUTS = {
    "speed_slider_mask": "UINT32",
    "speed_slider_fraction": "DOUBLE",
    "standard_digital_output_mask": "UINT8",
    "standard_digital_output": "UINT8",
    "configurable_digital_output_mask": "UINT8",
    "configurable_digital_output": "UINT8",
    "tool_digital_output_mask": "UINT8",
    "tool_digital_output": "UINT8",
    "standard_analog_output_mask": "UINT8",
    "standard_analog_output_type": "UINT8",
    "standard_analog_output_0": "DOUBLE",
    "standard_analog_output_1": "DOUBLE",
    "external_force_torque": "VECTOR6D",
}
INPUTS |= {f"input_int_register_{i}": "INT32" for i in range(48)}
INPUTS |= {f"input_double_register_{i}": "DOUBLE" for i in range(48)}

Value = float | int | list[float]


class Recipe:
    """Fields in the order in which one client packs them."""

    def __init__(self, names: list[str], known: dict[str, str]) -> None:
        self.names = names
        self.types = [known.get(name, "NOT_FOUND") for name in names]
        self._struct = struct.Struct(">" + "".join(FORMATS[each] for each in self.types if each in FORMATS))
        self._widths = [int(FORMATS[each][:-1] or 1) for each in self.types if each in FORMATS]

    def pack(self, values: dict[str, Value]) -> bytes:
        """Return the fields, of which `values` has those that are not 0."""
        row: list[float] = []
        for name, width in zip(self.names, self._widths, strict=True):
            value = values.get(name, 0)
            row.extend(value if isinstance(value, list) else [value] * width)
        return self._struct.pack(*row)

    def unpack(self, data: bytes) -> dict[str, Value]:
        """Return the values by field."""
        row, values, first = self._struct.unpack(data), {}, 0
        for name, width in zip(self.names, self._widths, strict=True):
            values[name] = row[first] if width == 1 else list(row[first : first + width])
            first += width
        return values
