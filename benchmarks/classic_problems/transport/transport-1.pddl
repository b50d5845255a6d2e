; Optimum: 104
(define (problem transport-1) (:domain transport)
  (:objects
    town1 town2 town3 town4 town5 town6 - place
    truck1 truck2 - vehicle
    package1 package2 package3 - package
    size0 size1 size2 - size)
  (:init
    (road town1 town4) (= (road-length town1 town4) 19) (road town4 town1) (= (road-length town4 town1) 19)
    (road town1 town5) (= (road-length town1 town5) 17) (road town5 town1) (= (road-length town5 town1) 17)
    (road town2 town1) (= (road-length town2 town1) 35) (road town1 town2) (= (road-length town1 town2) 35)
    (road town3 town1) (= (road-length town3 town1) 39) (road town1 town3) (= (road-length town1 town3) 39)
    (road town3 town5) (= (road-length town3 town5) 40) (road town5 town3) (= (road-length town5 town3) 40)
    (road town4 town2) (= (road-length town4 town2) 35) (road town2 town4) (= (road-length town2 town4) 35)
    (road town5 town4) (= (road-length town5 town4) 30) (road town4 town5) (= (road-length town4 town5) 30)
    (road town6 town5) (= (road-length town6 town5) 14) (road town5 town6) (= (road-length town5 town6) 14)
    (next size0 size1) (next size1 size2) (at truck1 town2) (capacity truck1 size2) (at truck2 town6)
    (capacity truck2 size2) (at package1 town2) (at package2 town4) (at package3 town6) (= (total-cost) 0))
  (:goal (and
    (at package1 town5) (at package2 town1) (at package3 town1)))
  (:metric minimize (total-cost)))
