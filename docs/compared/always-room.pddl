; refused: :constraints
(define (problem make-room) (:domain always)
  (:objects cart-1 cart-2 - cart kitchen ward-1 ward-2 - room)
  (:init (at cart-1 kitchen) (at cart-2 ward-2))
  (:goal (at cart-1 ward-2))
  (:constraints (always (forall (?r - room) (not (and (at cart-1 ?r) (at cart-2 ?r)))))))
