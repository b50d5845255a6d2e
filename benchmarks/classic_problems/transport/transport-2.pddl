; Optimum: 137
(define (problem transport-2) (:domain transport)
  (:objects
    town1 town2 town3 town4 town5 town6 town7 - place
    truck1 truck2 - vehicle
    package1 package2 package3 package4 - package
    size0 size1 size2 - size)
  (:init
    (road town1 town7) (= (road-length town1 town7) 9) (road town7 town1) (= (road-length town7 town1) 9)
    (road town2 town1) (= (road-length town2 town1) 20) (road town1 town2) (= (road-length town1 town2) 20)
    (road town3 town1) (= (road-length town3 town1) 10) (road town1 town3) (= (road-length town1 town3) 10)
    (road town4 town2) (= (road-length town4 town2) 40) (road town2 town4) (= (road-length town2 town4) 40)
    (road town4 town7) (= (road-length town4 town7) 32) (road town7 town4) (= (road-length town7 town4) 32)
    (road town5 town1) (= (road-length town5 town1) 8) (road town1 town5) (= (road-length town1 town5) 8)
    (road town5 town2) (= (road-length town5 town2) 12) (road town2 town5) (= (road-length town2 town5) 12)
    (road town6 town1) (= (road-length town6 town1) 19) (road town1 town6) (= (road-length town1 town6) 19)
    (road town7 town5) (= (road-length town7 town5) 8) (road town5 town7) (= (road-length town5 town7) 8)
    (next size0 size1) (next size1 size2) (at truck1 town5) (capacity truck1 size2) (at truck2 town5)
    (capacity truck2 size2) (at package1 town4) (at package2 town2) (at package3 town5) (at package4 town3)
    (= (total-cost) 0))
  (:goal (and
    (at package1 town1) (at package2 town1) (at package3 town2) (at package4 town4)))
  (:metric minimize (total-cost)))
