#!/usr/bin/env python3
"""The review window under a virtual display, with real keys and a real mouse.

    window_test.py PROGRAM

Every key has to change what is printed (F12), what is drawn (F9) or which files there are. Needs Xvfb and xdotool.
"""

import os
import subprocess
import sys
import tempfile
import time

from window_driver import Display, Viewer, check, wait_until

KEYS_THAT_PRINT = ["F1", "F2", "F3", "F4", "F5", "F6", "F10", "F11", "e", "x", "c"]
KEYS_THAT_MOVE = ["Left", "Right", "Up", "Down", "semicolon", "period", "w", "a", "s", "d", "plus", "minus"]


def try_keys(viewer):
    for key in KEYS_THAT_PRINT:
        before, before_picture = viewer.printed(), viewer.picture()
        viewer.xdotool("key", key)
        after = viewer.printed()
        check(after != before, f"{key} does not change what F12 prints", after)
        check(viewer.picture() != before_picture, f"{key} does not change the picture")
        if key != "c":  # on and off again
            viewer.xdotool("key", key)
            check(viewer.printed() == before, f"{key} twice is not as before")
    for key in KEYS_THAT_MOVE:
        before = viewer.picture()
        viewer.xdotool("keydown", key)
        time.sleep(0.3)
        viewer.xdotool("keyup", key)
        check(viewer.picture() != before, f"{key} does not move the scene")
    before = viewer.picture()
    viewer.xdotool("key", "Home")
    check(viewer.picture() != before, "Home does not show the whole scene")


def wait_for_change(viewer, before, what):
    """On a busy machine a frame takes a while."""
    wait_until(lambda: viewer.picture() != before, what, 20)


def try_mouse(viewer):
    whole, window = viewer.picture(), viewer.window_picture()
    viewer.xdotool("mousemove", 805, 360, "click", 1)  # the middle of the free part: the table
    wait_for_change(viewer, whole, "selecting by a click")
    selected = viewer.picture()
    check(viewer.window_picture() != window, "the window does not show what is selected")
    viewer.xdotool("key", "f")
    wait_for_change(viewer, selected, "showing the selected mesh by f")
    viewer.xdotool("key", "Home", "mousemove", 400, 650, "click", 1)
    wait_until(lambda: viewer.picture() == whole, "deselecting by a click beside the scene", 20)
    for button, what in ((1, "turn"), (3, "shift")):
        before = viewer.picture()
        viewer.xdotool("mousemove", 700, 300)
        time.sleep(0.3)  # several frames for each step, also on a busy machine
        viewer.xdotool("mousedown", button)
        for _ in range(5):
            time.sleep(0.3)
            viewer.xdotool("mousemove_relative", 12, 5)
        time.sleep(0.3)
        viewer.xdotool("mouseup", button)
        check(viewer.picture() != before, f"dragging does not {what} the scene")
    before = viewer.picture()
    viewer.xdotool("click", 4)
    wait_for_change(viewer, before, "zooming by the wheel")


def try_window(viewer):
    (window,) = viewer.window()
    for width, height in ((700, 500), (1200, 300), (1280, 720)):
        viewer.xdotool("windowsize", "--sync", window, width, height)
        time.sleep(0.5)
        header = viewer.picture()[16:24]
        size = (int.from_bytes(header[:4], "big"), int.from_bytes(header[4:], "big"))
        check(size == (width, height), f"the window of {width} x {height} gives a picture of {size}")
    def processor_seconds():
        with open(f"/proc/{viewer.process.pid}/stat") as file:
            return sum(map(int, file.read().rsplit(")", 1)[1].split()[11:13])) / os.sysconf("SC_CLK_TCK")
    time.sleep(1)
    before = processor_seconds()
    time.sleep(2)
    check(processor_seconds() - before < 0.2, "an idle window costs processor time")


def try_ratings_file(viewer):
    viewer.xdotool("key", "p")
    path = os.path.join(viewer.folder, "scene-ratings-1.csv")
    wait_until(lambda: "ratings are in" in viewer.text() and "scene-ratings-1.csv" in viewer.text(), "writing ratings")
    with open(path) as file:
        lines = file.read().splitlines()
    check(len(lines) == 33, f"{len(lines)} lines instead of a head and 32 meshes")


def try_without_display(program, scene):
    environment = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
    run = subprocess.run([program, "view", scene], env=environment, capture_output=True, text=True)
    check(run.returncode == 2, f"exit code {run.returncode} without a display", run.stderr)
    check("--image" in run.stderr, "without a display nothing names --image", run.stderr)


def main():
    program = os.path.abspath(sys.argv[1])
    scene = os.path.join(os.path.dirname(__file__), "..", "..", "examples", "living-room.glb")
    scene = os.path.abspath(scene)
    try_without_display(program, scene)
    with Display() as display, tempfile.TemporaryDirectory() as folder:
        viewer = Viewer(program, display, [scene], folder)
        viewer.wait_for_scene()
        try_keys(viewer)
        try_mouse(viewer)
        try_window(viewer)
        try_ratings_file(viewer)
        viewer.end()
    with Display() as display, tempfile.TemporaryDirectory() as folder:  # closed while it analyses
        viewer = Viewer(program, display, [scene], folder)
        wait_until(lambda: viewer.window() or viewer.process.poll() is not None, "opening the window")
        viewer.end()
    with Display() as display, tempfile.TemporaryDirectory() as folder:  # one bad asset
        viewer = Viewer(program, display, [scene, "/nonexistent.obj"], folder)
        viewer.wait_for_scene()
        wait_until(lambda: "nonexistent.obj" in viewer.text(), "naming the missing asset")
        viewer.end(3)
    print("all keys, the mouse and the window do what they should")


if __name__ == "__main__":
    main()
