"""The members of a class, version by version, against plain sets."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from skillc_runtime.world.state.versioned import VersionedSet

NAMES = st.sampled_from([f"x{number}" for number in range(40)])


@settings(max_examples=50)
@given(st.frozensets(NAMES), st.lists(st.tuples(st.dictionaries(NAMES, st.booleans()), st.booleans()), max_size=12))
def test_every_version_has_its_members(base: frozenset[str], writes: list[tuple[dict[str, bool], bool]]) -> None:
    versions, expected = [VersionedSet(base)], [base]
    for changes, looked_at in writes:
        if looked_at:
            assert versions[-1].members() == expected[-1]
        versions.append(versions[-1].with_changes(changes))
        gone = {name for name, is_in in changes.items() if not is_in}
        expected.append(expected[-1] - gone | (changes.keys() - gone))
    assert [version.members() for version in versions] == expected and len(versions) == len(writes) + 1
    assert all(type(version.members()) is frozenset for version in versions)
