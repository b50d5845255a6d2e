"""Every test of this folder that takes `robot` runs with both arms."""

import pytest
from rig import LAWS


@pytest.fixture(params=sorted(LAWS))
def robot(request):
    return request.param
