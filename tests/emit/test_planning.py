"""The actions of the planning domain of a library: what becomes of conditions and effects, and what is left out."""

from __future__ import annotations

import msgspec
import pytest

from emit import samples
from emit.samples import DRIVE, PICK, WIPE, assign, holds, iri, library, need, number, parameter, post, read
from skillc_model.conditions import (
    And,
    Anything,
    Compare,
    Condition,
    Exists,
    Given,
    HasProperty,
    Holds,
    Literal,
    Not,
    Or,
    PropertyOf,
    Variable,
)
from skillc_model.pddl.domain import Action, GuardMeaning, RelationMeaning
from skillc_model.pddl.formulas import (
    Atom,
    Change,
    Equal,
    Negation,
    Typed,
    conjunction,
    conjuncts,
)
from skillc_model.pddl.planning import make_planning_domain
from skillc_model.skills import Post, Skill


def varied(skill: Skill, **changes: object) -> Skill:
    return msgspec.structs.replace(skill, **changes)


def action(skill: Skill, *others: Skill) -> Action:
    domain = make_planning_domain(library(skill, *others))
    assert not domain.excluded
    return next(each for each in domain.actions if each.skill == skill.name)


def reason(skill: Skill, *others: Skill) -> str:
    domain = make_planning_domain(library(skill, *others))
    return next(each.reason for each in domain.excluded if each.skill == skill.name)


def with_pre(skill: Skill, condition: Condition) -> Skill:
    return varied(skill, pre=(need("tested", condition),))


def test_the_former_value_is_deleted_plainly_where_the_precondition_names_it() -> None:
    assert action(DRIVE).effects == (
        Change(Atom("core-at", ("?robot", "?to")), True),
        Change(Atom("core-at", ("?robot", "?from")), False),
    )


def test_the_former_value_is_searched_for_where_the_precondition_does_not_name_it() -> None:
    blind = varied(DRIVE, pre=(), parameters=DRIVE.parameters[:2])
    former = Typed("?former", "place")
    old = Atom("core-at", ("?robot", "?former"))
    assert action(blind).effects == (
        Change(Atom("core-at", ("?robot", "?to")), True),
        Change(old, False, (former,), old),
    )


def test_nothing_is_deleted_where_the_precondition_says_that_there_is_no_former_value() -> None:
    nowhere = Not(Holds(Variable("robot"), iri("at"), Anything()))
    placed = varied(DRIVE, parameters=DRIVE.parameters[:2], pre=(need("nowhere", nowhere),))
    assert action(placed).effects == (Change(Atom("core-at", ("?robot", "?to")), True),)


def test_what_is_excluded_of_one_kind_only_leaves_others_to_be_deleted() -> None:
    x = Variable("x")
    nowhere = Not(Exists("x", iri("Place"), And((Holds(Variable("robot"), iri("at"), x), Holds(x, iri("at"), x)))))
    placed = varied(DRIVE, parameters=DRIVE.parameters[:2], pre=(need("nowhere", nowhere),))
    assert any(not each.positive and each.variables for each in action(placed).effects)


def test_the_former_holder_is_deleted_even_if_no_post_says_so() -> None:
    silent = varied(PICK, post=PICK.post[:1])
    assert Change(Atom("contain", ("?from", "?the-object")), False) in action(silent).effects


def test_an_inverse_is_the_same_predicate_with_its_sides_exchanged() -> None:
    turned = varied(PICK, post=(post("held", "object containedIn gripper"),))
    assert action(turned).effects == action(varied(PICK, post=PICK.post[:1])).effects


def test_a_condition_on_a_relation_reads_its_changing_subrelations() -> None:
    mount = Skill(
        name="Mount",
        parameters=(parameter("arm", "Arm"), parameter("gripper", "Gripper")),
        post=(post("mounted", "arm hasGripper gripper"),),
        implementations=("screws",),
        source=samples.HERE,
    )
    take = varied(PICK, name="Take", pre=(need("tested", holds("arm hasA gripper")),))
    reads = conjuncts(action(take, mount).precondition)
    assert {each.predicate for each in reads[0].parts} == {"has-a", "has-gripper"}  # type: ignore[union-attr]
    no_arm = conjuncts(action(with_pre(DRIVE, holds("robot hasA to")), mount).precondition)
    assert no_arm[0] == Atom("has-a", ("?robot", "?to"))
    domain = make_planning_domain(library(mount))
    assert domain.predicate["has-a"].meaning == RelationMeaning(iri("hasA"), ((iri("hasGripper"), False),))


