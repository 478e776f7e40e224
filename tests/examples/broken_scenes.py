"""The demo scene's checker has to notice a scene that is off: a check that cannot fail proves nothing."""

import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "examples"))
from living_room import check, couch, floor, room, television  # noqa: E402


def expect_fault(beginning, owner, name, value):
    """The room with one attribute changed must have a fault that begins so."""
    kept = getattr(owner, name)
    setattr(owner, name, value)
    faults = check.check(room.living_room())[1]
    setattr(owner, name, kept)
    if not any(fault.startswith(beginning) for fault in faults):
        sys.exit("no fault begins with %r: %s" % (beginning, faults))


def main():
    faults = check.check(room.living_room())[1]
    if faults:
        sys.exit("the scene itself has faults: %s" % faults)
    expect_fault("Couch leg 1: R_ft", couch, "COUCH_LEG_HEIGHT", 0.13)
    expect_fault("Floor: R_ccm", floor.floor, "__defaults__", ((0, 40, 80), (-30, -60, 20)))
    expect_fault("TV stand: rack: 120 triangles", television, "rack", television.stand_boards)


main()
