"""Compiled and plain, the laws and everything under them compute the same."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from forms import everything

from skillc_runtime.motion.numerics.compiled import COMPILES

INPUTS = int(os.environ.get("SKILLC_LAW_INPUTS", "15"))


@pytest.mark.skipif(not COMPILES, reason="nothing is compiled here")
def test_both_forms_agree():
    script = Path(__file__).with_name("forms.py")
    environment = {**os.environ, "SKILLC_COMPILED": "0"}
    told = subprocess.run([sys.executable, script, str(INPUTS)], env=environment, capture_output=True, check=True)
    plain, here = json.loads(told.stdout), everything(INPUTS)
    assert plain.keys() == here.keys()
    for part, rows in plain.items():
        assert np.shape(rows)[0] == INPUTS
        scale = np.maximum(np.abs(rows), 1.0)
        assert (np.abs(np.array(here[part]) - rows) / scale).max() <= 1e-12, part
    assert not np.array_equal(plain["iiwa14"], np.zeros_like(plain["iiwa14"]))
