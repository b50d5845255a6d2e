; Made by skillc from the library control, sha256 1650966bebda31435788176ed171ae9edb26bd198afbd5d392bec428abed0106. Change the .skill files and compile again.
; durations: a unit is a second
; left out: Tour (control.skill:7): its parameter `stops` is no thing, so a planner cannot choose it
(define (domain control-temporal)
  (:requirements :strips :typing :durative-actions)
  (:types
    thing - object
    device holder item - thing
    gripper robot - device
    place - holder
    hard-gripper soft-gripper - gripper
  )
  (:predicates
  )
)
