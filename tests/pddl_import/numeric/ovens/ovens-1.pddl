; Optimum: 15
(define (problem ovens-1) (:domain ovens)
  (:objects left right - oven rye wheat spelt - loaf)
  (:init (free left) (free right) (= (heat left) 8) (= (heat right) 0) (= (most-heat left) 12) (= (most-heat right) 20)
         (= (minutes rye) 4) (= (minutes wheat) 3) (= (minutes spelt) 3))
  (:goal (and (baked rye) (baked wheat) (baked spelt))))
