"""A small vocabulary and scene that the tests of the world model and of planning share."""

from skillc_dsl.position import Position
from skillc_model.conditions import Condition, Holds, Variable
from skillc_model.skills import Parameter, Requirement
from skillc_rdf.vocabulary.types import (
    THING,
    ClassTerm,
    ClassType,
    FunctionTerm,
    NumberType,
    PlainType,
    PropertyTerm,
    RelationTerm,
    Signature,
    Vocabulary,
)
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, SetProperty
from skillc_runtime.world.state.world_state import WorldState

NS = "http://example.org/test#"
HERE = Position("test.skill", 1, 1)


def iri(name: str) -> str:
    """Return the IRI of a name of the test vocabulary."""
    return THING if name == "Thing" else NS + name


def cls(name: str, *parents: str, disjoint: tuple[str, ...] = ()) -> ClassTerm:
    """Make a class."""
    return ClassTerm(iri=iri(name), parents=tuple(map(iri, parents)), disjoint=tuple(map(iri, disjoint)))


def relation(
    name: str, domain: str, range_: str, *parents: str, inverse: str | None = None, **axioms: bool
) -> RelationTerm:
    """Make a relation with one signature."""
    return RelationTerm(
        iri=iri(name),
        signatures=(Signature(iri(domain), iri(range_)),),
        parents=tuple(map(iri, parents)),
        inverse=iri(inverse) if inverse else None,
        **axioms,
    )


CLASSES = (
    cls("Holder"),
    cls("Location", "Holder", disjoint=("Robot", "Product")),
    cls("Robot", "Holder"),
    cls("Arm", "Holder", disjoint=("Gripper",)),
    cls("CompliantArm", "Arm"),
    cls("Gripper", "Holder"),
    cls("WsgGripper", "Gripper"),
    cls("Product"),
    cls("Eraser", "Product"),
    cls("Board"),
)
RELATIONS = (
    relation("at", "Thing", "Location", functional=True, irreflexive=True),
    relation("contain", "Holder", "Thing", "within-it", inverse_functional=True, asymmetric=True, irreflexive=True),
    relation("containedIn", "Thing", "Holder", inverse="contain", functional=True),
    relation("hasA", "Thing", "Thing", "within-it", inverse_functional=True, asymmetric=True, irreflexive=True),
    relation("hasGripper", "Arm", "Gripper", "hasA", functional=True),
    relation("within-it", "Thing", "Thing", "near", transitive=True),
    relation("near", "Thing", "Thing"),
    relation("beside", "Location", "Location", symmetric=True),
)
PROPERTIES = (
    PropertyTerm(iri=iri("isClean"), domains=(iri("Board"),), type=PlainType("Bool")),
    PropertyTerm(iri=iri("weight"), domains=(iri("Product"),), type=NumberType("Mass")),
    PropertyTerm(iri=iri("label"), domains=(), type=PlainType("Text"), functional=False),
    PropertyTerm(iri=iri("state"), domains=(iri("Arm"),), type=PlainType("Text"), values=("Idle", "Fault")),
    PropertyTerm(
        iri=iri("load"), domains=(iri("Holder"),), type=PlainType("Int"), computed_by="world.lab:count_of_contents"
    ),
)
FUNCTIONS = (
    FunctionTerm(
        name="heavier", parameters=(("w", NumberType("Mass")),), result=NumberType("Mass"), python="world.lab:heavier"
    ),
    FunctionTerm(name="broken", parameters=(), result=NumberType("Mass"), python="world.lab:broken"),
)
VOCABULARY = Vocabulary(
    prefixes={"t": NS},
    classes={term.iri: term for term in CLASSES},
    relations={term.iri: term for term in RELATIONS},
    properties={term.iri: term for term in PROPERTIES},
    functions={term.name: term for term in FUNCTIONS},
)


def count_of_contents(state: WorldState, holder: str) -> int:
    """Compute the property `load`."""
    return len(state.objects(holder, iri("contain")))


def heavier(_state: WorldState, weight: float) -> float:
    """Compute the function `heavier`."""
    return weight + 1.0


def broken(_state: WorldState) -> float:
    """Fail, as the function `broken`."""
    raise RuntimeError("sensor unplugged")


def individual(name: str, *types: str) -> AddIndividual:
    """Add an individual of the test vocabulary."""
    return AddIndividual(iri(name), tuple(map(iri, types)))


def fact(subject: str, name: str, object_: str) -> AddRelation:
    """Add a relation between individuals of the test vocabulary."""
    return AddRelation(iri(subject), iri(name), iri(object_))


def assign(name: str, property_: str, value: object) -> SetProperty:
    """Set a property of an individual of the test vocabulary."""
    return SetProperty(iri(name), iri(property_), value)  # type: ignore[arg-type]


def holds(subject: str, name: str, object_: str) -> Holds:
    """Make the condition that a relation holds between two variables."""
    return Holds(Variable(subject), iri(name), Variable(object_))


def requirement(label: str, condition: Condition) -> Requirement:
    """Make a labelled precondition."""
    return Requirement(label=label, condition=condition, text=label, source=HERE)


def parameter(name: str, type_: str, direction: str = "infer", any_: bool = False) -> Parameter:
    """Make a parameter of a class of the test vocabulary."""
    return Parameter(name=name, direction=direction, type=ClassType(iri(type_)), any_=any_, source=HERE)  # type: ignore[arg-type]


SCENE = WorldState.empty(VOCABULARY).with_changes(
    (
        individual("shelf", "Location"),
        individual("table", "Location"),
        individual("robot", "Robot"),
        individual("arm", "CompliantArm"),
        individual("gripper", "WsgGripper"),
        individual("eraser", "Eraser"),
        individual("box", "Product"),
        individual("board", "Board"),
        fact("robot", "at", "table"),
        fact("robot", "hasA", "arm"),
        fact("arm", "hasGripper", "gripper"),
        fact("shelf", "contain", "eraser"),
        fact("table", "contain", "box"),
        fact("shelf", "beside", "table"),
        assign("box", "weight", 3),
        assign("arm", "state", "Idle"),
        assign("box", "label", ("red", "heavy")),
    )
)
