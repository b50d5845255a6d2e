"""Strongly connected components of graphs."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Mapping, Sequence
from typing import TypeVar

Node = TypeVar("Node", bound=Hashable)


def components(edges: Mapping[Node, Sequence[Node]]) -> Iterator[Sequence[Node]]:
    """Yield the strongly connected components, each after those that it leads to (Tarjan, without recursion)."""
    number: dict[Node, int] = {}
    low: dict[Node, int] = {}
    path: list[Node] = []
    on_path: set[Node] = set()
    for root in edges:
        todo = [(root, iter(edges[root]))] if root not in number else []
        while todo:
            node, others = todo[-1]
            if node not in number:
                number[node] = low[node] = len(number)
                path.append(node)
                on_path.add(node)
            other = next(others, None)
            if other is None:
                todo.pop()
                if todo:
                    low[todo[-1][0]] = min(low[todo[-1][0]], low[node])
                if low[node] == number[node]:
                    yield _closed(node, path, on_path)
            elif other not in number:
                todo.append((other, iter(edges[other])))
            elif other in on_path:
                low[node] = min(low[node], number[other])


def _closed(root: Node, path: list[Node], on_path: set[Node]) -> Sequence[Node]:
    """Remove the component of a root from the path."""
    found: list[Node] = []
    while not found or found[-1] != root:
        found.append(path.pop())
        on_path.discard(found[-1])
    return found
