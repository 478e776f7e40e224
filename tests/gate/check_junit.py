"""check_junit.py FILE : exit 0 when the file follows the rules of JUnit XML, 1 with every fault otherwise.

The rules are those of junit-10.xsd of Jenkins' xUnit plugin, for the elements that can occur, and that totals are the
counts of what is there.
"""

import sys
import xml.etree.ElementTree as ElementTree

# element: (required attributes, optional attributes, children that may occur)
RULES = {
    "testsuites": (set(), {"name", "time", "tests", "failures", "disabled", "errors"}, {"testsuite"}),
    "testsuite": (
        {"name", "tests"},
        {"failures", "errors", "time", "disabled", "skipped", "timestamp", "hostname", "id", "package"},
        {"properties", "testcase", "system-out", "system-err"},
    ),
    "testcase": (
        {"name"},
        {"classname", "assertions", "time", "status"},
        {"skipped", "error", "failure", "system-out", "system-err"},
    ),
    "skipped": (set(), {"message", "type"}, set()),
    "error": (set(), {"message", "type"}, set()),
    "failure": (set(), {"message", "type"}, set()),
    "system-out": (set(), set(), set()),
}
COUNTS = {"tests", "failures", "errors", "skipped", "disabled"}


def structure_faults(element):
    if element.tag not in RULES:
        yield f"<{element.tag}> is unknown"
        return
    required, optional, children = RULES[element.tag]
    for name in required - set(element.attrib):
        yield f"<{element.tag}> lacks {name}"
    for name, value in element.attrib.items():
        if name not in required | optional:
            yield f"<{element.tag}> may not have {name}"
        if name in COUNTS and not value.isdigit():
            yield f"{name}={value!r} is no count"
    for child in element:
        if child.tag not in children:
            yield f"<{child.tag}> may not be in <{element.tag}>"
        yield from structure_faults(child)
    if element.tag == "testcase" and sum(child.tag in ("skipped", "error", "failure") for child in element) > 1:
        yield f"{element.get('name')} has several outcomes"


def count_faults(element):
    cases = list(element.iter("testcase"))
    found = {
        "tests": len(cases),
        "failures": sum(case.find("failure") is not None for case in cases),
        "errors": sum(case.find("error") is not None for case in cases),
        "skipped": sum(case.find("skipped") is not None for case in cases),
    }
    for name, count in found.items():
        if name in element.attrib and element.get(name) != str(count):
            yield f"<{element.tag} {name}={element.get(name)!r}>, but there are {count}"


def main(path):
    root = ElementTree.parse(path).getroot()
    faults = list(structure_faults(root)) + list(count_faults(root))
    if root.tag != "testsuites":
        faults.append(f"the root is <{root.tag}>")
    for suite in root.iter("testsuite"):
        faults += count_faults(suite)
    names = [(case.get("classname"), case.get("name")) for case in root.iter("testcase")]
    if len(set(names)) != len(names):
        faults.append("two cases have one name")
    for fault in faults:
        print(f"{path}: {fault}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
