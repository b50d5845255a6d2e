(define (domain numbers)
  (:requirements :typing)
  (:types cart room)
  (:predicates (at ?k - cart ?r - room))
  (:functions (charge ?k - cart))
  (:action drive
    :parameters (?k - cart ?from ?to - room)
    :precondition (and (at ?k ?from) (>= (charge ?k) 20))
    :effect (and (at ?k ?to) (not (at ?k ?from)) (decrease (charge ?k) 20))))
