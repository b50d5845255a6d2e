; Hoists stack crates on pallets, trucks carry them between places.
(define (domain depot)
  (:requirements :strips :typing)
  (:types place thing - object
          truck hoist surface - thing
          pallet crate - surface)
  (:predicates (at ?x - thing ?p - place) (on ?x - crate ?y - surface) (in ?x - crate ?t - truck)
               (lifting ?h - hoist ?x - crate) (available ?h - hoist) (clear ?y - surface))

  (:action drive
    :parameters (?t - truck ?from ?to - place)
    :precondition (at ?t ?from)
    :effect (and (at ?t ?to) (not (at ?t ?from))))

  (:action lift
    :parameters (?h - hoist ?x - crate ?y - surface ?p - place)
    :precondition (and (at ?h ?p) (available ?h) (at ?x ?p) (on ?x ?y) (clear ?x))
    :effect (and (lifting ?h ?x) (clear ?y) (not (at ?x ?p)) (not (clear ?x)) (not (available ?h)) (not (on ?x ?y))))

  (:action lower
    :parameters (?h - hoist ?x - crate ?y - surface ?p - place)
    :precondition (and (at ?h ?p) (at ?y ?p) (clear ?y) (lifting ?h ?x))
    :effect (and (available ?h) (at ?x ?p) (clear ?x) (on ?x ?y) (not (lifting ?h ?x)) (not (clear ?y))))

  (:action load
    :parameters (?h - hoist ?x - crate ?t - truck ?p - place)
    :precondition (and (at ?h ?p) (at ?t ?p) (lifting ?h ?x))
    :effect (and (in ?x ?t) (available ?h) (not (lifting ?h ?x))))

  (:action unload
    :parameters (?h - hoist ?x - crate ?t - truck ?p - place)
    :precondition (and (at ?h ?p) (at ?t ?p) (available ?h) (in ?x ?t))
    :effect (and (lifting ?h ?x) (not (in ?x ?t)) (not (available ?h)))))
