"""The TV and its stand, part by part as the ratings list them. The TV faces +z; its foot stands on y = 0."""

from .maths import add, mix, sincos
from .mesh import ALONG_X, ALONG_Y, ALONG_Z, Mesh
from .shapes import circle, ellipse, lifted, rounded_rectangle, staggered, swept

SCREEN_WIDTH, SCREEN_HEIGHT = 1.06, 0.60
SCREEN_BOTTOM = 0.16
RIM = 0.035  # of the frame, around the screen
STAND_WIDTH, STAND_DEPTH, STAND_HEIGHT = 1.30, 0.42, 0.45
BOARD_THICKNESS = 0.022
LOWER_BOARD = 0.16


def screen():
    """Two triangles whose areas differ by 4e-5: enough to count as different, too little to see."""
    mesh = Mesh()
    x, top = SCREEN_WIDTH / 2, SCREEN_HEIGHT
    a, b, c, d = mesh.points([(-x, 0, 0), (x, 0, 0), (x, top, 0), (-x, top * (1 + 4e-5), 0)])
    mesh.triangles += [(a, b, c), (a, c, d)]
    return mesh


def frame():
    """360 triangles: a rounded rectangle of 20 stations, profile of 9 points with a flat back."""
    profile = [(0.0, -0.03), (RIM, -0.03), (RIM, 0.004), (RIM - 0.004, 0.010), (RIM - 0.010, 0.013),
               (0.018, 0.014), (0.008, 0.012), (0.002, 0.006), (0.0, 0.002)]
    mesh = Mesh()
    rows = []
    for k, (out, z) in enumerate(profile):
        outline = rounded_rectangle(SCREEN_WIDTH + 2 * out, SCREEN_HEIGHT + 2 * out, 0.012 + out, 5)
        outline = staggered(outline) if k == 5 else outline
        rows.append(lifted(outline, z, ALONG_Z, (0, SCREEN_HEIGHT / 2, 0)))
    mesh.ring(rows)
    return mesh


def casing_sides():
    """82 triangles: one strap around sides and bottom behind the frame, 7 x 6 points, one end domed."""
    x, y = SCREEN_WIDTH / 2 - 0.05, 0.03
    path = [(-x, 0.42, 0), (-x, y + 0.08, 0), (-x + 0.08, y, 0), (x - 0.08, y, 0),
            (x, y + 0.08, 0), (x, 0.42, 0)]
    profiles = swept(lambda i, t: ellipse(7, 0.028, 0.035, 0.5 if i in (1, 4) else 0.0), path, (0, 0, 1))
    mesh = Mesh()
    mesh.loft(profiles, top=(x, 0.44, 0))
    return mesh


def casing_front():
    """22 triangles: a wedge below the screen that carries the brand name, 6 x 2 points and a domed end."""
    mesh = Mesh()
    outline = [(-0.018, -0.012), (0.0, -0.018), (0.018, -0.012), (0.018, 0.010), (0.0, 0.014),
               (-0.018, 0.010)]
    mesh.loft([lifted(outline, x, ALONG_X) for x in (-0.26, 0.26)], top=(0.275, 0, 0))
    return mesh


def base():
    """252 triangles: an oval foot that narrows to the neck, 16 x 8 points."""
    rings = []
    for k, (y, wide, deep) in enumerate(((0.0, 0.23, 0.13), (0.010, 0.23, 0.13), (0.017, 0.20, 0.11),
                                         (0.022, 0.10, 0.06), (0.035, 0.05, 0.035), (0.07, 0.04, 0.022),
                                         (0.17, 0.05, 0.022), (0.26, 0.09, 0.018))):
        outline = ellipse(16, deep, wide, 0.5 if k in (2, 4, 6) else 0.0)
        rings.append(lifted(outline, y, ALONG_Y, (0, 0, -0.04)))
    mesh = Mesh()
    mesh.loft(rings)
    return mesh


def button_case():
    """36 triangles: the little housing of the buttons below the frame, 4 x 5 points."""
    rings = []
    waist = ((-0.05, 0.006), (-0.04, 0.012), (0.0, 0.013), (0.04, 0.012), (0.05, 0.006))
    for k, (x, half) in enumerate(waist):
        rings.append(lifted(circle(4, half * 1.3, 0.56 if k == 2 else 0.5), x, ALONG_X))
    mesh = Mesh()
    mesh.loft(rings)
    return mesh


def buttons():
    """584 triangles: two round push buttons of 21 x 7 points, wall upright, dome in zigzag rows."""
    mesh = Mesh()
    for x in (-0.022, 0.022):
        rings = [lifted(circle(21, radius * 0.0105, phase), z * 0.0105, ALONG_Z, (x, 0, 0))
                 for radius, z, phase in ((1.0, 0.0, 0), (1.0, 0.45, 0), (0.96, 0.62, 0), (0.86, 0.76, 0.5),
                                          (0.68, 0.88, 0), (0.46, 0.96, 0.5), (0.22, 1.0, 0))]
        mesh.loft(rings, top=(x, 0, 0.0105 * 1.01))
    return mesh


def stand_boards():
    """120 triangles: two rounded boards of 16 x 2 points."""
    mesh = Mesh()
    outline = rounded_rectangle(STAND_DEPTH, STAND_WIDTH, 0.05, 4)
    for y in (LOWER_BOARD, STAND_HEIGHT - BOARD_THICKNESS):
        mesh.loft([lifted(outline, y + h, ALONG_Y) for h in (0.0, BOARD_THICKNESS)])
    return mesh


def stand_legs():
    """256 triangles: a front and a back leg, bent tubes of 8 x 8 points with pointed ends, at x = 0."""
    mesh = Mesh()
    for side in (-1, 1):
        path = []
        for k in range(8):
            t = k / 7
            bend = sincos(t / 2)[0] * 0.03 + (0.03 if t < 0.2 else 0.0) * (1 - t)
            path.append((bend * 0.6, mix(0.008, STAND_HEIGHT - 0.030, t), side * (0.15 + bend)))
        mesh.loft(swept(lambda i, t: circle(8, mix(0.016, 0.022, t), 0.5), path, (1, 0, 0)),
                  bottom=add(path[0], (0, -0.008, 0)), top=add(path[-1], (0, 0.006, 0)))
    return mesh


def rack():
    """196 triangles: seven twisted rods of 8 x 2 points between the boards, for discs."""
    mesh = Mesh()
    for j in range(7):
        rings = [lifted(circle(8, 0.008, phase), y, ALONG_Y, (0, 0, (j - 3) * 0.045))
                 for y, phase in ((LOWER_BOARD + BOARD_THICKNESS + 0.001, 0.0),
                                  (STAND_HEIGHT - BOARD_THICKNESS - 0.001, 0.5))]
        mesh.loft(rings)
    return mesh
