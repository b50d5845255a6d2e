(define (domain always)
  (:requirements :typing :constraints)
  (:types cart room)
  (:predicates (at ?k - cart ?r - room))
  (:action drive
    :parameters (?k - cart ?from ?to - room)
    :precondition (at ?k ?from)
    :effect (and (at ?k ?to) (not (at ?k ?from)))))
