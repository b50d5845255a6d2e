; Optimum: 28
(define (problem driverlog-2) (:domain driverlog)
  (:objects
    place1 place2 place3 place4 place5 place6 corner1 corner2 corner3 corner4 corner5 - place
    driver1 driver2 - driver
    truck1 truck2 - truck
    package1 package2 package3 package4 package5 - package)
  (:init
    (road place2 place1) (road place1 place2) (path place2 corner1) (path corner1 place2)
    (path place5 corner1) (path corner1 place5) (road place3 place2) (road place2 place3)
    (path place3 corner2) (path corner2 place3) (path place1 corner2) (path corner2 place1)
    (road place4 place1) (road place1 place4) (path place4 corner3) (path corner3 place4)
    (path place2 corner3) (path corner3 place2) (road place5 place4) (road place4 place5)
    (path place5 corner4) (path corner4 place5) (path place3 corner4) (path corner4 place3)
    (road place6 place3) (road place3 place6) (path place6 corner5) (path corner5 place6)
    (path place1 corner5) (path corner5 place1) (road place1 place6) (road place6 place1) (at driver1 place3)
    (at driver2 place4) (at truck1 place2) (empty truck1) (at truck2 place6) (empty truck2)
    (at package1 place5) (at package2 place2) (at package3 place5) (at package4 place6) (at package5 place6))
  (:goal (and
    (at driver1 place4) (at truck1 place5) (at package1 place1) (at package2 place5) (at package3 place3)
    (at package4 place5) (at package5 place1))))
