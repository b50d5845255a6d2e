"""The leaves of an exported tree, done by the primitives, functions and conditions of the library itself."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import cast

import msgspec

from emit.bt_parts import Blackboard, Outcome
from emit.bt_parts import Stage as Leaves
from skillc_model.conditions import Arithmetic, Condition, Expression, IsA, Literal, Variable
from skillc_model.skills import Compound, Implementation, Primitive, SkillLibrary
from skillc_model.traversal import walk
from skillc_model.tree import Call, Check, ForEach, If, Repeat, Timeout, Wait, WaitUntil, While
from skillc_rdf.vocabulary.types import ClassType
from skillc_runtime.execution.selection.binding import BoundImplementation, bind_implementation
from skillc_runtime.execution.selection.python_targets import import_primitive
from skillc_runtime.primitives.primitive import Primitive as Running
from skillc_runtime.primitives.primitive import SkillFailure, Status
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.effects import changes_of
from skillc_runtime.world.eval.expressions import value_of
from skillc_runtime.world.state.values import Value
from tree.stage import Stage

Path = tuple[str, ...]
Bindings = dict[str, Value]


class LibraryLeaves(Leaves):
    """Does on a stage what the names behind each node stand for."""

    def __init__(self, library: SkillLibrary, stage: Stage) -> None:
        self.library, self.stage = library, stage
        self.running: dict[int, Running] = {}
        self.set_up: list[Running] = []
        self.outputs: dict[Path, Blackboard] = {}

    def found(self, path: Path) -> Blackboard:
        return self.outputs.get(path, {})

    def action(self, path: Path, values: Blackboard) -> Callable[[], Outcome | None]:
        bindings = cast(Bindings, values)
        match path:
            case (skill, "", "infer"):
                return self._at_once(path, lambda: self._inferred(skill, bindings))
            case (*_, "evaluate", _):
                return self._at_once(path, lambda: self._value(path, bindings))
            case (skill, implementation, "apply", label):
                key = f"{skill}.{implementation}"
                return self._at_once(path, lambda: self._applied(self.library.implementations[key], label, bindings))
            case (skill,):
                fitted = self._fitted(skill, bindings)
                bindings.update(fitted.bindings)
                return self._primitive(path, fitted.implementation, bindings)
            case (skill, implementation):
                return self._primitive(path, self.library.implementations[f"{skill}.{implementation}"], bindings)
        raise NotImplementedError(path)

    def halt(self, path: Path, values: Blackboard) -> None:
        running = self.running.pop(id(values), None)
        if running is not None:
            running.halt("the tree says so")

    def undo(self, path: Path, values: Blackboard) -> None:
        if self.set_up:
            self.set_up.pop().release()

    def holds(self, path: Path, source: str, values: Blackboard) -> bool:
        return evaluate(self._condition(path, source), self.stage.world.snapshot(), cast(Bindings, values))

    def _at_once(self, path: Path, do: Callable[[], Blackboard | None]) -> Callable[[], Outcome]:
        def step() -> Outcome:
            found = do()
            self.outputs[path] = found or {}
            return Outcome(found is not None)

        return step

    def _inferred(self, skill: str, bindings: Bindings) -> Blackboard | None:
        parameters = self.library.skills[skill].parameters
        for each in self.library.implementations_of(skill):
            fitted = bind_implementation(each, bindings, self.stage.world.snapshot())
            if isinstance(fitted, BoundImplementation):
                names = [each.name for each in parameters if each.direction == "infer"]
                return {name: fitted.bindings[name] for name in names}
        return None

    def _fitted(self, skill: str, bindings: Bindings) -> BoundImplementation:
        fitted = bind_implementation(self.library.implementations_of(skill)[0], bindings, self.stage.world.snapshot())
        assert isinstance(fitted, BoundImplementation)
        return fitted

    def _value(self, path: Path, bindings: Bindings) -> Blackboard:
        expression = self._expression(path)
        # Ports of numbers that a call writes have text.
        read = {name: int(value) if str(value).isdecimal() else value for name, value in bindings.items()}
        value = value_of(expression, self.stage.world.snapshot(), read)
        return {"value": value, "value_": value}

    def _applied(self, implementation: Implementation, label: str, bindings: Bindings) -> Blackboard:
        effects = [effect for post in implementation.post if post.label == label for effect in post.effects]
        self.stage.world.commit(changes_of(effects, self.stage.world.snapshot(), bindings))
        return {}

    def _primitive(
        self, path: Path, implementation: Implementation, bindings: Bindings
    ) -> Callable[[], Outcome | None]:
        assert isinstance(implementation.body, Primitive)
        inputs = {each.name: bindings.get(each.name) for each in implementation.parameters if each.direction != "out"}
        running = import_primitive(implementation.body.python)(self.stage, **inputs)  # type: ignore[arg-type]
        running.start()
        self.running[id(bindings)] = running
        if self.library.skills[implementation.skill].scoped:
            self.set_up.append(running)

        def step() -> Outcome | None:
            try:
                if running.tick() is Status.RUNNING:
                    return None
            except SkillFailure:
                self.running.pop(id(bindings)).halt("it failed")
                return Outcome(False)
            del self.running[id(bindings)]
            effects = [effect for post in implementation.post if not post.sensed for effect in post.effects]
            self.stage.world.commit(changes_of(effects, self.stage.world.snapshot(), bindings))
            self.outputs[path] = dict(running.outputs)
            return Outcome(True)

        return step

    def _condition(self, path: Path, source: str) -> Condition:
        match path:
            case (skill, implementation, "type", name):
                narrowed = self.library.implementations[f"{skill}.{implementation}"].parameters
                (type_,) = [each.type for each in narrowed if each.name == name]
                assert isinstance(type_, ClassType)
                return IsA(Variable(name), type_.iri)
            case (skill, implementation, "pre" | "hold" | "post", label):
                key = f"{skill}.{implementation}"
                owner = self.library.implementations[key] if implementation else self.library.skills[skill]
                (found,) = [each for each in (*owner.pre, *owner.hold, *owner.post) if each.label == label]
                return found.condition
        tests = (each for each in self._nodes() if isinstance(each, Check | WaitUntil | If | While))
        (found_one,) = {each.condition for each in tests if str(each.source) == source}
        return found_one

    def _expression(self, path: Path) -> Expression:
        """Return the expression of a node that evaluates one: a let by its name, else by the text that it declares."""
        owner = self.library.implementations.get(".".join(path[:2]))
        for each in (*owner.lets, *owner.outputs) if owner is not None else ():
            if each.name == path[-1]:
                return each.value
        word, _, number = path[-1].rpartition("__")
        return list(self._computed(word or path[-1]))[int(number or 1) - 1 if word in ("items", "most") else 0]

    def _computed(self, word: str) -> Iterator[Expression]:
        for each in self._nodes():
            match each:
                case Call(arguments=arguments) if word in arguments and not isinstance(arguments[word], Variable):
                    yield arguments[word]
                case ForEach(items=items) if word == "items" and not isinstance(items, Variable):
                    yield items
                case While(limit=limit) if word == "most" and not isinstance(limit, int | Variable):
                    yield limit
                case Repeat(count=count) if word == "rounds" and not isinstance(count, int | Variable):
                    yield count
                case Wait(seconds=seconds) | Timeout(seconds=seconds) if word == "milliseconds":
                    yield Arithmetic("*", seconds, Literal(1000.0))

    def _nodes(self) -> Iterator[msgspec.Struct]:
        bodies = [each.body.node for each in self.library.implementations.values() if isinstance(each.body, Compound)]
        bodies += [each.body for each in self.library.tasks.values() if each.body is not None]
        for body in bodies:
            yield from walk(body)
