; Counters go up and down within the same bounds.
(define (domain counters)
  (:requirements :typing :numeric-fluents)
  (:types counter)
  (:functions (count-of ?c - counter) (top))
  (:action count-up
    :parameters (?c - counter)
    :precondition (<= (+ (count-of ?c) 1) (top))
    :effect (increase (count-of ?c) 1))
  (:action count-down
    :parameters (?c - counter)
    :precondition (>= (count-of ?c) 1)
    :effect (decrease (count-of ?c) 1)))
