"""How candidates are chosen: the samplers of Optuna, and what they draw from."""

from __future__ import annotations

import warnings
from importlib.util import find_spec
from typing import Any, assert_never

from skillc.contract.learning import SamplerName
from skillc.errors import RequestError
from skillc.services.learning.parameters import Learnable

STARTS = 10
"""How many candidates are random before a sampler uses what is known, unless few are wanted."""


def make_distribution(optuna: Any, each: Learnable) -> Any:
    """Return from what a parameter is drawn, a distribution of Optuna, in the unit of its author."""
    if each.whole:
        return optuna.distributions.IntDistribution(int(each.low), int(each.high), log=each.is_logarithmic)
    return optuna.distributions.FloatDistribution(each.low, each.high, log=each.is_logarithmic)


def require_sampler(sampler: SamplerName) -> None:
    """Raise RequestError if what a sampler needs is not installed."""
    if sampler == "gp" and (missing := [name for name in ("torch", "scipy") if find_spec(name) is None]):
        raise RequestError(f"the sampler `gp` needs {' and '.join(missing)}: pip install {' '.join(missing)}")


def make_sampler(optuna: Any, sampler: SamplerName, wanted: int, seed: int) -> Any:
    """Return a sampler of Optuna for so many candidates."""
    samplers, starts = optuna.samplers, max(2, min(STARTS, wanted // 4))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of what is experimental in it
        match sampler:
            case "tpe":
                return samplers.TPESampler(multivariate=True, constant_liar=True, n_startup_trials=starts, seed=seed)
            case "nsga2":
                return samplers.NSGAIISampler(population_size=max(4, min(50, wanted // 5)), seed=seed)
            case "gp":
                return samplers.GPSampler(n_startup_trials=starts, seed=seed)
            case "random":
                return samplers.RandomSampler(seed=seed)
            case _:
                assert_never(sampler)
