#!/usr/bin/env python3
"""The program where the kernel offers neither Landlock nor seccomp, as in some containers: old_kernel.py PROGRAM

A filter makes both fail before the program starts. Assets are still read, references out of the folder still
refused, and --verbose says what is missing. Exit code 77 where no filter can be set.
"""
import ctypes
import os
import platform
import struct
import subprocess
import sys
import tempfile

SECCOMP_CALL = {"x86_64": 317, "aarch64": 277}
LANDLOCK_CALLS = (444, 445, 446)
EPERM = 1


def refuse_calls(calls):
    """Called in the child before it becomes the program."""
    load, equal, back = 0x20, 0x15, 0x06
    steps = [struct.pack("<HBBI", load, 0, 0, 0)]
    for call in calls:
        steps.append(struct.pack("<HBBI", equal, 0, 1, call))
        steps.append(struct.pack("<HBBI", back, 0, 0, 0x00050000 | EPERM))
    steps.append(struct.pack("<HBBI", back, 0, 0, 0x7FFF0000))
    code = ctypes.create_string_buffer(b"".join(steps))
    program = struct.pack("HxxxxxxP", len(steps), ctypes.addressof(code))
    libc = ctypes.CDLL(None)
    if libc.prctl(38, 1, 0, 0, 0) != 0 or libc.prctl(22, 2, program, 0, 0) != 0:
        os._exit(77)


def main():
    calls = [*LANDLOCK_CALLS, SECCOMP_CALL.get(platform.machine(), 0)]
    if calls[-1] == 0:
        print("skipped: no numbers of system calls for", platform.machine())
        return 77
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "a.obj"), "w", encoding="utf-8") as file:
            file.write("mtllib ../outside.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        run = subprocess.run([os.path.abspath(sys.argv[1]), "analyze", "--verbose", "--no-cache", "--metrics", "distance",
                              "a.obj"], cwd=folder, capture_output=True, text=True, check=False,
                             preexec_fn=lambda: refuse_calls(calls))
    if run.returncode == 77:
        print("skipped: no filter can be set here")
        return 77
    wanted = ["offers no Landlock", "offers no seccomp", "leads out of the asset's folder"]
    missing = [words for words in wanted if words not in run.stderr]
    if run.returncode != 0 or missing:
        print(f"exit code {run.returncode}, not said: {missing}\n{run.stderr}")
        return 1
    print("read without Landlock and seccomp, and said so")
    return 0


if __name__ == "__main__":
    sys.exit(main())
