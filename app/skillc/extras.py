"""What `pip install skillc` leaves out: which extra brings a package, and the error that says how to install it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from importlib.util import find_spec
from types import MappingProxyType

from skillc.errors import RequestError

MODULES: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "run": ("mujoco", "numpy", "mcap", "matplotlib", "PIL", "rich", "av", "numba", "lz4", "zstandard"),
        "planner": ("up_fast_downward",),
        "temporal": ("ortools",),
        "meshes": ("coacd",),
        "data": ("pandas", "pyarrow", "rdflib"),
        "server": ("httpx", "starlette", "uvicorn", "websockets", "prometheus_client", "h11", "httpcore"),
        "robots": ("pinocchio", "coal"),
        "pddl": ("pddl",),
        "ros2": ("rclpy",),
        "ur": ("rtde_control", "rtde_receive", "rtde_io"),
        "franka": ("pylibfranka",),
        "cluster": ("distributed",),
        "learn": ("optuna", "sqlalchemy", "alembic"),
        "ontologies": ("pyhornedowl", "owlrl"),
        "gym": ("gymnasium",),
        "vision": ("cv2",),
    }
)
"""The modules of each extra; the first ones are those without which it is of no use."""
_NEEDED = MappingProxyType({"run": 6, "server": 5, "data": 2, "ur": 3, "learn": 2})
"""How many modules of an extra have to be there, if it is not one."""


class MissingExtraError(RequestError):
    """What was asked for needs packages that are not installed; the message has the command that installs them."""


def install_command(*extras: str) -> str:
    """Return the command that installs extras."""
    return f"pip install 'skillc[{','.join(extras)}]'"


def missing_extras(*extras: str) -> tuple[str, ...]:
    """Return those extras of which a needed module is not installed."""
    return tuple(each for each in extras if any(find_spec(name) is None for name in _needed(each)))


def require(what: str, *extras: str) -> None:
    """Raise MissingExtraError if one of the extras is not installed; `what` is what needs it."""
    if missing := missing_extras(*extras):
        names = ", ".join(name for each in missing for name in _needed(each) if find_spec(name) is None)
        raise MissingExtraError(f"{what} needs what is not installed ({names}): {install_command(*missing)}")


@contextmanager
def naming_extras() -> Iterator[None]:
    """Turn the error of a `with` block that imports a module of an extra into a MissingExtraError."""
    try:
        yield
    except ModuleNotFoundError as error:
        module = (error.name or "").partition(".")[0]
        extra = next((name for name, modules in MODULES.items() if module in modules), None)
        if extra is None or find_spec(module) is not None:
            raise
        raise MissingExtraError(f"this needs {module}, which is not installed: {install_command(extra)}") from error


def _needed(extra: str) -> tuple[str, ...]:
    return MODULES[extra][: _NEEDED.get(extra, 1)]
