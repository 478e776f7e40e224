#!/usr/bin/env python3
"""Writes the demo scene: generate_living_room.py [FILE], by default living-room.glb beside this script."""

import pathlib
import sys

sys.dont_write_bytecode = True
from living_room.room import living_room  # noqa: E402


def main(arguments):
    if len(arguments) > 1:
        sys.exit(__doc__)
    target = pathlib.Path(arguments[0] if arguments else pathlib.Path(__file__).with_name("living-room.glb"))
    target.write_bytes(living_room())


if __name__ == "__main__":
    main(sys.argv[1:])
