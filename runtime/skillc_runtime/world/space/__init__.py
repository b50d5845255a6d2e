"""Space: poses in the world, bounding boxes, reach and surfaces, computed from facts. Start at `frames`.

`frame_tree` computes and caches poses; `reasoners` decide spatial relations.
"""
