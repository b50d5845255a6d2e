; Optimum: 22
(define (problem depot-1) (:domain depot)
  (:objects
    place1 place2 place3 - place
    pallet1 pallet2 pallet3 - pallet
    hoist1 hoist2 hoist3 - hoist
    crate1 crate2 crate3 crate4 crate5 crate6 - crate
    truck1 truck2 - truck)
  (:init
    (at pallet1 place1) (at hoist1 place1) (available hoist1) (at pallet2 place2) (at hoist2 place2)
    (available hoist2) (at pallet3 place3) (at hoist3 place3) (available hoist3) (at truck1 place1)
    (at truck2 place2) (on crate2 pallet1) (on crate3 crate2) (on crate1 crate3) (at crate2 place1)
    (at crate3 place1) (at crate1 place1) (clear crate1) (on crate6 pallet2) (on crate4 crate6)
    (at crate6 place2) (at crate4 place2) (clear crate4) (on crate5 pallet3) (at crate5 place3)
    (clear crate5))
  (:goal (and
    (on crate4 pallet1) (on crate6 crate4) (on crate3 crate6) (on crate1 pallet2) (on crate2 crate1)
    (on crate5 pallet3))))
