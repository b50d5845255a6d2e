; cost 2
(define (problem sort) (:domain look)
  (:objects tray-1 - part table rack bin - place)
  (:init (in tray-1 table))
  (:goal (or (and (good tray-1) (in tray-1 rack)) (and (scrap tray-1) (in tray-1 bin)))))
