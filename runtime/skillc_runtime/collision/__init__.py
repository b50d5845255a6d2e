"""Joint motions that avoid the obstacles in the world model.

Start with `path_planning`; `collision_checker` checks postures in a `collision_model` of arm and scenery.
"""
