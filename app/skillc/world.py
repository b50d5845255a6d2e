"""The world model and scenes: facts, versions, writes, individuals, conditions, vocabularies."""

from skillc.services.cell_checks.report import cell_diagnostics
from skillc.services.library.libraries import load_vocabulary
from skillc_dsl.source import Source
from skillc_model.conditions import Holds, Individual
from skillc_ontology import catalogue
from skillc_rdf.vocabulary.load import load
from skillc_runtime.scene.documents import Document
from skillc_runtime.scene.load import load_scene, load_sheets, read_scene
from skillc_runtime.scene.saving import save_scene
from skillc_runtime.scene.templates import load_templates
from skillc_runtime.world.eval.explain import explain
from skillc_runtime.world.state.changes import AddRelation, SetProperty
from skillc_runtime.world.state.data_sheet import SheetError, sheet_of
from skillc_runtime.world.state.elements import find_element, find_elements, search_elements
from skillc_runtime.world.state.facts import RelationFact
from skillc_runtime.world.state.model import WorldError, WorldModel
from skillc_runtime.world.state.names import NoSuchName
from skillc_runtime.world.state.provenance import Provenance
from skillc_runtime.world.state.terms import CONTAIN

__all__ = [
    "CONTAIN",
    "AddRelation",
    "Document",
    "Holds",
    "Individual",
    "NoSuchName",
    "Provenance",
    "RelationFact",
    "SetProperty",
    "SheetError",
    "Source",
    "WorldError",
    "WorldModel",
    "catalogue",
    "cell_diagnostics",
    "explain",
    "find_element",
    "find_elements",
    "load",
    "load_scene",
    "load_sheets",
    "load_templates",
    "load_vocabulary",
    "read_scene",
    "save_scene",
    "search_elements",
    "sheet_of",
]
