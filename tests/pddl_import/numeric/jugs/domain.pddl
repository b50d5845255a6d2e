; Jugs without marks are poured into each other.
(define (domain jugs)
  (:requirements :typing :numeric-fluents)
  (:types jug)
  (:functions (holds ?j - jug) (capacity ?j - jug))
  (:action fill-up
    :parameters (?j - jug)
    :precondition (< (holds ?j) (capacity ?j))
    :effect (assign (holds ?j) (capacity ?j)))
  (:action pour-out
    :parameters (?j - jug)
    :precondition (> (holds ?j) 0)
    :effect (assign (holds ?j) 0))
  (:action pour-all
    :parameters (?a ?b - jug)
    :precondition (and (not (= ?a ?b)) (> (holds ?a) 0) (<= (+ (holds ?a) (holds ?b)) (capacity ?b)))
    :effect (and (increase (holds ?b) (holds ?a)) (assign (holds ?a) 0)))
  (:action pour-until-full
    :parameters (?a ?b - jug)
    :precondition (and (not (= ?a ?b)) (> (+ (holds ?a) (holds ?b)) (capacity ?b)))
    :effect (and (decrease (holds ?a) (- (capacity ?b) (holds ?b))) (assign (holds ?b) (capacity ?b)))))
