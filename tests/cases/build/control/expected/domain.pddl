; Made by skillc from the library control, sha256 b9978db50c7852d63d0c89904e1fa390905bfcf2c471d95b211dc1b1b54b0df8. Change the .skill files and compile again.
; costs are durations: a unit is a second
; left out: Tour (control.skill:7): its parameter `stops` is no thing, so a planner cannot choose it
(define (domain control)
  (:requirements :strips :typing :action-costs)
  (:types
    thing - object
    device holder item - thing
    gripper robot - device
    place - holder
    hard-gripper soft-gripper - gripper
  )
  (:functions
    (total-cost) - number
  )
)
