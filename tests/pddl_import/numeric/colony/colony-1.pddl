; Optimum: 6
(define (problem colony-1) (:domain colony)
  (:init (= (cells) 1) (= (room) 20))
  (:goal (= (cells) 7)))
