"""What each construct of PDDL becomes: a domain with it, and the lines of the library that say it."""

from __future__ import annotations

from pathlib import Path

import pytest

from skillc.errors import DiagnosticsError, RequestError
from skillc.services.pddl_import.importing import Imported, import_pddl

HEAD = "(:types disc peg - thing) (:predicates (on ?x - disc ?y - thing) (clear ?x - thing) (done)"
MOVE = "(:action move :parameters (?d - disc ?to - thing)"
OBJECTS = "(:objects d1 d2 - disc p1 - peg)"


def written(folder: Path, domain: str, problem: str = "") -> tuple[Imported, str]:
    """Import texts, and return what was said of them with all files that were written, joined."""
    (folder / "domain.pddl").write_text(f"(define (domain towers)\n{domain})", "utf-8")
    files = [folder / "domain.pddl", None]
    if problem:
        files[1] = folder / "problem.pddl"
        files[1].write_text(f"(define (problem first-one) (:domain towers)\n{problem})", "utf-8")
    assert files[0] is not None
    imported = import_pddl(files[0], files[1], folder / "towers")
    texts = (path.read_text("utf-8") for path in imported.files)
    return imported, "\n".join(" ".join(line.split()) for text in texts for line in text.splitlines())


@pytest.mark.parametrize(
    ("domain", "lines"),
    [
        ("", ["class ThingType < sumo:Object # thing", "class Disc < ThingType", "relation on(Disc, ThingType)"]),
        ("", ["property clear(ThingType): Bool", "property done(World): Bool"]),
        (f"{MOVE} :precondition (on ?d ?to) :effect (not (on ?d ?to)))", ["pre d on to", "post not d on to"]),
        (f"{MOVE} :effect (and (done) (clear ?d)))", ["post lab:World-1.done == true", "post d.clear == true"]),
        (f"{MOVE} :effect (and (not (clear ?d)) (clear ?d)))", ["post d.clear == true\n}"]),
        (
            f"{MOVE} :precondition (or (clear ?d) (not (and (done) (clear ?to)))) :effect (done))",
            ["pre d.clear == true or not (lab:World-1.done == true and to.clear == true)"],
        ),
        (
            f"{MOVE} :precondition (imply (clear ?d) (forall (?x - peg) (not (= ?x ?to)))) :effect (done))",
            ["pre d.clear == true implies forall x: Peg (not x == to)"],
        ),
        (
            f"{MOVE} :precondition (exists (?x - peg ?y - disc) (on ?y ?x)) :effect (done))",
            ["pre exists x: Peg, y: Disc (y on x)"],
        ),
        (
            f"{MOVE} :effect (forall (?x - disc) (when (on ?x ?to) (and (clear ?x) (not (on ?x ?to))))))",
            ["post forall x: Disc (x.clear == true and not x on to when x on to)"],
        ),
        (
            f"{MOVE} :effect (when (done) (clear ?to)))",
            ["post forall each: ThingType (each.clear == true when each == to and lab:World-1.done == true)"],
        ),
        (
            "(:action Pick-Up :parameters (?in-hand ?post - disc) :effect (clear ?post))",
            ["## `Pick-Up`", "skill PickUp {", "in in_hand: Disc # ?in-hand", "in post1: Disc # ?post"],
        ),
        (
            "(:action go :parameters (?x - (either disc peg)) :effect (clear ?x))",
            ["class DiscOrPeg < ThingType # (either disc peg)", "class Disc < ThingType, DiscOrPeg", "in x: DiscOrPeg"],
        ),
        (
            "(:constants best - disc) (:action go :parameters () :effect (clear best))",
            ["post lab:Best.clear == true", 'lab:Best a towers:Disc ; rdfs:label "best" .'],
        ),
        (
            "(:functions (total-cost) (size ?x - disc)) (:action go :parameters (?x - disc) :precondition (> (size "
            "?x) 2) "
            ":effect (and (clear ?x) (increase (total-cost) (+ 1 (* 2 (size ?x))))))",
            ["property size(Disc): Number", "pre x.size > 2", "cost 1 + 2 * x.size"],
        ),
        (
            "(:functions (way ?x ?y - peg)) (:durative-action go :parameters (?x ?y - peg) :duration (= ?duration "
            "(way ?x ?y)) "
            ":condition (and (at start (clear ?x)) (over all (done))) :effect (and (at start (not (clear ?x))) (at "
            "end (clear ?y))))",
            [
                "infer way: Way",
                "pre way wayX x",
                "pre way wayY y",
                "pre x.clear == true",
                "hold lab:World-1.done == true",
                "post x.clear == false",
                "post y.clear == true",
                "duration way.wayValue * 1 s",
            ],
        ),
        (
            "(:durative-action go :parameters (?x - peg) :duration (= ?duration 2.5) :condition (at start (clear ?x)) "
            ":effect (and (at start (not (clear ?x))) (at end (clear ?x)) (at end (done))))",
            ["uses x", "duration 2.5 s"],
        ),
        (
            "(:predicates (above ?x ?y - disc) (free ?x - disc)) (:derived (free ?x - disc) (not (exists (?y - "
            "disc) (above ?y ?x)))) "
            "(:derived (above ?x ?y - disc) (or (on ?x ?y) (exists (?z - disc) (and (on ?x ?z) (above ?z ?y)))))",
            [
                "relation above(x: Disc, y: Disc) = x on y or exists z: Disc (x on z and z above y)",
                "relation free(x: Disc, world: World) = not exists y: Disc (y above x)",
            ],
        ),
        (
            "(:functions (size ?x - disc) (way ?x ?y - disc) (turns)) "
            "(:action go :parameters (?x ?y - disc) :effect (and "
            "(increase (size ?x) (+ 1 (size ?y))) (decrease (way ?x ?y) 2) (assign (turns) 0) (scale-up (size ?y) 2)))",
            [
                "infer way: Way",
                "post x.size += 1 + y.size",
                "post way.wayValue -= 2",
                "post lab:World-1.turns := 0",
                "post y.size := y.size * 2",
            ],
        ),
        (
            "(:functions (size ?x - disc)) "
            "(:action go :parameters (?p - peg) :effect (forall (?x - disc) (when (on ?x ?p) "
            "(increase (size ?x) 1))))",
            ["post forall x: Disc (x.size += 1 when x on p)"],
        ),
        (
            "(:functions (heat ?x - disc)) "
            "(:durative-action go :parameters (?x - disc) :duration (= ?duration 4) :condition "
            "(over all (done)) :effect (and (at start (decrease (heat ?x) (* 3 ?duration))) "
            "(at end (increase (heat ?x) 1))))",
            ["post x.heat -= 3 * 4 - 1", "duration 4 s"],
        ),
        (
            "(:predicates (fits ?x ?y ?z - disc)) (:action go :parameters (?x - disc) :precondition (not (fits ?x "
            "?x ?x)) "
            ":effect (fits ?x ?x ?x))",
            [
                "property fitsHolds(Fits): Bool",
                "infer fits2: Fits",
                "pre fits2 fitsX x",
                "post fits2.fitsHolds == true",
            ],
        ),
    ],
)
def test_it_is_said(domain: str, lines: list[str], tmp_path: Path) -> None:
    imported, text = written(tmp_path, f"{HEAD})\n{domain}")
    assert not imported.warnings
    for line in lines:
        assert line in text


