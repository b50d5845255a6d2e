; Optimum: 16
(define (problem blocks-1) (:domain blocks)
  (:objects
    b1 b2 b3 b4 b5 b6 b7 b8 b9 - block)
  (:init
    (hand-empty) (on-table b2) (on b7 b2) (on b5 b7) (on b8 b5) (clear b8) (on-table b6) (on b1 b6)
    (on b9 b1) (clear b9) (on-table b3) (on b4 b3) (clear b4))
  (:goal (and
    (on b7 b4) (on b5 b7) (on b2 b6) (on b9 b3) (on b1 b9))))
