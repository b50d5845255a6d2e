; Made by skillc from the library fetch, sha256 952b04bf61c3d4a2a4b0dcccbdeb4aedae8c30da58856cab40a85661a767039a. Change the .skill files and compile again.
; costs are durations: a unit is a second
(define (domain fetch)
  (:requirements :strips :typing :negative-preconditions :disjunctive-preconditions :universal-preconditions :action-costs)
  (:types
    thing - object
    device holder item - thing
    gripper robot - device
    place - holder
    hard-gripper soft-gripper - gripper
  )
  (:predicates
    (base-at ?subject - robot ?value - place)
    (contain ?subject - thing ?value - item)
    ; `light` of Pick: item.weight <= limit
    (guard-pick-light ?item - item)
    ; `ready` of Pick: gripper.state != Fault
    (guard-pick-ready ?gripper - gripper)
    (has-gripper ?subject - robot ?value - gripper)
    (is-hard-gripper ?subject - thing)
    (is-open ?subject - gripper)
    (is-soft-gripper ?subject - thing)
  )
  (:functions
    (total-cost) - number
  )

  ; Drive to `to`.
  ; Drive, fetch.skill:7
  (:action drive
    :parameters (?robot - robot ?to - place ?from - place)
    :precondition (base-at ?robot ?from)
    :effect (and
      (base-at ?robot ?to)
      (not (base-at ?robot ?from))
      (increase (total-cost) 12)
    )
  )

  ; Open or close the gripper.
  ; Open, fetch.skill:23
  (:action open
    :parameters (?gripper - gripper)
    :precondition (or (is-hard-gripper ?gripper) (is-soft-gripper ?gripper))
    :effect (and
      (is-open ?gripper)
      (increase (total-cost) 1)
    )
  )

  ; Take `item` where it stands.
  ; Pick, fetch.skill:41
  (:action pick
    :parameters (?robot - robot ?item - item ?gripper - gripper ?from - place)
    :precondition (and
      (has-gripper ?robot ?gripper)
      (base-at ?robot ?from)
      (contain ?from ?item)
      (forall (?any - item) (not (contain ?gripper ?any)))
      (guard-pick-light ?item)
      (is-open ?gripper)
      (guard-pick-ready ?gripper)
    )
    :effect (and
      (contain ?gripper ?item)
      (not (contain ?from ?item))
      (not (is-open ?gripper))
      (increase (total-cost) 8)
    )
  )
)
