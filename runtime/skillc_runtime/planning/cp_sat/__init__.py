"""CP-SAT of OR-Tools, in a process of its own: schedules with a short makespan. Start at `solver.CpSat`."""
