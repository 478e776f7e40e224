#!/usr/bin/env python3
"""Rates a demo scene in plain Python and compares it with the thesis' table: check_living_room.py [FILE]."""

import pathlib
import sys

sys.dont_write_bytecode = True
from living_room.check import check  # noqa: E402


def main(arguments):
    if len(arguments) > 1:
        sys.exit(__doc__)
    scene = pathlib.Path(arguments[0] if arguments else pathlib.Path(__file__).with_name("living-room.glb"))
    table, faults = check(scene.read_bytes())
    print(table)
    sys.exit("\n".join(faults) if faults else 0)


if __name__ == "__main__":
    main(sys.argv[1:])
