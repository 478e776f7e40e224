"""A virtual display, and the review window on it with real keys and a real mouse. Needs Xvfb and xdotool."""

import glob
import os
import subprocess
import sys
import time

UNTIMED = ("polygons_per_planar_group,planar_group_variation,relative_density,distance,cooccurrence_contrast,"
           "fourier_transform")


def wait_until(condition, what, seconds=60):
    deadline = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > deadline:
            sys.exit(f"FAILED: {what} did not happen within {seconds} s")
        time.sleep(0.02)


class Display:
    def __enter__(self):
        read_end, write_end = os.pipe()
        self.process = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write_end), "-screen", "0", "1280x720x24", "-nolisten", "tcp"],
            pass_fds=[write_end], stderr=subprocess.DEVNULL)
        os.close(write_end)
        with os.fdopen(read_end) as pipe:
            self.name = ":" + pipe.readline().strip()
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait()


class Viewer:
    """One run of the program in a folder of its own, without rendering times unless `arguments` ask for them."""

    def __init__(self, program, display, assets, folder, arguments=("--metrics", UNTIMED)):
        self.folder = folder
        self.environment = dict(os.environ, DISPLAY=display.name, XDG_CACHE_HOME=os.path.join(folder, "cache"))
        self.output = open(os.path.join(folder, "output"), "w+b")
        self.process = subprocess.Popen(
            [program, "view", *assets, "--cache-dir", folder, *arguments],
            cwd=folder, env=self.environment, stdout=self.output, stderr=subprocess.STDOUT)

    def xdotool(self, *arguments):
        subprocess.run(["xdotool", *map(str, arguments)], env=self.environment, check=True,
                       stdout=subprocess.DEVNULL)

    def window(self):
        found = subprocess.run(["xdotool", "search", "--name", "Scene Analyzer"], env=self.environment,
                               capture_output=True, text=True)
        return found.stdout.split()

    def text(self):
        self.output.flush()
        with open(os.path.join(self.folder, "output"), errors="replace") as file:
            return file.read()

    def printed(self):
        """What F12 prints."""
        before = len(self.text())
        self.xdotool("key", "F12")
        wait_until(lambda: "Esc    quit" in self.text()[before:], "printing the keys")
        return self.text()[before:]

    def picture(self, key="F9", kind="picture"):
        """The bytes of the picture that F9 writes."""
        before = set(glob.glob(os.path.join(self.folder, f"scene-{kind}-*.png")))
        self.xdotool("key", key)
        wait_until(lambda: len(self.text().split(f"the {kind} is in ")) > len(before) + 1, "writing a picture")
        (new,) = set(glob.glob(os.path.join(self.folder, f"scene-{kind}-*.png"))) - before
        with open(new, "rb") as file:
            return file.read()

    def window_picture(self):
        """The bytes of the picture of the whole window that F8 writes."""
        return self.picture("F8", "window")

    def wait_for_scene(self):
        wait_until(lambda: self.window() or self.process.poll() is not None, "opening the window")
        # Titles say what is shown once there is something to show.
        wait_until(lambda: subprocess.run(["xdotool", "search", "--name", "Scene Analyzer: "], env=self.environment,
                                          capture_output=True).stdout, "showing the scene")

    def end(self, code=0):
        self.xdotool("key", "Escape")
        wait_until(lambda: self.process.poll() is not None, "quitting")
        check(self.process.returncode == code, f"exit code {self.process.returncode} instead of {code}", self.text())


def check(good, what, details=""):
    if not good:
        sys.exit(f"FAILED: {what}\n{details}")
