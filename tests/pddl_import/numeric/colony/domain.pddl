; A colony doubles, and is thinned out.
(define (domain colony)
  (:requirements :numeric-fluents)
  (:functions (cells) (room))
  (:action double
    :parameters ()
    :precondition (<= (* 2 (cells)) (room))
    :effect (scale-up (cells) 2))
  (:action thin
    :parameters ()
    :precondition (>= (cells) 3)
    :effect (decrease (cells) 3)))