def test_a_problem_is_a_scene_and_a_task(tmp_path: Path) -> None:
    problem = (
        "(:init (on d1 p1) (clear d1) (= (total-cost) 0) (= (size d2) 3)) (:goal (and (clear p1) (not (on d1 p1))))"
    )
    domain = "(:functions (total-cost) (size ?x - disc)) " + f"{MOVE} :effect (increase (total-cost) 3))"
    _, text = written(tmp_path, f"{HEAD}) {domain}", f"{OBJECTS} {problem} (:metric minimize (total-cost))")
    for line in (
        "task first_one {",
        "goal lab:P-1.clear == true and not lab:D-1 on lab:P-1",
        'lab:D-1 a towers:Disc ; rdfs:label "d1" ; towers:on lab:P-1 ; towers:clear true .',
        'lab:D-2 a towers:Disc ; rdfs:label "d2" ; towers:size 3 .',
        'task = "first_one"',
        "cost 3",
        "minimise cost",
    ):
        assert line in text
    assert "duration" not in text


def test_a_duration_stays_beside_the_cost(tmp_path: Path) -> None:
    timed = MOVE.replace(":action", ":durative-action") + " :duration (= ?duration 2)"
    domain = (
        f"{HEAD}) (:functions (total-cost)) {timed} :effect (and (at end (done)) (at end (increase (total-cost) 3))))"
    )
    imported, text = written(tmp_path, domain, f"{OBJECTS} (:init) (:goal (done)) (:metric minimize (total-time))")
    assert not imported.warnings
    assert "duration 2 s" in text and "cost 3" in text and "minimise makespan" in text


