"""How good each kind of work was, judged by what the simulator knows: a module a kind, results in `work`."""
