"""What stands in for numpy where it is not installed gives what numpy gives, or refuses; plans are the same."""

from __future__ import annotations

from types import ModuleType
from typing import Any

import numpy
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from skillc_runtime.motion import small_arrays

COMPONENT = st.floats(-9.0, 9.0, width=32)
VECTORS = st.lists(COMPONENT, min_size=3, max_size=3)
MATRICES = st.lists(VECTORS, min_size=1, max_size=5)

OF_VECTORS = (
    "a + b, a - b, a * b, a / 7.0, 2 * a, 1 - a, -a, a % 3.0, a ** 2, abs(a)",
    "a / b",
    "a < b, a <= b, a == b, a != b, (a < b) & (a > 0), (a < b) | (a > 0), ~(a < b)",
    "a @ b, np.dot(a, b), np.cross(a, b), np.linalg.norm(a), np.array_equal(a, b), np.array_equal(a, a.copy())",
    "a.max(), a.min(), a.sum(), (a > b).all(), (a > b).any(), int(np.argmin(a)), np.ptp(a), a.mean()",
    "np.maximum(a, b), np.minimum(a, 0.5), np.maximum(0.5, a), np.clip(a, -1.0, 1.0), np.hypot(*a[:2])",
    "np.abs(a), np.sqrt(np.abs(a)), np.sin(a), np.cos(b), np.arccos(np.clip(a, -1, 1)), np.degrees(a), np.floor(a)",
    "a[1], a[-1], a[:2], a[::-1], a[a > 0], a[None, :], a[:, None], np.flatnonzero(a > b)",
    "np.append(a[:2], 1.0), np.concatenate([[a], [b]]), np.vstack([[a], [b]]), np.column_stack([a, b])",
    "np.diag(a), a.tolist(), a.size, a.shape, len(a), np.isfinite(a), a.ravel(), np.array([*a, *b]), list(a[1:])",
    "np.array([a, b]).max(axis=0), np.array(a) @ np.array([a, b]).T, np.floor(a).astype(int), a.reshape(-1, 3)",
)
OF_MATRICES = (
    "m + 1, m * a, a - m, m * m, m[:, :1] * a, m @ a, a @ m.T, m @ np.diag(a), m @ m.T, m.T, m.T @ m",
    "m[0], m[0, 1], m[:, 2], m[:, :2], m[1:], m[-1], m[m[:, 0] > 0], m[0, :2], m[:1, 1], m[:1, :2]",
    "m.max(), m.max(axis=0), m.min(axis=1), m.sum(axis=0), (m < a).all(axis=1), (m < a).any(axis=0)",
    "np.linalg.norm(m), np.linalg.norm(m, axis=1), np.ptp(m, axis=0), [row @ a for row in m], m.shape, m.size, m.ndim",
    "np.maximum(np.abs(m) - a, 0.0), m.reshape(3, -1), m.ravel(), len(m), np.vstack([m, m]), np.concatenate([m, m])",
)
FIXED = (
    "np.eye(3), np.zeros(3), np.zeros((2, 3)), np.ones(2), np.full(2, 0.5), np.arange(4), np.arange(-2, 3) * 0.5",
    "np.linspace(0, 1, 5), np.linspace(-1.0, 2.0, 1), np.linspace(0.0, 6.0, 8, endpoint=False), list(np.ndindex(2, 3))",
    "np.array([[1, 2], [3.5, 4]]), np.asarray([True, False]), np.array((1, 2), dtype=float), np.all([1, 0]), np.inf",
)


def plain(value: Any) -> Any:
    """Return arrays as lists, recursively."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    return [plain(each) for each in value] if isinstance(value, list | tuple) else value


def evaluate(expressions: str, np: ModuleType, **arrays: Any) -> Any:
    known = {"np": np, **{name: np.array(value) for name, value in arrays.items()}}
    with numpy.errstate(all="ignore"):
        return plain(eval(f"[{expressions}]", known))


def check(expressions: str, **arrays: Any) -> None:
    ours, theirs = (evaluate(expressions, np, **arrays) for np in (small_arrays, numpy))
    assert len(ours) == len(theirs) > 0
    for one, other in zip(ours, theirs, strict=True):
        numpy.testing.assert_allclose(one, other, rtol=1e-9, atol=1e-9, err_msg=expressions)


@pytest.mark.parametrize("expressions", OF_VECTORS)
@given(a=VECTORS, b=VECTORS)
@settings(max_examples=30, deadline=None)
def test_vectors_are_those_of_numpy(expressions: str, a: list[float], b: list[float]) -> None:
    check(expressions, a=a, b=b)


@pytest.mark.parametrize("expressions", OF_MATRICES)
@given(m=MATRICES, a=VECTORS)
@settings(max_examples=30, deadline=None)
def test_matrices_are_those_of_numpy(expressions: str, m: list[list[float]], a: list[float]) -> None:
    check(expressions, m=m, a=a)


@pytest.mark.parametrize("expressions", FIXED)
def test_arrays_are_made_as_numpy_makes_them(expressions: str) -> None:
    check(expressions)


def test_parts_are_written_as_numpy_writes_them() -> None:
    written = []
    for np in (small_arrays, numpy):
        a, m = np.zeros(4), np.zeros((2, 3))
        a[1], a[2:] = 5.0, [6.0, 7.0]
        m[0, 1], m[1] = 2.0, np.array([3.0, 4.0, 5.0])
        m[:, 2] = 9.0
        written.append(plain([a, m]))
    assert written[0] == written[1] == [[0.0, 5.0, 6.0, 7.0], [[0.0, 2.0, 9.0], [3.0, 4.0, 9.0]]]


@pytest.mark.parametrize(
    "expression",
    ("np.einsum('i', a)", "np.array(['x'])", "np.zeros((2, 2, 2))", "a[..., 0]", "np.array(1.0)", "np.cross(m, m)"),
)
def test_what_it_does_not_have_asks_for_numpy(expression: str) -> None:
    with pytest.raises(ModuleNotFoundError) as refused:
        evaluate(expression, small_arrays, a=[1.0, 2.0], m=[[1.0, 2.0, 3.0]])
    assert refused.value.name == "numpy"
