"""From a goal to a plan: the problem, the planners behind one seam, and the check of every plan."""
