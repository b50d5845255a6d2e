(define (domain hold)
  (:requirements :typing)
  (:types cart room)
  (:predicates (at ?k - cart ?r - room) (fault ?k - cart))
  (:durative-action drive
    :parameters (?k - cart ?from ?to - room)
    :duration (= ?duration 20)
    :condition (and (at start (at ?k ?from)) (over all (not (fault ?k))))
    :effect (and (at start (not (at ?k ?from))) (at end (at ?k ?to)))))
