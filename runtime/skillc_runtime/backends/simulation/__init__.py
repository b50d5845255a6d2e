"""What simulated cells share: the specification of a scene, how reality differs from it, its MuJoCo model and devices.

Start with `cell`; `scene_spec` reads the facts, `model_builder` builds the model, `variation` draws how it differs.
"""
