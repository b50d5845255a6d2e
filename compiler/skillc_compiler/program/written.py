"""What is written in declarations: the skills that they describe, implement and call."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_dsl import syntax as s


def skill_of(declaration: s.Declaration) -> str:
    """Return the skill that a declaration describes or implements; empty for others."""
    match declaration:
        case s.SkillDeclaration(name=name) | s.ImplementationDeclaration(skill=name):
            return name.text
    return ""


def calls_of(declaration: s.Declaration) -> Iterator[s.CallSkill]:
    """Yield the calls in the body of a declaration."""
    match declaration:
        case s.ImplementationDeclaration(members=members):
            todo: list[s.Node] = [member.node for member in members if isinstance(member, s.Body)]
        case s.TaskDeclaration(body=s.Body(node=node)):
            todo = [node]
        case _:
            return
    while todo:
        match todo.pop():
            case s.CallSkill() as call:
                yield call
            case s.OnFailure(node=block, handler=handler):
                todo += [block, *handler]
            case s.Finally(node=block, last=last):
                todo += [block, *last]
            case s.With(call=call, children=children):
                todo += [call, *children]
            case s.If(then=then, orelse=orelse):
                todo += [*then, *(orelse or ())]
            case s.Block() | s.Decorator() | s.While() | s.For() as node:
                todo += node.children
            case s.Wait() | s.WaitUntil() | s.CheckNode() | s.Fail() | s.ApplyPosts():
                pass


def names_declared_in(declaration: s.Declaration) -> Iterator[s.Name]:
    """Yield the name of a declaration, and those that its members declare."""
    yield declaration.name
    if isinstance(declaration, s.SkillDeclaration | s.ImplementationDeclaration):
        kinds = s.Parameter | s.Let | s.Refinement
        yield from (member.name for member in declaration.members if isinstance(member, kinds))