def test_a_transitive_relation_is_unrolled_where_skills_change_what_it_follows_from() -> None:
    static = with_pre(DRIVE, holds("robot holdsDeep to"))
    moving = str(action(static, PICK).precondition)
    assert "holds-deep-always" in moving and "contain" in moving and "'holds-deep'" not in moving
    assert Atom("holds-deep", ("?robot", "?to")) in conjuncts(action(static).precondition)


def test_an_enumerated_property_has_a_predicate_per_value() -> None:
    soften = Skill(
        name="Soften",
        parameters=(parameter("arm", "Arm"),),
        pre=(need("stiff", Compare(read("arm", "mode"), "!=", Literal("Soft"))),),
        post=(assign("soft", "arm", "mode", "Soft"),),
        implementations=("slowly",),
        source=samples.HERE,
    )
    made = action(soften)
    assert made.precondition == Atom("mode-stiff", ("?arm",))
    assert made.effects == (
        Change(Atom("mode-soft", ("?arm",)), True),
        Change(Atom("mode-stiff", ("?arm",)), False),
    )


def test_what_nothing_changes_becomes_a_guard_with_defaults_put_in() -> None:
    domain = make_planning_domain(library(PICK))
    meaning = domain.predicate["guard-pick-light"].meaning
    assert isinstance(meaning, GuardMeaning)
    assert meaning.variables == ("object",)
    assert meaning.condition == Compare(PropertyOf(Variable("object"), iri("weight")), "<=", Literal(2.0))


def test_an_unset_optional_parameter_counts_as_not_given() -> None:
    unset = number("limit")
    light = Compare(read("object", "weight"), "<=", Variable("limit"))
    guarded = varied(
        PICK,
        parameters=(*PICK.parameters[:-1], unset),
        pre=(*PICK.pre[:-1], need("light", Or((Not(Given("limit")), light)))),
    )
    assert [each.name for each in make_planning_domain(library(guarded)).predicates if "light" in each.name] == []
    unguarded = varied(guarded, pre=(*PICK.pre[:-1], need("light", light)))
    assert "reads `limit`" in reason(unguarded)


def test_implementations_stand_in_the_precondition_by_their_types_and_conditions() -> None:
    two = varied(WIPE, implementations=("lanes", "spot"))
    free = need("spotless", Not(holds("gripper contain _")), "not gripper contain _")
    made = make_planning_domain(
        library(
            two,
            implementations=(
                samples.implementation(two, "lanes", arm="CompliantArm"),
                samples.implementation(two, "spot", free, robot="MobileRobot"),
            ),
        )
    )
    choice = conjuncts(made.action["wipe"].precondition)[-1]
    assert Atom("is-compliant-arm", ("?arm",)) in choice.parts  # type: ignore[union-attr]
    without_demands = library(two)
    assert make_planning_domain(without_demands).action["wipe"].precondition == action(WIPE).precondition


def test_a_class_with_several_parents_is_a_type_below_one_and_a_predicate_for_the_other() -> None:
    carry = Skill(
        name="Carry",
        parameters=(parameter("holder", "Holder"), parameter("thing", "Product")),
        post=(post("held", "holder contain thing"),),
        implementations=("by_hand",),
        source=samples.HERE,
    )
    made = action(carry)
    assert made.parameters[0].type == "item"
    itself = Negation(Equal("?holder", "?the-thing"))
    assert made.precondition == conjunction((Atom("is-holder", ("?holder",)), itself)), "contain is asymmetric"
    assert make_planning_domain(library(carry)).type_of([iri("Robot"), iri("Device")]) == "robot"


