"""Many runs of one task with random variations, compared with targets.

Start at `experiment.TrialRunner` for one trial, `dispatch.run_on` for many, `judging.judge_series` for their sum,
`targets` for the metrics.
"""
