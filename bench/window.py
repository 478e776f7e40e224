#!/usr/bin/env python3
"""How fluently the review window moves: the demo scene at 1280x720 on a virtual display.

    window.py PROGRAM SCENE [SECONDS]

Turns the scene with the mouse and moves through it with a key, and prints what the window says about its pictures.
"""

import os
import re
import sys
import tempfile
import time

sys.dont_write_bytecode = True
ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "tests", "viewer"))
from window_driver import UNTIMED, Display, Viewer  # noqa: E402

BETWEEN_MOVES = 0.005  # seconds: a mouse sends some hundred positions per second


def turn(viewer, seconds):
    viewer.xdotool("mousemove", 900, 300, "mousedown", 1)
    end = time.monotonic() + seconds
    step = 2
    while time.monotonic() < end:
        moves = []
        for _ in range(100):
            moves += ["mousemove_relative", "--", step, 0, "sleep", BETWEEN_MOVES]
        viewer.xdotool(*moves)
        step = -step
    viewer.xdotool("mouseup", 1)


def move(viewer, seconds):
    for key in ("Left", "Right"):
        viewer.xdotool("keydown", key)
        time.sleep(seconds / 2)
        viewer.xdotool("keyup", key)


def measure(program, scene, what, action, seconds):
    with Display() as display, tempfile.TemporaryDirectory() as folder:
        viewer = Viewer(program, display, [os.path.abspath(scene)], folder, ("--metrics", UNTIMED, "--verbose"))
        viewer.wait_for_scene()
        time.sleep(1)
        action(viewer, seconds)
        viewer.end()
        said = re.search(r"\d+ pictures in motion.*", viewer.text())
        if not said:
            sys.exit(f"the window says nothing about its pictures:\n{viewer.text()}")
        print(f"{what}: {said.group()}")


def main():
    program, scene = os.path.abspath(sys.argv[1]), sys.argv[2]
    seconds = float(sys.argv[3]) if len(sys.argv) > 3 else 8
    measure(program, scene, "turned with the mouse", turn, seconds)
    measure(program, scene, "moved with the keys", move, seconds)


if __name__ == "__main__":
    main()
