; Loaves are baked, at each of which an oven cools down by what it takes to bake it.
(define (domain ovens)
  (:requirements :typing :numeric-fluents :durative-actions)
  (:types oven loaf)
  (:predicates (baked ?l - loaf) (free ?o - oven))
  (:functions (heat ?o - oven) (most-heat ?o - oven) (minutes ?l - loaf))
  (:durative-action bake
    :parameters (?l - loaf ?o - oven)
    :duration (= ?duration (minutes ?l))
    :condition (and (at start (free ?o)) (at start (>= (heat ?o) (* 2 (minutes ?l)))))
    :effect (and (at start (not (free ?o))) (at end (free ?o)) (at end (baked ?l))
                 (at start (decrease (heat ?o) (* 2 ?duration)))))
  (:durative-action heat-up
    :parameters (?o - oven)
    :duration (= ?duration 5)
    :condition (at start (free ?o))
    :effect (and (at start (not (free ?o))) (at end (free ?o)) (at end (assign (heat ?o) (most-heat ?o))))))
