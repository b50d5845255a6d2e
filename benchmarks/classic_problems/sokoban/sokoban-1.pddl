; Optimum: 7
; #######
; #  .  #
; # $#$ #
; #  @  #
; # $ ..#
; #######
(define (problem sokoban-1) (:domain sokoban)
  (:objects
    c1-1 c2-1 c3-1 c4-1 c5-1 c1-2 c2-2 c4-2 c5-2 c1-3 c2-3 c3-3 c4-3 c5-3 c1-4 c2-4 c3-4 c4-4 c5-4 - cell
    left right up down - direction
    box1 box2 box3 - box)
  (:init
    (player-at c3-3) (box-at box1 c2-2) (box-at box2 c4-2) (box-at box3 c2-4) (clear c1-1) (clear c2-1)
    (clear c3-1) (clear c4-1) (clear c5-1) (clear c1-2) (clear c5-2) (clear c1-3) (clear c2-3) (clear c4-3)
    (clear c5-3) (clear c1-4) (clear c3-4) (clear c4-4) (clear c5-4) (next c1-1 c2-1 right)
    (next c1-1 c1-2 down) (next c2-1 c1-1 left) (next c2-1 c3-1 right) (next c2-1 c2-2 down)
    (next c3-1 c2-1 left) (next c3-1 c4-1 right) (next c4-1 c3-1 left) (next c4-1 c5-1 right)
    (next c4-1 c4-2 down) (next c5-1 c4-1 left) (next c5-1 c5-2 down) (next c1-2 c2-2 right)
    (next c1-2 c1-1 up) (next c1-2 c1-3 down) (next c2-2 c1-2 left) (next c2-2 c2-1 up) (next c2-2 c2-3 down)
    (next c4-2 c5-2 right) (next c4-2 c4-1 up) (next c4-2 c4-3 down) (next c5-2 c4-2 left)
    (next c5-2 c5-1 up) (next c5-2 c5-3 down) (next c1-3 c2-3 right) (next c1-3 c1-2 up)
    (next c1-3 c1-4 down) (next c2-3 c1-3 left) (next c2-3 c3-3 right) (next c2-3 c2-2 up)
    (next c2-3 c2-4 down) (next c3-3 c2-3 left) (next c3-3 c4-3 right) (next c3-3 c3-4 down)
    (next c4-3 c3-3 left) (next c4-3 c5-3 right) (next c4-3 c4-2 up) (next c4-3 c4-4 down)
    (next c5-3 c4-3 left) (next c5-3 c5-2 up) (next c5-3 c5-4 down) (next c1-4 c2-4 right)
    (next c1-4 c1-3 up) (next c2-4 c1-4 left) (next c2-4 c3-4 right) (next c2-4 c2-3 up)
    (next c3-4 c2-4 left) (next c3-4 c4-4 right) (next c3-4 c3-3 up) (next c4-4 c3-4 left)
    (next c4-4 c5-4 right) (next c4-4 c4-3 up) (next c5-4 c4-4 left) (next c5-4 c5-3 up) (= (total-cost) 0))
  (:goal (and
    (box-at box1 c3-1) (box-at box2 c4-4) (box-at box3 c5-4)))
  (:metric minimize (total-cost)))
