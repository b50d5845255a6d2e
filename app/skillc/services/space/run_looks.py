"""How runs look at their plans in space: from where the devices are, and with what earlier looks have found."""

from __future__ import annotations

from typing import TYPE_CHECKING

from skillc.services.library.answer_store import digest_parts, installation_digest
from skillc.services.library.check_inputs import digest_modules
from skillc.services.library.modules import find_modules
from skillc.services.planning.plan_cache import FolderPlanCache
from skillc_dsl import cache
from skillc_model.skills import SkillLibrary
from skillc_ontology.catalogue import user_models
from skillc_runtime.execution.refinement.look_memory import LookMemory
from skillc_runtime.execution.refinement.run_planning import Postures, SpaceLook, measure_postures

if TYPE_CHECKING:
    from skillc_runtime.devices.cell import Cell


def look_from_home(library: SkillLibrary, use_cache: bool = True) -> SpaceLook:
    """Return how plans are looked at that begin with all arms at home."""
    return SpaceLook(None, _open_memory(library) if use_cache else None)


def look_from_postures(postures: Postures | None, library: SkillLibrary) -> SpaceLook:
    """Return how plans are looked at that begin with arms in postures, each (nv,) in rad by IRI; None for home."""
    return SpaceLook(postures, _open_memory(library))


def look_from(cell: Cell, library: SkillLibrary, use_cache: bool = True) -> SpaceLook:
    """Return how plans are looked at that begin with the arms of a cell where they are now."""
    return SpaceLook(measure_postures(cell), _open_memory(library) if use_cache else None)


def _open_memory(library: SkillLibrary) -> LookMemory | None:
    """Return where looks are kept, in the user's cache folder; None if there is none."""
    folder = cache.cache_folder()
    if folder is None:
        return None
    models = (part for model in user_models() for part in (str(model), model.read_bytes()))
    around = digest_parts((installation_digest(), *models, *digest_modules(find_modules(library))))
    return LookMemory(FolderPlanCache(folder / "looks"), around)
