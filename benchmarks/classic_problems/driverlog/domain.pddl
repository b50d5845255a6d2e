; Drivers walk on paths and drive trucks on roads; trucks carry packages.
(define (domain driverlog)
  (:requirements :strips :typing)
  (:types place movable - object
          driver truck package - movable)
  (:predicates (at ?x - movable ?p - place) (in ?x - package ?t - truck) (driving ?d - driver ?t - truck)
               (road ?x ?y - place) (path ?x ?y - place) (empty ?t - truck))

  (:action load
    :parameters (?x - package ?t - truck ?p - place)
    :precondition (and (at ?t ?p) (at ?x ?p))
    :effect (and (in ?x ?t) (not (at ?x ?p))))

  (:action unload
    :parameters (?x - package ?t - truck ?p - place)
    :precondition (and (at ?t ?p) (in ?x ?t))
    :effect (and (at ?x ?p) (not (in ?x ?t))))

  (:action board
    :parameters (?d - driver ?t - truck ?p - place)
    :precondition (and (at ?t ?p) (at ?d ?p) (empty ?t))
    :effect (and (driving ?d ?t) (not (at ?d ?p)) (not (empty ?t))))

  (:action leave
    :parameters (?d - driver ?t - truck ?p - place)
    :precondition (and (at ?t ?p) (driving ?d ?t))
    :effect (and (at ?d ?p) (empty ?t) (not (driving ?d ?t))))

  (:action drive
    :parameters (?t - truck ?from ?to - place ?d - driver)
    :precondition (and (at ?t ?from) (driving ?d ?t) (road ?from ?to))
    :effect (and (at ?t ?to) (not (at ?t ?from))))

  (:action walk
    :parameters (?d - driver ?from ?to - place)
    :precondition (and (at ?d ?from) (path ?from ?to))
    :effect (and (at ?d ?to) (not (at ?d ?from)))))
