"""Signals of a run: numbers that are sampled, beside the events. Start at `sampler.SignalSampler`."""
