; Discs lie on pegs, none on a smaller one.
(define (domain hanoi)
  (:requirements :strips :typing)
  (:types disc peg - support)
  (:predicates (clear ?x - support) (on ?x - disc ?y - support) (smaller ?x - disc ?y - support))

  (:action move
    :parameters (?disc - disc ?from ?to - support)
    :precondition (and (smaller ?disc ?to) (on ?disc ?from) (clear ?disc) (clear ?to))
    :effect (and (clear ?from) (on ?disc ?to) (not (on ?disc ?from)) (not (clear ?to)))))
