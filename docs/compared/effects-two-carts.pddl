; cost 1
(define (problem two-carts) (:domain effects)
  (:objects cart-1 cart-2 - cart tray-1 - tray cup-1 cup-2 - cup kitchen ward - room)
  (:init (in tray-1 kitchen) (carries cart-1 tray-1))
  (:goal (and (carries cart-1 tray-1) (carries cart-2 tray-1))))
