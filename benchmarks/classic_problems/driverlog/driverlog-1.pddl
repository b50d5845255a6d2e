; Optimum: 20
(define (problem driverlog-1) (:domain driverlog)
  (:objects
    place1 place2 place3 place4 place5 corner1 corner2 corner3 corner4 - place
    driver1 driver2 - driver
    truck1 truck2 - truck
    package1 package2 package3 package4 - package)
  (:init
    (road place2 place1) (road place1 place2) (path place2 corner1) (path corner1 place2)
    (path place1 corner1) (path corner1 place1) (road place3 place2) (road place2 place3)
    (path place3 corner2) (path corner2 place3) (path place1 corner2) (path corner2 place1)
    (road place4 place2) (road place2 place4) (path place4 corner3) (path corner3 place4)
    (path place5 corner3) (path corner3 place5) (road place5 place4) (road place4 place5)
    (path place5 corner4) (path corner4 place5) (path place4 corner4) (path corner4 place4)
    (road place1 place5) (road place5 place1) (at driver1 place2) (at driver2 place1) (at truck1 place4)
    (empty truck1) (at truck2 place1) (empty truck2) (at package1 place5) (at package2 place4)
    (at package3 place2) (at package4 place3))
  (:goal (and
    (at driver1 place4) (at truck1 place4) (at package1 place1) (at package2 place3) (at package3 place1)
    (at package4 place1))))
