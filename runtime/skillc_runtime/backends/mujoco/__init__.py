"""The simulated cell: a MuJoCo model built from the facts of a scene, its devices, recording and ground truth.

Start with `cell`; `scene_spec` reads the facts, `model_builder` builds the model, `variation` draws how it differs.
"""
