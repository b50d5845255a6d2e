; refused: >=
(define (problem drive) (:domain numbers)
  (:objects cart-1 - cart kitchen ward - room)
  (:init (at cart-1 kitchen) (= (charge cart-1) 30))
  (:goal (at cart-1 ward)))
