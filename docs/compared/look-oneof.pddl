(define (domain look-oneof)
  (:requirements :adl)
  (:types part place)
  (:predicates (in ?x - part ?p - place) (good ?x - part) (scrap ?x - part))
  (:action look
    :parameters (?x - part)
    :precondition (and (not (good ?x)) (not (scrap ?x)))
    :effect (oneof (good ?x) (scrap ?x)))
  (:action bring
    :parameters (?x - part ?from ?to - place)
    :precondition (in ?x ?from)
    :effect (and (in ?x ?to) (not (in ?x ?from)))))
