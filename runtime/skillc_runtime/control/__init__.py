"""Control laws: from what an arm measures and what it shall do to what it is told, once a control period."""
