#!/usr/bin/env python3
"""The review window while its surface or its device fails, under a virtual display.

    window_faults_test.py PROGRAM LAYER_FOLDER

Faults come from the layer of tests/faults (fault_rules.h has the grammar). Needs Xvfb and xdotool.
"""

import contextlib
import glob
import os
import sys
import tempfile
import time

from window_driver import Display, Viewer, check, wait_until

ACQUIRE, PRESENT = "vkAcquireNextImageKHR", "vkQueuePresentKHR"
CAPABILITIES = "vkGetPhysicalDeviceSurfaceCapabilitiesKHR"
QUAD = "o quad\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n"


@contextlib.contextmanager
def faulty_viewer(program, layers, rule):
    print(rule or "no fault", flush=True)
    os.environ.update({"VK_ADD_LAYER_PATH": layers, "VK_INSTANCE_LAYERS": "VK_LAYER_SCENE_ANALYZER_fault",
                       "SCENE_ANALYZER_FAULT": rule})
    with Display() as display, tempfile.TemporaryDirectory() as folder:
        asset = os.path.join(folder, "quad.obj")
        with open(asset, "w") as file:
            file.write(QUAD)
        viewer = Viewer(program, display, [asset], folder)
        try:
            yield viewer
        finally:
            if viewer.process.poll() is None:
                viewer.process.kill()
                viewer.process.wait()


def processor_seconds(viewer):
    with open(f"/proc/{viewer.process.pid}/stat") as file:
        return sum(map(int, file.read().rsplit(")", 1)[1].split()[11:13])) / os.sysconf("SC_CLK_TCK")


def check_idle(viewer, rule):
    time.sleep(1)
    before = processor_seconds(viewer)
    time.sleep(2)
    used = processor_seconds(viewer) - before
    check(used < 0.3, f"{rule}: an idle window costs {used:.2f} s of processor time in 2 s")


def try_goes_on(program, layers, rule):
    """The window shows the scene, answers keys, sleeps, and ends well."""
    with faulty_viewer(program, layers, rule) as viewer:
        viewer.wait_for_scene()
        before = viewer.picture()
        viewer.xdotool("key", "x")
        check(viewer.picture() != before, f"{rule}: keys change nothing")
        check_idle(viewer, rule)
        viewer.end()
        check("error" not in viewer.text(), f"{rule}: there is an error", viewer.text())


def try_ends(program, layers, rule, *words):
    """The program says why and ends with 2."""
    with faulty_viewer(program, layers, rule) as viewer:
        wait_until(lambda: viewer.process.poll() is not None, f"{rule}: ending")
        check(viewer.process.returncode == 2, f"{rule}: exit code {viewer.process.returncode}", viewer.text())
        errors = [line for line in viewer.text().splitlines() if line.startswith("error: ")]
        check(len(errors) == 1, f"{rule}: {len(errors)} errors", viewer.text())
        for word in words:
            check(word in errors[0], f"{rule}: '{word}' is not said", errors[0])
        check("defect" not in errors[0], f"{rule}: called a defect", errors[0])


def try_review_fails(program, layers, rule):
    """What the assets are analysed on is lost: the window stays and says so."""
    with faulty_viewer(program, layers, rule) as viewer:
        wait_until(lambda: "the GPU was lost" in viewer.text() or viewer.process.poll() is not None,
                   f"{rule}: saying that the device is lost")
        time.sleep(1)  # the window's own device ends the program
        if viewer.process.poll() is None:
            viewer.end(3)
        else:
            check(viewer.process.returncode == 2, f"{rule}: exit code {viewer.process.returncode}", viewer.text())


def try_without_pixels(program, layers):
    """As long as a window has no pixels it sleeps; the analysis goes on."""
    rule = f"{CAPABILITIES}:1+=zero_extent"
    with faulty_viewer(program, layers, rule) as viewer:
        wait_until(lambda: glob.glob(os.path.join(viewer.folder, "**", "*.analysis"), recursive=True), "analysing")
        check_idle(viewer, rule)
        viewer.end()


def try_smallest_window(program, layers):
    with faulty_viewer(program, layers, "") as viewer:
        viewer.wait_for_scene()
        (window,) = viewer.window()
        for width, height in ((1, 1), (1, 300), (300, 1), (2, 3), (1, 1)):
            viewer.xdotool("windowsize", "--sync", window, width, height)
            time.sleep(0.3)
            viewer.xdotool("key", "F9", "x", "Home")
            time.sleep(0.3)
            check(viewer.process.poll() is None, f"a window of {width} x {height} ends the program", viewer.text())
        viewer.xdotool("windowsize", "--sync", window, 1280, 720)
        time.sleep(0.5)
        header = viewer.picture()[16:24]
        size = (int.from_bytes(header[:4], "big"), int.from_bytes(header[4:], "big"))
        check(size == (1280, 720), f"after 1 x 1 the window gives a picture of {size}")
        viewer.end()


def main():
    program, layers = map(os.path.abspath, sys.argv[1:3])
    going_on = [f"{ACQUIRE}:2=out_of_date,{ACQUIRE}:4-6=out_of_date,{PRESENT}:3=out_of_date,{PRESENT}:5-7=out_of_date",
                f"{ACQUIRE}:1+=suboptimal,{PRESENT}:1+=suboptimal",
                f"{ACQUIRE}:2=timeout,{CAPABILITIES}:1-12=zero_extent,{PRESENT}:3=out_of_date"]
    for rule in going_on:
        try_goes_on(program, layers, rule)
    try_without_pixels(program, layers)
    ending = [(f"{function}:{call}={fault}", words)
              for fault, words in (("surface_lost", ("window", "Start again")),
                                   ("device_lost", ("the GPU was lost", "--device")))
              for function, call in ((ACQUIRE, 1), (PRESENT, 3))]
    ending += [(f"{CAPABILITIES}:1=surface_lost", ("window", "Start again")),
               ("vkCreateSwapchainKHR:1=surface_lost", ("window", "Start again")),
               ("vkCreateSwapchainKHR:1=out_of_device_memory", ("out of GPU memory", "--device")),
               ("vkGetPhysicalDeviceSurfaceSupportKHR:1+=false", ("cannot show", "--device"))]
    for rule, words in ending:
        try_ends(program, layers, rule, *words)
    losses = [f"vkQueueSubmit2:{call}=device_lost" for call in (1, 20)]
    for rule in losses:
        try_review_fails(program, layers, rule)
    try_smallest_window(program, layers)
    print(f"{len(going_on)} faults that a window survives, {len(ending)} that end it, {len(losses)} lost devices, "
          "a window without pixels and one of 1 x 1: all as they should be")


if __name__ == "__main__":
    main()
