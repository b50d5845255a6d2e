"""Runs a file of trees as BehaviorTree.CPP does, on scripted primitives: written after its documentation, not fast.

`Outcome.hold` is what the declared decorators Try and Invert have to know: that a hold condition was broken below.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from xml.etree.ElementTree import Element

from emit.bt_parts import Blackboard, Node, Outcome, Stage
from emit.tree_rules import Reader


class Player:
    """One instance of the main tree of a file."""

    def __init__(self, text: str, stage: Stage) -> None:
        self.reader = Reader.of(text)
        self.stage = stage
        self.names = self.reader.names()
        main = self.reader.root.attrib["main_tree_to_execute"]
        self.root = self._built(self.reader.trees[main][0], {})

    def tick(self) -> Outcome | None:
        return self.root.tick()

    def ticked(self, node: Node) -> Outcome | None:
        """Tick a node of the library, or one that the file declares."""
        if node.element.tag in self.reader.models:
            return self.declared(node)
        own = re.sub(r"[A-Z]", lambda capital: f"_{capital[0].lower()}", node.element.tag)
        tick: Callable[[Node], Outcome | None] = getattr(self, own)
        return tick(node)

    def _built(self, element: Element, board: Blackboard) -> Node:
        if element.tag == "SubTree":
            inner: Blackboard = board if element.get("_autoremap") == "true" else {}
            return Node(element, [self._built(self.reader.trees[element.attrib["ID"]][0], inner)], board, self)
        return Node(element, [self._built(each, board) for each in element], board, self)

    def script(self, code: str | None, board: Blackboard) -> None:
        for part in (code or "").split("; "):
            if part:
                name, value = part.split(" := ")
                numbers = () if value.startswith("'") else value.split(" + ")
                board[name] = sum(int(str(board.get(each, each))) for each in numbers) if numbers else value.strip("'")

    def values(self, node: Node) -> Blackboard:
        """Return what the input ports of a node read, by the names of the parameters."""
        parameters = self.reader.parameters(self._identity(node))
        inputs = {each.get("name") for each in self.reader.models[self._identity(node)].findall("input_port")}
        found = {}
        for port, parameter in parameters.items():
            if port not in inputs:
                continue
            written = node.element.get(port)
            if written is not None and not written.startswith("{"):
                found[parameter] = self._converted(node, port, written)
            elif written is not None and written[1:-1] in node.board:
                found[parameter] = node.board[written[1:-1]]
        return found

    def _converted(self, node: Node, port: str, written: str) -> object:
        model = self.reader.models[self._identity(node)]
        kind = next((each.get("type") for each in model if each.get("name") == port), None)
        return {"bool": lambda: written == "true", "double": lambda: float(written)}.get(kind or "", lambda: written)()

    def _identity(self, node: Node) -> str:
        return node.element.get("ID", "") if node.element.tag == "SubTree" else node.element.tag

    # nodes of the library

    def _sequence(self, node: Node) -> Outcome | None:
        return self._in_order(node, going_on=True)

    def _fallback(self, node: Node) -> Outcome | None:
        return self._in_order(node, going_on=False)

    def _in_order(self, node: Node, *, going_on: bool) -> Outcome | None:
        held = bool(node.state.get("hold"))
        while (index := int(str(node.state.get("index", 0)))) < len(node.children):
            outcome = node.children[index].tick()
            if outcome is None:
                return None
            if outcome.ok != going_on:
                return outcome
            held = node.state["hold"] = held or outcome.hold
            node.state["index"] = index + 1
        return Outcome(going_on, held and not going_on)

    def _reactive_sequence(self, node: Node) -> Outcome | None:
        return self._reactive(node, going_on=True)

    def _reactive_fallback(self, node: Node) -> Outcome | None:
        return self._reactive(node, going_on=False)

    def _reactive(self, node: Node, *, going_on: bool) -> Outcome | None:
        held = False
        for index, child in enumerate(node.children):
            outcome = child.tick()
            if outcome is None or outcome.ok != going_on:
                for other in node.children[:index] + node.children[index + 1 :]:
                    other.halt()
                return outcome
            held = held or outcome.hold
        return Outcome(going_on, held and not going_on)

    def _parallel(self, node: Node) -> Outcome | None:
        ended = node.state.setdefault("ended", {})
        assert isinstance(ended, dict)
        size = len(node.children)
        needed, allowed = (_threshold(node, word, size) for word in ("success_count", "failure_count"))
        for index, child in enumerate(node.children):
            if index not in ended:
                outcome = child.tick()
                if outcome is not None:
                    ended[index] = outcome
            good = sum(each.ok for each in ended.values())
            bad = [each for each in ended.values() if not each.ok]
            if good >= needed or size - len(bad) < needed or len(bad) >= allowed:
                for each in node.children:
                    each.halt()
                last = [each for each in bad if each.hold] if needed == 1 and allowed == size else bad[-1:]
                return Outcome(True) if good >= needed else Outcome(False, any(each.hold for each in last))
        return None

    def _if_then_else(self, node: Node) -> Outcome | None:
        if "branch" not in node.state:
            outcome = node.children[0].tick()
            if outcome is None:
                return None
            node.state["branch"] = 1 if outcome.ok else 2
        branch = int(str(node.state["branch"]))
        return node.children[branch].tick() if branch < len(node.children) else Outcome(False)

    def _inverter(self, node: Node) -> Outcome | None:
        outcome = node.children[0].tick()
        return None if outcome is None else Outcome(not outcome.ok)

    def _force_success(self, node: Node) -> Outcome | None:
        return None if node.children[0].tick() is None else Outcome(True)

    def _keep_running_until_failure(self, node: Node) -> Outcome | None:
        outcome = node.children[0].tick()
        return None if outcome is None or outcome.ok else outcome

    def _repeat(self, node: Node) -> Outcome | None:
        return self._rounds(node, self._number(node, "num_cycles"), until=False)

    def _retry_until_successful(self, node: Node) -> Outcome | None:
        return self._rounds(node, self._number(node, "num_attempts"), until=True)

    def _number(self, node: Node, port: str) -> int:
        written = node.element.attrib[port]
        return int(str(node.board[written[1:-1]] if written.startswith("{") else written))

    def _rounds(self, node: Node, count: int, *, until: bool) -> Outcome | None:
        outcome = node.children[0].tick()
        if outcome is None:
            return None
        done = node.state["done"] = int(str(node.state.get("done", 0))) + 1
        return outcome if outcome.ok == until or done == count else None

    def _timeout(self, node: Node) -> Outcome | None:
        until = float(str(node.state.setdefault("until", self.stage.now + self._seconds(node))))
        if node.running and self.stage.now > until + 1e-9:
            node.children[0].halt()
            return Outcome(False)
        return node.children[0].tick()

    def _sleep(self, node: Node) -> Outcome | None:
        until = float(str(node.state.setdefault("until", self.stage.now + self._seconds(node))))
        return Outcome(True) if self.stage.now >= until - 1e-9 else None

    def _seconds(self, node: Node) -> float:
        written = node.element.attrib["msec"]
        return float(str(node.board[written[1:-1]] if written.startswith("{") else written)) / 1000

    def _always_success(self, node: Node) -> Outcome:
        return Outcome(True)

    def _always_failure(self, node: Node) -> Outcome:
        return Outcome(False)

    def _script(self, node: Node) -> Outcome:
        self.script(node.element.attrib["code"], node.board)
        return Outcome(True)

    def _script_condition(self, node: Node) -> Outcome:
        name, operator, value = node.element.attrib["code"].split(" ")
        found = int(str(node.board[name]))
        number = int(value) if value.isdecimal() else int(str(node.board[value]))
        return Outcome({"==": found == number, "<": found < number}[operator])

    def _sub_tree(self, node: Node) -> Outcome | None:
        """Tick the tree; its entries are the caller's where they are mapped, so both boards are kept alike."""
        if node.element.get("_autoremap") == "true":
            return node.children[0].tick()
        mapped = {port: value for port, value in node.element.attrib.items() if port != "ID" and port[0] != "_"}
        inner = node.children[0].board
        inner.update(self.values(node))
        for port, value in mapped.items():
            if re.fullmatch(r"\{.*\}", value):
                inner.pop(port, None)
                if value[1:-1] in node.board:
                    inner[port] = node.board[value[1:-1]]
            else:
                inner[port] = self._converted(node, port, value)
        outcome = node.children[0].tick()
        for port, value in mapped.items():
            if value.startswith("{") and port in inner:
                node.board[value[1:-1]] = inner[port]
        return outcome

    # nodes that a file declares

    def declared(self, node: Node) -> Outcome | None:
        path = self.names[node.element.tag]
        match self.reader.models[node.element.tag].tag, path:
            case "Condition", _:
                holds = self.stage.holds(path, node.element.get("_description", ""), self.values(node))
                return Outcome(holds, not holds and "hold" in path[2:3])
            case "Decorator", ("", "With", skill):
                return self._with(node, skill)
            case "Decorator", ("", "ForEach"):
                return self._for_each(node)
            case "Control", ("", "Finally"):
                return self._finally(node)
            case "Decorator", ("", "Try" | "Invert" as word):
                outcome = node.children[0].tick()
                if outcome is None or outcome.hold:
                    return outcome
                return Outcome(word == "Try" or not outcome.ok)
            case "Action", _:
                return self._action(node, path)
        raise NotImplementedError(path)

    def _action(self, node: Node, path: tuple[str, ...]) -> Outcome | None:
        if "step" not in node.state:
            values = node.state["values"] = self.values(node)
            node.state["step"] = self.stage.action(path, values)
        step = node.state["step"]
        assert callable(step)
        outcome = step()
        assert outcome is None or isinstance(outcome, Outcome)
        if outcome is not None and outcome.ok:
            self._put_out(node, self.stage.found(path))
        return outcome

    def _put_out(self, node: Node, found: Blackboard) -> None:
        parameters = self.reader.parameters(node.element.tag)
        for port in self.reader.models[node.element.tag].findall("output_port"):
            name = port.attrib["name"]
            if parameters[name] in found and name in node.element.attrib:
                node.board[node.element.attrib[name][1:-1]] = found[parameters[name]]

    def _for_each(self, node: Node) -> Outcome | None:
        if "items" not in node.state:
            node.state["items"] = list(self.values(node)["items"])  # type: ignore[call-overload]
        items = node.state["items"]
        assert isinstance(items, list)
        if not items:
            return Outcome(True)
        node.board[node.element.attrib["item"][1:-1]] = items[0]
        outcome = node.children[0].tick()
        if outcome is None or not outcome.ok:
            return outcome
        items.pop(0)
        return None if items else outcome

    def _finally(self, node: Node) -> Outcome | None:
        if "outcome" not in node.state:
            outcome = node.children[0].tick()
            if outcome is None:
                return None
            node.state["outcome"] = outcome
        outcome = node.state["outcome"]
        assert isinstance(outcome, Outcome)
        return None if node.children[1].tick() is None else outcome

    def _with(self, node: Node, skill: str) -> Outcome | None:
        if not node.state.get("set up"):
            outcome = self._action(node, (skill,))
            if outcome is None:
                return None
            if not outcome.ok:
                self.stage.undo((skill,), self.values(node))
                return outcome
            node.state["set up"] = True
        outcome = node.children[0].tick()
        if outcome is not None:
            self.stage.undo((skill,), self.values(node))
        return outcome

    def halted(self, node: Node) -> None:
        if node.element.tag not in self.names:
            return
        path, kind = self.names[node.element.tag], self.reader.models[node.element.tag].tag
        values = node.state.get("values", {})
        assert isinstance(values, dict)
        if kind == "Action":
            self.stage.halt(path, values)
        if path[:2] == ("", "With"):
            if not node.state.get("set up"):
                self.stage.halt(path[2:], values)
            self.stage.undo(path[2:], values)


def _threshold(node: Node, word: str, size: int) -> int:
    count = int(node.element.attrib[word])
    return count if count >= 0 else max(size + count + 1, 0)