def test_a_metric_is_of_the_task_alone(tmp_path: Path) -> None:
    domain = f"{HEAD}) (:functions (total-cost)) {MOVE} :effect (and (done) (increase (total-cost) 3)))"
    _, text = written(tmp_path, domain, f"{OBJECTS} (:init) (:goal (done))")
    assert "cost 3" in text and "minimise" not in text


@pytest.mark.parametrize(
    ("domain", "problem", "words", "left"),
    [
        (
            f"{MOVE} :effect (oneof (done) (clear ?d)))",
            "",
            "`oneof` is not in the library",
            "# not imported: (oneof (done)",
        ),
        (
            f"{MOVE} :precondition (preference a (done)) :effect (done))",
            "",
            "a preference is",
            "# not imported: (preference",
        ),
        (
            f"{MOVE} :effect (forall (?x ?y - disc) (on ?x ?y)))",
            "",
            "has two variables of `forall`",
            "# not imported: (on",
        ),
        (
            "(:functions (size ?x - disc)) "
            "(:durative-action go :parameters (?x - disc) :duration (= ?duration 4) :condition "
            "(over all (done)) :effect (and (at start (decrease (size ?x) 1)) (at end (increase (size ?x) 1))))",
            "",
            "is the same at the end",
            "# not imported: (decrease (size ?x) 1)",
        ),
        (
            "(:functions (size ?x - disc)) "
            "(:action go :parameters (?x - disc) :effect (and (assign (size ?x) 1) (increase "
            "(size ?x) 1)))",
            "",
            "changes twice",
            "# not imported: (assign (size ?x) 1)",
        ),
        ("(:constraints (always (done)))", "", "only its end counts", ""),
        ("(:functions (top ?x - peg) - disc)", "", "a function whose value is an object", ""),
        (
            "(:durative-action go :parameters () :duration (and (>= ?duration 2) (<= ?duration 4)) :condition (at "
            "end (clear p1)) "
            ":effect (at end (done))) (:constants p1 - peg)",
            "",
            "the shortest duration is taken",
            "hold lab:P-1.clear == true",
        ),
        ("", "(:init (at 5 (done))) (:goal (done))", "what becomes so at a time", ""),
        (
            "",
            "(:init) (:goal (and (done) (preference a (clear d1))))",
            "a preference is",
            "goal lab:World-1.done == true",
        ),
        (
            "(:functions (size ?x - disc))",
            "(:init) (:goal (done)) (:metric maximize (size d1))",
            "cannot minimise or maxim",
            "",
        ),
    ],
)
def test_what_cannot_be_said_is_a_warning_at_its_place(
    domain: str, problem: str, words: str, left: str, tmp_path: Path
) -> None:
    imported, text = written(tmp_path, f"{HEAD})\n{domain}", problem and f"{OBJECTS}\n{problem}")
    assert {each.name for each in imported.warnings} == {"not-imported"}
    found = [each for each in imported.warnings if words in each.message]
    assert found and left in text
    path = Path(found[0].span.path)
    assert path.read_text("utf-8").splitlines()[found[0].span.line - 1][found[0].span.column - 1] == "("


