"""How good each kind of work was, judged by what the simulator knows; which kind it is, the world model says."""
