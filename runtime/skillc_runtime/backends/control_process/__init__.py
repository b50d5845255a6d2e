"""Controls an arm in a process of its own, at the rate of the device; `link` is what a back end implements."""
