"""What a server measures of itself, in the text format of Prometheus."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from itertools import accumulate
from typing import get_args

from prometheus_client import CONTENT_TYPE_LATEST, CollectorRegistry, Histogram, generate_latest
from prometheus_client.core import CounterMetricFamily, GaugeMetricFamily, HistogramMetricFamily, Metric
from prometheus_client.registry import Collector

from skillc.cells.tick_intervals import BOUNDS_S
from skillc.contract.cell import CellState
from skillc.server.supervisor import CellSupervisor
from skillc_runtime.devices.control_report import ControlState

CONTENT_TYPE = CONTENT_TYPE_LATEST
SECONDS = (0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1.0, 2.5, 5.0, 10.0)


class Metrics:
    """The metrics of a server with some cells; `count_listeners` returns how many clients listen to events."""

    def __init__(self, cells: Iterable[CellSupervisor], count_listeners: Callable[[], int]) -> None:
        self._registry = CollectorRegistry()
        self._registry.register(_Collector(tuple(cells), count_listeners))
        self._requests = Histogram(
            "skillc_request_seconds",
            "Time from a request to its answer, by method, path and status",
            ("method", "path", "status"),
            buckets=SECONDS,
            registry=self._registry,
        )

    def observe(self, method: str, path: str, status: int, seconds: float) -> None:
        """Count a request to a path of the document, such as `/cells/{cell}`, and the time that it took."""
        self._requests.labels(method, path, str(status)).observe(seconds)

    def format(self) -> bytes:
        """Return all metrics as text."""
        return generate_latest(self._registry)


class _Collector(Collector):
    """Reads how cells are when somebody asks."""

    def __init__(self, cells: tuple[CellSupervisor, ...], count_listeners: Callable[[], int]) -> None:
        self._cells, self._count_listeners = cells, count_listeners

    def collect(self) -> Iterator[Metric]:
        """Return the metrics of cells and clients."""
        yield from self._collect_states()
        yield self._collect_intervals()
        yield from self._collect_arms()
        listeners = GaugeMetricFamily("skillc_listeners", "Clients that listen to events")
        listeners.add_metric((), self._count_listeners())
        yield listeners

    def _collect_states(self) -> Iterator[Metric]:
        states = GaugeMetricFamily("skillc_cell_state", "1 for the state of a cell", labels=("cell", "state"))
        going = GaugeMetricFamily("skillc_operations", "Operations that have not ended", labels=("cell", "state"))
        ended = CounterMetricFamily("skillc_operations_ended", "Operations that ended", labels=("cell", "state"))
        starts = CounterMetricFamily("skillc_cell_starts", "How often a cell was started", labels=("cell",))
        for cell in self._cells:
            name = cell.settings.name
            for state in get_args(CellState):
                states.add_metric((name, state), float(cell.status.state == state))
            for state, count in Counter(each.state for each in cell.operations.values()).items():
                going.add_metric((name, state), count)
            for state, count in cell.ended.items():
                ended.add_metric((name, state), count)
            starts.add_metric((name,), cell.starts)
        yield from (states, going, ended, starts)

    def _collect_arms(self) -> Iterator[Metric]:
        """Return what the processes that control real arms report; no lateness while there are no periods."""
        labels = ("cell", "arm")
        states = GaugeMetricFamily("skillc_arm_state", "1 for the state of a real arm", labels=(*labels, "state"))
        rate = GaugeMetricFamily(
            "skillc_arm_rate_hz", "Control periods a second, in the last seconds; 0 while there are none", labels=labels
        )
        late = GaugeMetricFamily(
            "skillc_arm_late_seconds",
            "By how much the latest control period began late, in the last seconds",
            labels=labels,
        )
        speed = GaugeMetricFamily(
            "skillc_arm_speed_share", "Share of the commanded speeds that the speed slider lets through", labels=labels
        )
        lost = CounterMetricFamily("skillc_arm_lost_periods", "Control periods that were lost", labels=labels)
        for cell in self._cells:
            for each in cell.alive.arms.values():
                name = (cell.settings.name, each.name)
                for state in get_args(ControlState):
                    states.add_metric((*name, state), float(each.state == state))
                rate.add_metric(name, each.rate_hz or 0.0)
                if each.late_s is not None:
                    late.add_metric(name, each.late_s)
                speed.add_metric(name, each.speed_share)
                lost.add_metric(name, each.lost_periods)
        yield from (states, rate, late, speed, lost)

    def _collect_intervals(self) -> Metric:
        help_text = "Time between successive ticks of a cell while something goes on, since its process was started"
        ticks = HistogramMetricFamily("skillc_tick_interval_seconds", help_text, labels=("cell",))
        bounds = (*map(str, BOUNDS_S), "+Inf")
        for cell in self._cells:
            counts = accumulate(cell.alive.intervals or (0,) * len(bounds))
            ticks.add_metric((cell.settings.name,), list(zip(bounds, counts, strict=True)), cell.alive.intervals_s)
        return ticks
