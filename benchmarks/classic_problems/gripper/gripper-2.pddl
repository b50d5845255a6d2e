; Optimum: 27
(define (problem gripper-2) (:domain gripper)
  (:objects
    kitchen hall - room
    ball1 ball2 ball3 ball4 ball5 ball6 ball7 ball8 ball9 - ball
    left right - gripper)
  (:init
    (robot-in kitchen) (free left) (free right) (ball-in ball1 kitchen) (ball-in ball2 kitchen)
    (ball-in ball3 kitchen) (ball-in ball4 kitchen) (ball-in ball5 kitchen) (ball-in ball6 kitchen)
    (ball-in ball7 kitchen) (ball-in ball8 kitchen) (ball-in ball9 kitchen))
  (:goal (and
    (ball-in ball1 hall) (ball-in ball2 hall) (ball-in ball3 hall) (ball-in ball4 hall) (ball-in ball5 hall)
    (ball-in ball6 hall) (ball-in ball7 hall) (ball-in ball8 hall) (ball-in ball9 hall))))
