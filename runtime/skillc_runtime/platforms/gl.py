"""GL libraries that draw off screen."""

from __future__ import annotations

import ctypes.util
import os
from typing import Any

PLATFORMS = {"EGL": "egl", "OSMesa": "osmesa"}
"""GL libraries that render off screen, and their names in PyOpenGL."""


class RenderingError(RuntimeError):
    """There is no GL library that renders off screen; the message says how to install one."""


def make_gl_context(width: int, height: int) -> tuple[str, Any]:
    """Return the first GL context that can be created, of width x height pixels, with the name of its library.

    RenderingError if there is none.
    """
    reasons = []
    for library, platform in PLATFORMS.items():
        if ctypes.util.find_library(library) is None:
            continue
        if os.environ.setdefault("PYOPENGL_PLATFORM", platform) != platform:
            continue
        try:
            return library, _create_context(library, width, height)
        except (ImportError, AttributeError, RuntimeError) as error:
            reasons.append(f"{library}: {error}")
    tried = f" ({'; '.join(reasons)})" if reasons else ""
    raise RenderingError(f"no GL library draws off screen{tried}; on Debian: apt install libegl1 libgl1-mesa-dri")


def _create_context(library: str, width: int, height: int) -> Any:
    if library == "EGL":
        from mujoco.egl import GLContext
    else:
        from mujoco.osmesa import GLContext
    return GLContext(width, height)