def test_individuals_of_several_classes_widen_the_types_of_parameters() -> None:
    both = frozenset({iri("Surface"), iri("Place")})
    domain = make_planning_domain(library(DRIVE), [both])
    place_or_surface = domain.type_of(both)
    drive = domain.action["drive"]
    assert all(domain.is_a(place_or_surface, each.type) for each in drive.parameters if each.name != "?robot")


LEFT_OUT = {
    "a number to choose": (varied(PICK, parameters=(*PICK.parameters, number("force", "in"))), "`force` is no thing"),
    "no effect": (varied(PICK, post=()), "it changes nothing"),
    "no implementation": (varied(PICK, implementations=()), "no implementation"),
    "never possible": (with_pre(DRIVE, Or(())), "can never hold"),
    "a hold that the effect ends": (
        varied(DRIVE, hold=(need("stay", holds("robot at from"), "robot at from"),)),
        "undo what its hold conditions keep",
    ),
}


@pytest.mark.parametrize("case", LEFT_OUT)
def test_what_a_planner_cannot_reason_about_is_left_out_with_the_reason(case: str) -> None:
    skill, words = LEFT_OUT[case]
    assert words in reason(skill)


@pytest.mark.parametrize(
    "condition",
    [Compare(read("surface", "weight"), ">=", Literal(1.0)), HasProperty(Variable("surface"), iri("weight"))],
    ids=["compared", "there"],
)
def test_a_measured_number_is_not_taken_for_static(condition: Condition) -> None:
    measured = Post(label="m", condition=condition, effects=(), sensed=True, text="m", source=samples.HERE)
    weigh = varied(WIPE, name="Weigh", post=(*WIPE.post, measured))
    assert "`core:weight`" in reason(PICK, weigh)
    assert make_planning_domain(library(PICK)).excluded == ()


def test_skills_kept_out_of_planning_are_not_listed() -> None:
    domain = make_planning_domain(library(varied(PICK, planned=False), DRIVE))
    assert [each.skill for each in domain.actions] == ["Drive"]
    assert domain.excluded == ()


def test_a_statement_displaces_other_values_only() -> None:
    mount = varied(PICK, name="Mount", pre=(), post=(post("mounted", "arm hasGripper gripper"),))
    old, former = Atom("has-a", ("?former", "?gripper")), Typed("?former", "item")
    other = Negation(Equal("?former", "?arm"))
    assert Change(old, False, (former,), conjunction((old, other))) in action(mount).effects


def test_what_an_axiom_forbids_is_ruled_out_before() -> None:
    hold = Skill(
        name="Nest",
        parameters=(parameter("outer", "Holder"), parameter("inner", "Holder")),
        post=(post("nested", "outer contain inner"), post("free", "inner contain outer", positive=False)),
        implementations=("by_hand",),
        source=samples.HERE,
    )
    apart = Negation(Equal("?inner", "?outer"))
    assert apart in conjuncts(action(hold).precondition), "else the second post undoes the first"
    bare = varied(hold, post=hold.post[:1])
    opposite = Negation(Atom("contain", ("?inner", "?outer")))
    either = conjuncts(action(bare).precondition)[-1]
    assert opposite in getattr(either, "parts", (either,)), "asymmetric"


def test_posts_that_exclude_each_other_are_left_out_as_impossible() -> None:
    torn = varied(DRIVE, post=(*DRIVE.post, post("away", "robot at to", positive=False)))
    (left_out,) = make_planning_domain(library(torn)).excluded
    assert left_out.impossible and left_out.reason == "its postconditions contradict each other or an axiom"


def test_the_same_condition_on_other_things_is_another_guard() -> None:
    heavy = Compare(read("x", "weight"), ">=", Literal(1.0))
    each = [Exists("x", iri(cls), And((holds("robot at to"), heavy))) for cls in ("Product", "Surface")]
    domain = make_planning_domain(library(with_pre(DRIVE, And(tuple(each)))))
    guards = [each for each in domain.predicates if isinstance(each.meaning, GuardMeaning)]
    assert sorted(each.parameters[0].type for each in guards) == ["product", "surface"]
