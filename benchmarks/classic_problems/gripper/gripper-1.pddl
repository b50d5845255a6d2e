; Optimum: 15
(define (problem gripper-1) (:domain gripper)
  (:objects
    kitchen hall - room
    ball1 ball2 ball3 ball4 ball5 - ball
    left right - gripper)
  (:init
    (robot-in kitchen) (free left) (free right) (ball-in ball1 kitchen) (ball-in ball2 kitchen)
    (ball-in ball3 kitchen) (ball-in ball4 kitchen) (ball-in ball5 kitchen))
  (:goal (and
    (ball-in ball1 hall) (ball-in ball2 hall) (ball-in ball3 hall) (ball-in ball4 hall) (ball-in ball5 hall))))
