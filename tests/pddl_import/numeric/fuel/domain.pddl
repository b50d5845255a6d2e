; Vans with tanks bring parcels.
(define (domain fuel-delivery)
  (:requirements :typing :numeric-fluents :action-costs)
  (:types place - object depot - place van parcel)
  (:predicates (at-place ?v - van ?p - place) (lies-at ?x - parcel ?p - place) (in ?x - parcel ?v - van)
               (road ?from ?to - place))
  (:functions (fuel ?v - van) (tank ?v - van) (cargo ?v - van) (weight ?x - parcel) (carries ?v - van)
              (distance ?from ?to - place) (total-cost))
  (:action drive
    :parameters (?v - van ?from ?to - place)
    :precondition (and (at-place ?v ?from) (road ?from ?to) (>= (fuel ?v) (distance ?from ?to)))
    :effect (and (not (at-place ?v ?from)) (at-place ?v ?to) (decrease (fuel ?v) (distance ?from ?to))
                 (increase (total-cost) (distance ?from ?to))))
  (:action load
    :parameters (?x - parcel ?v - van ?p - place)
    :precondition (and (lies-at ?x ?p) (at-place ?v ?p) (<= (+ (cargo ?v) (weight ?x)) (carries ?v)))
    :effect (and (in ?x ?v) (not (lies-at ?x ?p)) (increase (cargo ?v) (weight ?x)) (increase (total-cost) 1)))
  (:action unload
    :parameters (?x - parcel ?v - van ?p - place)
    :precondition (and (in ?x ?v) (at-place ?v ?p) (>= (cargo ?v) (weight ?x)))
    :effect (and (lies-at ?x ?p) (not (in ?x ?v)) (decrease (cargo ?v) (weight ?x)) (increase (total-cost) 1)))
  (:action refuel
    :parameters (?v - van ?d - depot)
    :precondition (at-place ?v ?d)
    :effect (and (assign (fuel ?v) (tank ?v)) (increase (total-cost) 2))))
