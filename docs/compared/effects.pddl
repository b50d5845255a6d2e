(define (domain effects)
  (:requirements :adl)
  (:types cart tray cup room)
  (:predicates (in ?t - tray ?r - room) (on ?c - cup ?t - tray) (open ?c - cup) (empty ?c - cup) (carries ?k - cart ?t - tray))
  (:action move
    :parameters (?t - tray ?from ?to - room)
    :precondition (and (in ?t ?from) (not (= ?from ?to)))
    :effect (and (in ?t ?to) (not (in ?t ?from))
                 (forall (?c - cup) (when (and (on ?c ?t) (open ?c)) (empty ?c)))))
  (:action hand-over
    :parameters (?k - cart ?t - tray)
    :precondition (and (not (carries ?k ?t)))
    :effect (carries ?k ?t)))
