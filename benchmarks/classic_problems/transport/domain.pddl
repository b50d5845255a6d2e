; Trucks of a capacity carry packages on roads, each of a length.
(define (domain transport)
  (:requirements :typing :action-costs)
  (:types place size item - object
          vehicle package - item)
  (:predicates (road ?x ?y - place) (at ?x - item ?p - place) (in ?x - package ?v - vehicle)
               (capacity ?v - vehicle ?s - size) (next ?small ?large - size))
  (:functions (road-length ?x ?y - place) - number (total-cost) - number)

  (:action drive
    :parameters (?v - vehicle ?from ?to - place)
    :precondition (and (at ?v ?from) (road ?from ?to))
    :effect (and (at ?v ?to) (not (at ?v ?from)) (increase (total-cost) (road-length ?from ?to))))

  (:action pick-up
    :parameters (?v - vehicle ?p - place ?x - package ?less ?more - size)
    :precondition (and (at ?v ?p) (at ?x ?p) (next ?less ?more) (capacity ?v ?more))
    :effect (and (in ?x ?v) (capacity ?v ?less) (not (at ?x ?p)) (not (capacity ?v ?more)) (increase (total-cost) 1)))

  (:action drop
    :parameters (?v - vehicle ?p - place ?x - package ?less ?more - size)
    :precondition (and (at ?v ?p) (in ?x ?v) (next ?less ?more) (capacity ?v ?less))
    :effect (and (at ?x ?p) (capacity ?v ?more) (not (in ?x ?v)) (not (capacity ?v ?less)) (increase (total-cost) 1))))
