#!/usr/bin/env python3
"""Draws what `scene-analyzer analyze` prints on a terminal as SVG: the picture in README.md.

    docs/images/render_table.py build/release/src/host/cli/scene-analyzer examples/living-room.glb docs/images/table.svg

Runs the program on a pseudo-terminal, so that it colours its table, and turns the text and its colours into
rectangles and text. Nothing is added but the command line above the table. Further arguments go to `analyze`.
"""
import fcntl
import os
import pty
import re
import struct
import subprocess
import sys
import termios
from xml.sax.saxutils import escape

COLUMNS = 120
CELL_WIDTH, LINE_HEIGHT, FONT_SIZE, MARGIN = 7.83, 19, 13, 14  # DejaVu Sans Mono at 13 is 7.83 wide
BACKGROUND, FOREGROUND, DIMMED = "#1b1d21", "#e6e6e6", "#9aa0a6"
ESCAPE = re.compile(r"\x1b\[([0-9;]*)([A-Za-z])")


def run_on_terminal(command):
    """Everything that `command` writes to a terminal of COLUMNS columns on standard output."""
    ours, theirs = pty.openpty()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 60, COLUMNS, 0, 0))
    environment = {**os.environ, "TERM": "xterm-256color"}
    environment.pop("NO_COLOR", None)
    with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=theirs, env=environment) as program:
        os.close(theirs)
        written = bytearray()
        while True:
            try:
                piece = os.read(ours, 65536)
            except OSError:  # how Linux says that the other end is closed
                break
            if not piece:
                break
            written += piece
    os.close(ours)
    if program.returncode != 0:
        sys.exit(f"render_table: {' '.join(command)} ended with exit code {program.returncode}")
    return written.decode("utf-8").replace("\r\n", "\n")


def colours_after(codes, foreground, background):
    """The colours after one SGR sequence: a reset or 24-bit colours, which is all that the table uses."""
    numbers = [int(code or 0) for code in codes.split(";")]
    if numbers == [0]:
        return None, None
    if len(numbers) == 5 and numbers[:2] in ([38, 2], [48, 2]):
        colour = "#%02x%02x%02x" % tuple(numbers[2:])
        return (colour, background) if numbers[0] == 38 else (foreground, colour)
    sys.exit(f"render_table: unknown escape sequence {codes!r}")


def runs_of(line):
    """(column, text, foreground, background) of each run of equal colours."""
    runs, column, end = [], 0, 0
    foreground = background = None

    def add(text):
        nonlocal column
        if text:
            runs.append((column, text, foreground, background))
            column += len(text)

    for sequence in ESCAPE.finditer(line):
        add(line[end:sequence.start()])
        end = sequence.end()
        if sequence[2] != "m":
            sys.exit(f"render_table: unknown escape sequence {sequence[0]!r}")
        foreground, background = colours_after(sequence[1], foreground, background)
    add(line[end:])
    return runs


def words_of(column, text):
    """Words apart, each at its own column: the picture stays aligned in whatever font shows it."""
    return [(column + word.start(), word[0]) for word in re.finditer(r"\S+(?: \S+)*", text)]


def draw_line(row, runs, default):
    top = MARGIN + row * LINE_HEIGHT
    for column, text, foreground, background in runs:
        if background:
            yield (f'<rect x="{MARGIN + column * CELL_WIDTH:g}" y="{top}" width="{len(text) * CELL_WIDTH:g}" '
                   f'height="{LINE_HEIGHT}" fill="{background}"/>')
        for at, word in words_of(column, text):
            yield (f'<text x="{MARGIN + at * CELL_WIDTH:g}" y="{top + 14}" textLength="{len(word) * CELL_WIDTH:g}" '
                   f'fill="{foreground or default}">{escape(word)}</text>')


def draw(lines):
    width = 2 * MARGIN + CELL_WIDTH * max(sum(len(run[1]) for run in runs_of(line)) for line in lines)
    height = 2 * MARGIN + LINE_HEIGHT * len(lines)
    yield f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height}" width="{width:.0f}" height="{height}"'
    yield f' font-family="DejaVu Sans Mono, Menlo, Consolas, monospace" font-size="{FONT_SIZE}">'
    yield f'<rect width="100%" height="100%" rx="6" fill="{BACKGROUND}"/>'
    for row, line in enumerate(lines):
        yield from draw_line(row, runs_of(line), DIMMED if row < 2 else FOREGROUND)
    yield "</svg>"


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    program, asset, picture, *options = sys.argv[1:]
    table = run_on_terminal([program, "analyze", "--no-cache", "--quiet", asset, *options])
    shown = " ".join(["$", os.path.basename(program), "analyze", asset, *options])
    lines = [shown, *table.rstrip("\n").split("\n")]
    with open(picture, "w", encoding="utf-8") as file:
        file.write("\n".join(draw(lines)) + "\n")


main()
