; cost 1
(define (problem nested) (:domain inside)
  (:objects shelf truck - place b1 b2 b3 - box)
  (:init (in b1 b2) (in b2 b3) (in b3 shelf))
  (:goal (inside b1 truck)))
