; Optimum: 27
(define (problem logistics-1) (:domain logistics)
  (:objects
    city1 city2 - city
    airport1 airport2 - airport
    depot1-1 depot2-1 - place
    truck1 truck2 - truck
    plane1 - airplane
    package1 package2 package3 package4 package5 package6 - package)
  (:init
    (in-city airport1 city1) (in-city depot1-1 city1) (in-city airport2 city2) (in-city depot2-1 city2)
    (at truck1 airport1) (at truck2 airport2) (at plane1 airport1) (at package1 depot1-1)
    (at package2 depot1-1) (at package3 airport2) (at package4 airport1) (at package5 airport2)
    (at package6 depot2-1))
  (:goal (and
    (at package1 airport1) (at package2 airport2) (at package3 depot1-1) (at package4 depot1-1)
    (at package5 depot2-1) (at package6 depot1-1))))
