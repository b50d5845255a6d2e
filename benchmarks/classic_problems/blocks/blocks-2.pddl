; Optimum: 26
(define (problem blocks-2) (:domain blocks)
  (:objects
    b1 b2 b3 b4 b5 b6 b7 b8 b9 b10 b11 b12 - block)
  (:init
    (hand-empty) (on-table b8) (on b4 b8) (on b11 b4) (on b5 b11) (on b1 b5) (clear b1) (on-table b12)
    (on b9 b12) (on b3 b9) (on b6 b3) (clear b6) (on-table b10) (clear b10) (on-table b2) (on b7 b2)
    (clear b7))
  (:goal (and
    (on b6 b4) (on b1 b6) (on b8 b1) (on b12 b8) (on b10 b11) (on b3 b2) (on b7 b3))))
