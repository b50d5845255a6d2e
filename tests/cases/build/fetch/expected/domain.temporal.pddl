; Made by skillc from the library fetch, sha256 952b04bf61c3d4a2a4b0dcccbdeb4aedae8c30da58856cab40a85661a767039a. Change the .skill files and compile again.
; durations: a unit is a second
(define (domain fetch-temporal)
  (:requirements :strips :typing :negative-preconditions :disjunctive-preconditions :universal-preconditions :durative-actions)
  (:types
    thing - object
    device holder item - thing
    gripper robot - device
    place - holder
    hard-gripper soft-gripper - gripper
  )
  (:predicates
    ; nothing is running that locks the device
    (idle ?device - thing)
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

  ; Drive to `to`.
  ; Drive, fetch.skill:7
  (:durative-action drive
    :parameters (?robot - robot ?to - place ?from - place)
    :duration (= ?duration 12)
    :condition (and
      (at start (idle ?robot))
      (at start (base-at ?robot ?from))
    )
    :effect (and
      (at start (not (idle ?robot)))
      (at end (base-at ?robot ?to))
      (at start (not (base-at ?robot ?from)))
      (at end (idle ?robot))
    )
  )

  ; Open or close the gripper.
  ; Open, fetch.skill:23
  (:durative-action open
    :parameters (?gripper - gripper)
    :duration (= ?duration 1)
    :condition (and
      (at start (or (is-hard-gripper ?gripper) (is-soft-gripper ?gripper)))
    )
    :effect (and
      (at end (is-open ?gripper))
    )
  )

  ; Take `item` where it stands.
  ; Pick, fetch.skill:41
  (:durative-action pick
    :parameters (?robot - robot ?item - item ?gripper - gripper ?from - place)
    :duration (= ?duration 8)
    :condition (and
      (at start (has-gripper ?robot ?gripper))
      (at start (base-at ?robot ?from))
      (at start (contain ?from ?item))
      (at start (forall (?any - item) (not (contain ?gripper ?any))))
      (at start (guard-pick-light ?item))
      (at start (is-open ?gripper))
      (at start (guard-pick-ready ?gripper))
      (over all (guard-pick-ready ?gripper))
    )
    :effect (and
      (at end (contain ?gripper ?item))
      (at start (not (contain ?from ?item)))
      (at start (not (is-open ?gripper)))
    )
  )
)
