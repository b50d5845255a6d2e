"""The MuJoCo model of a scene: how it is built, named and drawn."""
