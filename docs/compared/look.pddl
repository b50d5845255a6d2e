(define (domain look)
  (:requirements :adl)
  (:types part place)
  (:predicates (in ?x - part ?p - place) (good ?x - part) (scrap ?x - part))
  (:action look-good
    :parameters (?x - part)
    :precondition (and (not (good ?x)) (not (scrap ?x)))
    :effect (good ?x))
  (:action look-scrap
    :parameters (?x - part)
    :precondition (and (not (good ?x)) (not (scrap ?x)))
    :effect (scrap ?x))
  (:action bring
    :parameters (?x - part ?from ?to - place)
    :precondition (in ?x ?from)
    :effect (and (in ?x ?to) (not (in ?x ?from)))))
