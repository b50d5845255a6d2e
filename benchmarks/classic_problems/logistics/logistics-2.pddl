; Optimum: 26
(define (problem logistics-2) (:domain logistics)
  (:objects
    city1 city2 city3 - city
    airport1 airport2 airport3 - airport
    depot1-1 depot2-1 depot3-1 - place
    truck1 truck2 truck3 - truck
    plane1 - airplane
    package1 package2 package3 package4 package5 package6 package7 - package)
  (:init
    (in-city airport1 city1) (in-city depot1-1 city1) (in-city airport2 city2) (in-city depot2-1 city2)
    (in-city airport3 city3) (in-city depot3-1 city3) (at truck1 depot1-1) (at truck2 depot2-1)
    (at truck3 airport3) (at plane1 airport2) (at package1 airport2) (at package2 airport2)
    (at package3 airport3) (at package4 airport2) (at package5 depot2-1) (at package6 depot2-1)
    (at package7 airport1))
  (:goal (and
    (at package1 airport1) (at package2 airport1) (at package3 depot1-1) (at package4 depot1-1)
    (at package5 airport1) (at package6 airport2) (at package7 airport2))))
