; Optimum: 16
; ##########
; #        #
; #  $  $  #
; #   ##   #
; #  $  @  #
; #     ...#
; ##########
(define (problem sokoban-2) (:domain sokoban)
  (:objects
    c1-1 c2-1 c3-1 c4-1 c5-1 c6-1 c7-1 c8-1 c1-2 c2-2 c3-2 c4-2 c5-2 c6-2 c7-2 c8-2 c1-3 c2-3 c3-3 c6-3 c7-3 c8-3 c1-4 c2-4 c3-4 c4-4 c5-4 c6-4 c7-4 c8-4 c1-5 c2-5 c3-5 c4-5 c5-5 c6-5 c7-5 c8-5 - cell
    left right up down - direction
    box1 box2 box3 - box)
  (:init
    (player-at c6-4) (box-at box1 c3-2) (box-at box2 c6-2) (box-at box3 c3-4) (clear c1-1) (clear c2-1)
    (clear c3-1) (clear c4-1) (clear c5-1) (clear c6-1) (clear c7-1) (clear c8-1) (clear c1-2) (clear c2-2)
    (clear c4-2) (clear c5-2) (clear c7-2) (clear c8-2) (clear c1-3) (clear c2-3) (clear c3-3) (clear c6-3)
    (clear c7-3) (clear c8-3) (clear c1-4) (clear c2-4) (clear c4-4) (clear c5-4) (clear c7-4) (clear c8-4)
    (clear c1-5) (clear c2-5) (clear c3-5) (clear c4-5) (clear c5-5) (clear c6-5) (clear c7-5) (clear c8-5)
    (next c1-1 c2-1 right) (next c1-1 c1-2 down) (next c2-1 c1-1 left) (next c2-1 c3-1 right)
    (next c2-1 c2-2 down) (next c3-1 c2-1 left) (next c3-1 c4-1 right) (next c3-1 c3-2 down)
    (next c4-1 c3-1 left) (next c4-1 c5-1 right) (next c4-1 c4-2 down) (next c5-1 c4-1 left)
    (next c5-1 c6-1 right) (next c5-1 c5-2 down) (next c6-1 c5-1 left) (next c6-1 c7-1 right)
    (next c6-1 c6-2 down) (next c7-1 c6-1 left) (next c7-1 c8-1 right) (next c7-1 c7-2 down)
    (next c8-1 c7-1 left) (next c8-1 c8-2 down) (next c1-2 c2-2 right) (next c1-2 c1-1 up)
    (next c1-2 c1-3 down) (next c2-2 c1-2 left) (next c2-2 c3-2 right) (next c2-2 c2-1 up)
    (next c2-2 c2-3 down) (next c3-2 c2-2 left) (next c3-2 c4-2 right) (next c3-2 c3-1 up)
    (next c3-2 c3-3 down) (next c4-2 c3-2 left) (next c4-2 c5-2 right) (next c4-2 c4-1 up)
    (next c5-2 c4-2 left) (next c5-2 c6-2 right) (next c5-2 c5-1 up) (next c6-2 c5-2 left)
    (next c6-2 c7-2 right) (next c6-2 c6-1 up) (next c6-2 c6-3 down) (next c7-2 c6-2 left)
    (next c7-2 c8-2 right) (next c7-2 c7-1 up) (next c7-2 c7-3 down) (next c8-2 c7-2 left)
    (next c8-2 c8-1 up) (next c8-2 c8-3 down) (next c1-3 c2-3 right) (next c1-3 c1-2 up)
    (next c1-3 c1-4 down) (next c2-3 c1-3 left) (next c2-3 c3-3 right) (next c2-3 c2-2 up)
    (next c2-3 c2-4 down) (next c3-3 c2-3 left) (next c3-3 c3-2 up) (next c3-3 c3-4 down)
    (next c6-3 c7-3 right) (next c6-3 c6-2 up) (next c6-3 c6-4 down) (next c7-3 c6-3 left)
    (next c7-3 c8-3 right) (next c7-3 c7-2 up) (next c7-3 c7-4 down) (next c8-3 c7-3 left)
    (next c8-3 c8-2 up) (next c8-3 c8-4 down) (next c1-4 c2-4 right) (next c1-4 c1-3 up)
    (next c1-4 c1-5 down) (next c2-4 c1-4 left) (next c2-4 c3-4 right) (next c2-4 c2-3 up)
    (next c2-4 c2-5 down) (next c3-4 c2-4 left) (next c3-4 c4-4 right) (next c3-4 c3-3 up)
    (next c3-4 c3-5 down) (next c4-4 c3-4 left) (next c4-4 c5-4 right) (next c4-4 c4-5 down)
    (next c5-4 c4-4 left) (next c5-4 c6-4 right) (next c5-4 c5-5 down) (next c6-4 c5-4 left)
    (next c6-4 c7-4 right) (next c6-4 c6-3 up) (next c6-4 c6-5 down) (next c7-4 c6-4 left)
    (next c7-4 c8-4 right) (next c7-4 c7-3 up) (next c7-4 c7-5 down) (next c8-4 c7-4 left)
    (next c8-4 c8-3 up) (next c8-4 c8-5 down) (next c1-5 c2-5 right) (next c1-5 c1-4 up)
    (next c2-5 c1-5 left) (next c2-5 c3-5 right) (next c2-5 c2-4 up) (next c3-5 c2-5 left)
    (next c3-5 c4-5 right) (next c3-5 c3-4 up) (next c4-5 c3-5 left) (next c4-5 c5-5 right)
    (next c4-5 c4-4 up) (next c5-5 c4-5 left) (next c5-5 c6-5 right) (next c5-5 c5-4 up)
    (next c6-5 c5-5 left) (next c6-5 c7-5 right) (next c6-5 c6-4 up) (next c7-5 c6-5 left)
    (next c7-5 c8-5 right) (next c7-5 c7-4 up) (next c8-5 c7-5 left) (next c8-5 c8-4 up) (= (total-cost) 0))
  (:goal (and
    (box-at box1 c6-5) (box-at box2 c7-5) (box-at box3 c8-5)))
  (:metric minimize (total-cost)))
