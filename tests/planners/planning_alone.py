"""A process that plans: `python planning_alone.py SEARCH-PROGRAM TRANSLATOR`; prints what came out."""

import sys

from planning.samples import CLEANED, LAB, WIPING
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.fast_downward.solver import FastDownward, Programs
from skillc_runtime.planning.problem.pose import pose_problem

search, translate = sys.argv[1:]
problem = pose_problem(WIPING, LAB, CLEANED).problem
print(FastDownward(Programs((translate,), search, (search,))).plan(problem, CancelToken(60.0)))