@pytest.mark.parametrize(
    ("domain", "problem", "place", "words"),
    [
        ("(:predicates (on ?x)", "", (1, 1), "this `(` is never closed"),
        ("))", "", (2, 2), "this `)` closes nothing"),
        ("(:typs disc)", "", (2, 1), "`:typs` is no section of a domain"),
        ("(:types a - b b - a)", "", (2, 15), "is above itself"),
        ("(:predicates (on ?x - dics))", "", (2, 23), "there is no type `dics`"),
        ("(:predicates (on ?x) (on ?y))", "", (2, 22), "`on` is declared twice"),
        ("(:predicates (on x))", "", (2, 18), "a variable begins with `?`"),
        ("(:predicates (on ?x)) (:action go :effect (onn))", "", (2, 43), "there is no predicate `onn`"),
        ("(:predicates (on ?x)) (:action go :effect (on))", "", (2, 43), "`on` has 1 parameter, not 0"),
        ("(:predicates (on ?x)) (:action go :effect (on ?y))", "", (2, 47), "there is no variable `?y`"),
        ("(:predicates (on ?x)) (:action go :efect (on a))", "", (2, 35), "`:efect` is no part of `go`"),
        ("(:predicates (on ?x)) (:action go :effect (on a))", "", (2, 47), "there is no object `a`"),
        ("(:predicates (on ?x)) (:action go :precondition (> (size) 2) :effect ())", "", (2, 52), "no function `size`"),
        ("(:predicates (a ?x)) (:durative-action go :condition (a b) :effect ())", "", (2, 54), "when it has to hold"),
        (
            "(:types t u) (:predicates (a ?x - t)) (:action go :parameters (?y - u) :effect (a ?y))",
            "",
            (2, 83),
            "`?y` is of the type `u`, and `a` is of `t` here",
        ),
        ("(:predicates (a))", "(:init (b)) (:goal (a))", (2, 8), "there is no predicate `b`"),
        ("(:predicates (a))", "(:init (a)) (:gaol (a))", (2, 13), "`:gaol` is no part of a problem"),
        ("(:predicates (a)) (:derived (a) (a))", "(:init (a)) (:goal (a))", (2, 8), "`a` is derived"),
        (5 * "(" + 300 * "(:", "", (2, 394), "nested deeper than 200 levels"),
    ],
)
def test_an_error_has_its_place_and_nothing_is_written(
    domain: str, problem: str, place: tuple[int, int], words: str, tmp_path: Path
) -> None:
    with pytest.raises(DiagnosticsError) as raised:
        written(tmp_path, domain, problem)
    found = raised.value.diagnostics[0]
    assert (found.name, found.span.line, found.span.column) == ("broken-pddl", *place)
    assert words in found.message
    assert not (tmp_path / "towers").exists()


def test_all_errors_are_reported_at_once(tmp_path: Path) -> None:
    with pytest.raises(DiagnosticsError) as raised:
        written(
            tmp_path, f"{HEAD}) {MOVE} :effect (and (dnoe) (clear))) {MOVE} :precondition (on ?d) :effect (cler ?d))"
        )
    assert [each.span.column for each in raised.value.diagnostics] == sorted(
        each.span.column for each in raised.value.diagnostics
    )
    assert len(raised.value.diagnostics) == 4


@pytest.mark.parametrize(("name", "words"), [("none.pddl", "is missing"), (".", "is a folder")])
def test_what_is_no_file_is_said(name: str, words: str, tmp_path: Path) -> None:
    with pytest.raises(RequestError, match=words):
        import_pddl(tmp_path / name, None, None)


def test_a_folder_that_exists_stays_as_it_is(tmp_path: Path) -> None:
    (tmp_path / "towers").mkdir()
    with pytest.raises(RequestError, match="already exists"):
        written(tmp_path, f"{HEAD})")


def test_a_problem_in_the_place_of_a_domain_is_said(tmp_path: Path) -> None:
    (tmp_path / "p.pddl").write_text("(define (problem p) (:domain d))", "utf-8")
    with pytest.raises(DiagnosticsError, match="this is a problem, and a domain is expected here"):
        import_pddl(tmp_path / "p.pddl", None, tmp_path / "out")


@pytest.mark.parametrize(
    ("action", "said"),
    [
        (":precondition (>= (size ?x) 2) :effect (decrease (size ?x) 2)", "Number range 0 .. 5"),
        (":precondition (< (size ?x) 7) :effect (increase (size ?x) (step))", "Number range 3 .. 10"),
        (":precondition (<= (+ (step) (size ?x)) (most)) :effect (increase (size ?x) (step))", "Number range 3 .. 9"),
        (":precondition (> (size ?x) 1) :effect (decrease (size ?x) (- (size ?x) 1))", "Number range 1 .. 5"),
        (":effect (assign (size ?x) (most))", "Number range 3 .. 9"),
        (":effect (increase (size ?x) (step))", "Number"),
        (":precondition (>= (size ?x) 2) :effect (decrease (size ?x) (none))", "Number range 3 .. 5"),
        (":precondition (or (>= (size ?x) 2) (done)) :effect (decrease (size ?x) 2)", "Number"),
        (":precondition (<= (* 2 (size ?x)) (most)) :effect (scale-up (size ?x) 2)", "Number range 3 .. 9"),
    ],
)
def test_what_actions_need_bounds_what_they_change(action: str, said: str, tmp_path: Path) -> None:
    functions = "(:functions (size ?x - disc) (step) (most) (none))"
    init = "(= (size d1) 3) (= (size d2) 5) (= (step) 3) (= (most) 9)"
    domain = f"{HEAD}) {functions} (:action go :parameters (?x - disc) {action})"
    _, text = written(tmp_path, domain, f"{OBJECTS} (:init {init}) (:goal (done))")
    assert f"property size(Disc): {said}\n" in text
