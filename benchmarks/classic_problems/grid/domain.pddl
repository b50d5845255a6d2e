; A robot carries keys through a grid, whose locked places open with keys of their shape.
(define (domain grid)
  (:requirements :strips :typing)
  (:types place shape key)
  (:predicates (connected ?x ?y - place) (key-shape ?k - key ?s - shape) (lock-shape ?x - place ?s - shape)
               (at ?k - key ?x - place) (robot-at ?x - place) (locked ?x - place) (open ?x - place)
               (holding ?k - key) (arm-empty))

  (:action unlock
    :parameters (?here ?there - place ?key - key ?shape - shape)
    :precondition (and (connected ?here ?there) (robot-at ?here) (holding ?key) (key-shape ?key ?shape)
                       (lock-shape ?there ?shape) (locked ?there))
    :effect (and (open ?there) (not (locked ?there))))

  (:action move
    :parameters (?here ?there - place)
    :precondition (and (robot-at ?here) (connected ?here ?there) (open ?there))
    :effect (and (robot-at ?there) (not (robot-at ?here))))

  (:action pick-up
    :parameters (?here - place ?key - key)
    :precondition (and (robot-at ?here) (at ?key ?here) (arm-empty))
    :effect (and (holding ?key) (not (at ?key ?here)) (not (arm-empty))))

  (:action exchange
    :parameters (?here - place ?new ?old - key)
    :precondition (and (robot-at ?here) (holding ?old) (at ?new ?here))
    :effect (and (holding ?new) (at ?old ?here) (not (holding ?old)) (not (at ?new ?here))))

  (:action put-down
    :parameters (?here - place ?key - key)
    :precondition (and (robot-at ?here) (holding ?key))
    :effect (and (arm-empty) (at ?key ?here) (not (holding ?key)))))
