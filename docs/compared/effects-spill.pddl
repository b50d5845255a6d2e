; cost 2
(define (problem spill) (:domain effects)
  (:objects cart-1 cart-2 - cart tray-1 - tray cup-1 cup-2 - cup kitchen ward - room)
  (:init (in tray-1 kitchen) (on cup-1 tray-1) (open cup-1) (open cup-2) (carries cart-1 tray-1))
  (:goal (and (empty cup-1) (in tray-1 kitchen))))
