"""From a plan, which is a list of steps, to a body that runs them, and a new plan when the world takes another turn."""
