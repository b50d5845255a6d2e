; A player pushes boxes onto goals; only pushes cost something.
(define (domain sokoban)
  (:requirements :typing :action-costs)
  (:types cell direction box)
  (:predicates (player-at ?c - cell) (box-at ?b - box ?c - cell) (clear ?c - cell)
               (next ?from ?to - cell ?d - direction))
  (:functions (total-cost) - number)

  (:action move
    :parameters (?from ?to - cell ?d - direction)
    :precondition (and (player-at ?from) (clear ?to) (next ?from ?to ?d))
    :effect (and (player-at ?to) (clear ?from) (not (player-at ?from)) (not (clear ?to))))

  (:action push
    :parameters (?b - box ?player ?from ?to - cell ?d - direction)
    :precondition (and (player-at ?player) (box-at ?b ?from) (clear ?to) (next ?player ?from ?d) (next ?from ?to ?d))
    :effect (and (player-at ?from) (box-at ?b ?to) (clear ?player)
                 (not (player-at ?player)) (not (box-at ?b ?from)) (not (clear ?to)) (increase (total-cost) 1))))
