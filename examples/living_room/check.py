"""Compares a demo scene with the thesis' table: counts exactly, rows fixed by geometry as printed there."""

from collections import namedtuple

from . import glb_reader, ratings, spectrum

# Ratings as the thesis prints them; geometry decides those of `fixed` rows, the others are for comparison.
Row = namedtuple("Row", "names triangles pppg pgv rd ccm ft fixed")


def numbered(name, count):
    return ["%s %d" % (name, i + 1) for i in range(count)]


TABLE = [
    Row(["Big couch"], 1430, 0.5115, 0.1284, -0.1765, 0.0074, 0.1803, False),
    Row(["Small couch"], 1430, 0.3933, 0.0723, -0.1761, 0.0084, 0.1520, False),
    Row(numbered("Couch leg", 8), 40, 0.7180, 0.3873, -0.1720, 0.3333, 0.0919, True),
    Row(numbered("Table leg", 4), 40, 0.7180, 0.3873, -0.1751, 0.3333, 0.1337, True),
    Row(["Controller"], 4404, 0.3518, 0.0299, 0.1402, 0.0012, 0.0861, False),
    Row(["TV stand: both boards"], 120, 0.7059, 0.2517, -0.1771, 0.0886, 0.3431, False),
    Row(["TV stand: left legs", "TV stand: right legs"], 256, 0.1412, 0.0574, -0.1722, 0.0997, 0.1421, False),
    Row(["TV stand: rack"], 196, 0.3231, 0.1225, -0.1740, 0.0209, 0.2705, False),
    Row(["Base of TV"], 252, 0.3028, 0.0842, -0.1752, 0.0209, 0.4248, False),
    Row(["TV buttons: case"], 36, 0.2286, 0.1571, -0.1247, 0.1223, 0.3091, False),
    Row(["TV frame: two buttons"], 584, 0.2161, 0.0618, 1.0000, 0.0238, 0.1625, False),
    Row(["TV screen"], 2, 1.0000, 1.0000, -0.1773, 1.0000, 0.0000, True),
    Row(["TV frame"], 360, 0.4401, 0.1038, -0.1763, 0.0074, 0.3129, False),
    Row(["TV casing: bottom sides"], 82, 0.1605, 0.0960, -0.1751, 0.0896, 0.2430, False),
    Row(["TV casing: bottom front"], 22, 0.3810, 0.2911, -0.1758, 0.1755, 0.3704, False),
    Row(["TV: brand name"], 2244, 0.2893, 0.0242, 0.9212, 0.0029, 0.0858, False),
    Row(["Table: top boards"], 332, 0.3867, 0.0682, -0.1766, 0.0158, 0.2861, False),
    Row(["Table: bottom boards"], 332, 0.3354, 0.0635, -0.1763, 0.0158, 0.2851, False),
    Row(["Floor"], 32, 1.0000, 1.0000, -0.1773, 0.0758, 0.0000, True),
    Row(["Small cushion"], 40612, 0.0079, 0.0009, 0.6063, 0.0001, 0.0610, False),
    Row(["Big cushion"], 40612, 0.0071, 0.0008, 0.1141, 0.0001, 0.0609, False),
]

# Half a unit of the last printed digit, and a little more: the thesis prints 28/39 = 0.717949 as 0.7180.
PRINTED = 0.52e-4


def check(data):
    """(table as text, faults as list of texts) of a GLB file's bytes."""
    instances, geometries, _ = glb_reader.read(data)
    measured = [ratings.measures(g) for g in geometries]
    faults = count_faults(instances, measured)
    if faults:
        return "", faults
    densities = [measured[i.mesh].triangles / (measured[i.mesh].area * i.transform.scale**2)
                 for i in instances]
    relative = dict(zip((i.name for i in instances), ratings.relative_densities(densities)))
    mesh_of = {i.name: i.mesh for i in instances}
    lines = ["%-28s %9s %6s %7s %7s %8s %7s %7s"
             % ("mesh", "triangles", "groups", "R_pppg", "R_pgv", "R_rd", "R_ccm", "R_ft")]
    for row in TABLE:
        mesh = mesh_of[row.names[0]]
        transform = spectrum.fourier_transform(ratings.Surface(geometries[mesh])) if row.fixed else None
        lines.append(line(row, measured[mesh], relative[row.names[0]], transform))
        if row.fixed:
            faults += rating_faults(row, measured[mesh], transform)
    return "\n".join(lines), faults


def count_faults(instances, measured):
    """Faults of names, instance counts and triangle counts."""
    expected = {name: row.triangles for row in TABLE for name in row.names}
    found = {i.name: measured[i.mesh].triangles for i in instances}
    faults = ["%s: %s triangles instead of %s" % (name, found.get(name), expected.get(name))
              for name in sorted(set(expected) | set(found)) if found.get(name) != expected.get(name)]
    if len(instances) != len(expected):
        faults.append("%d mesh instances instead of %d" % (len(instances), len(expected)))
    return faults


def rating_faults(row, found, transform):
    pairs = (("R_pppg", found.pppg, row.pppg), ("R_pgv", found.pgv, row.pgv), ("R_ccm", found.ccm, row.ccm),
             ("R_ft", transform, row.ft))
    return ["%s: %s is %.6f instead of %.4f" % (row.names[0], key, value, printed)
            for key, value, printed in pairs if abs(value - printed) > PRINTED]


def line(row, found, density, transform):
    name = row.names[0] if len(row.names) == 1 else "%s (%d)" % (row.names[0], len(row.names))
    return "%-28s %9d %6d %7.4f %7.4f %8.4f %7.4f %7s" % (
        name, found.triangles, found.groups, found.pppg, found.pgv, density, found.ccm,
        "-" if transform is None else "%.4f" % transform)
