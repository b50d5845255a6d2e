"""The stiffness of a controller that has it as parameters, such as FZI's cartesian_compliance_controller."""

from __future__ import annotations

from time import monotonic
from typing import Any, Final

import numpy as np

from skillc_runtime.backends.control_process.link import DeviceCondition
from skillc_runtime.backends.ros2.session import Session, find_message
from skillc_runtime.motion.pose import Array

NAMES: Final = tuple(f"stiffness.{kind}_{axis}" for kind in ("trans", "rot") for axis in "xyz")
NEW_SHARE: Final = 0.01
"""A stiffness that differs by less than this share of its greatest part is not sent again."""
ANSWER_S: Final = 0.5
"""An answer that has not come by then is not waited for any more."""
KIND: Final = "rcl_interfaces/srv/SetParameters"


class StiffnessParameters:
    """Sets them without waiting: one request at a time, the newest values next."""

    def __init__(self, session: Session, node: str) -> None:
        """Use the service by which the parameters of a node are set."""
        self._service = f"{node}/set_parameters"
        self._kind = find_message(KIND)
        self._client: Any = session.node.create_client(self._kind, self._service)
        self._waits_until, self._refusal = 0.0, ""
        self._sent = np.full(len(NAMES), np.nan)
        request, parameter = self._kind.Request(), find_message("rcl_interfaces/msg/Parameter")
        request.parameters = [parameter(name=name) for name in NAMES]
        for each in request.parameters:
            each.value.type = 3  # a double
        self._request = request

    def send(self, stiffness: Array) -> None:
        """Set a stiffness (6,) in N/m and N m/rad, unless it is set already or an answer is waited for."""
        self._take_answer()
        is_new = not np.abs(stiffness - self._sent).max() <= NEW_SHARE * stiffness.max()
        if self._waits_until > monotonic() or not is_new or not self._client.service_is_ready():
            return
        for each, value in zip(self._request.parameters, stiffness.tolist(), strict=True):
            each.value.double_value = value
        self._client.handle.send_request(self._request)
        self._waits_until, self._sent = monotonic() + ANSWER_S, stiffness.copy()

    def find_obstacle(self) -> DeviceCondition | None:
        """Return why the stiffness cannot be set; None if it can."""
        self._take_answer()
        if not self._client.service_is_ready():
            return DeviceCondition(
                "wrong-mode", f"nobody offers the service {self._service} ({KIND}): activate the controller"
            )
        return DeviceCondition("wrong-mode", f"{self._service} refuses: {self._refusal}") if self._refusal else None

    def _take_answer(self) -> None:
        found = self._client.handle.take_response(self._kind.Response)
        if found is None or found[0] is None:
            return
        self._waits_until = 0.0
        refused = [each.reason or "no reason is given" for each in found[1].results if not each.successful]
        self._refusal = refused[0] if refused else ""
