; All that hangs on a rail is painted at once; what a rail is painted with is what counts.
(define (domain painting)
  (:requirements :typing :adl :numeric-fluents)
  (:types rail part)
  (:predicates (hangs ?p - part ?r - rail) (painted ?p - part))
  (:functions (paint) (paint-used) (length ?r - rail))
  (:action paint-rail
    :parameters (?r - rail)
    :precondition (>= (paint) (length ?r))
    :effect (and (decrease (paint) (length ?r)) (increase (paint-used) (length ?r))
                 (forall (?p - part) (when (hangs ?p ?r) (painted ?p)))))
  (:action move-part
    :parameters (?p - part ?from ?to - rail)
    :precondition (and (hangs ?p ?from) (not (= ?from ?to)))
    :effect (and (not (hangs ?p ?from)) (hangs ?p ?to) (increase (paint-used) 1))))
