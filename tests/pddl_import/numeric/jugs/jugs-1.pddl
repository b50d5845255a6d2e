; Optimum: 6
(define (problem jugs-1) (:domain jugs)
  (:objects small large - jug)
  (:init (= (holds small) 0) (= (holds large) 0) (= (capacity small) 3) (= (capacity large) 5))
  (:goal (= (holds large) 4)))
