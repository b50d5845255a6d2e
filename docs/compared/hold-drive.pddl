; refused: :durative-action
(define (problem drive) (:domain hold)
  (:objects cart-1 - cart kitchen ward - room)
  (:init (at cart-1 kitchen))
  (:goal (at cart-1 ward)))
