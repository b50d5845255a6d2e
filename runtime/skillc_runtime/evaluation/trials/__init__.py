"""Many runs of one task with random variations, compared with targets.

Start at `experiment.TrialRunner` for one trial, `series.judge_series` for all, `targets` for the metrics.
"""
