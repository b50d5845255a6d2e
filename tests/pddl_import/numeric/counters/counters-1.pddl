; Optimum: 5
(define (problem counters-1) (:domain counters)
  (:objects c1 c2 c3 - counter)
  (:init (= (count-of c1) 3) (= (count-of c2) 2) (= (count-of c3) 1) (= (top) 4))
  (:goal (and (< (count-of c1) (count-of c2)) (< (+ (count-of c2) 1) (count-of c3)))))
