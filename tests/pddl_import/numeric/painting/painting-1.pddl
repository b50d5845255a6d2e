; Optimum: 4
(define (problem painting-1) (:domain painting)
  (:objects short long - rail hook lid pipe - part)
  (:init (hangs hook long) (hangs lid long) (hangs pipe short)
         (= (paint) 7) (= (paint-used) 0) (= (length short) 2) (= (length long) 6))
  (:goal (and (painted hook) (painted lid) (painted pipe) (> (paint) 4)))
  (:metric minimize (paint-used)))
