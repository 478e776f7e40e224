"""check_sarif.py FILE : exit 0 when the file follows the rules of SARIF 2.1.0, 1 with every fault otherwise.

The rules are those of the OASIS schema sarif-2.1.0 for the objects that can occur (none of which may have properties
that the schema does not know), those of the text that no schema can say (indices lead to what they name), and what
GitHub's code scanning asks for beyond them.
"""

import json
import re
import sys

from jsonschema import Draft202012Validator


def closed(required, **properties):
    return {"type": "object", "additionalProperties": False, "required": required, "properties": properties}


def several(items, **more):
    return {"type": "array", "items": items, **more}


STRING = {"type": "string"}
LEVEL = {"enum": ["none", "note", "warning", "error"]}
MESSAGE = closed(["text"], text={"type": "string", "minLength": 1})
URI = {"type": "string", "pattern": r"^([A-Za-z0-9._~!$&'()*+,;=@/-]|%[0-9A-Fa-f]{2})+$"}  # a relative reference
ARTIFACT = closed(["uri"], uri=URI, uriBaseId=STRING, index={"type": "integer", "minimum": -1})
REGION = closed(["startLine"], startLine={"type": "integer", "minimum": 1})
LOGICAL = closed(["name"], name=STRING, fullyQualifiedName=STRING, kind=STRING)
LOCATION = closed(
    ["physicalLocation"],
    physicalLocation=closed(["artifactLocation", "region"], artifactLocation=ARTIFACT, region=REGION),
    logicalLocations=several(LOGICAL, minItems=1),
)
RULE = closed(
    ["id", "shortDescription", "fullDescription", "help"],
    id=STRING,
    shortDescription=MESSAGE,
    fullDescription=MESSAGE,
    help=MESSAGE,
    defaultConfiguration=closed(["level"], level=LEVEL),
)
DRIVER = closed(
    ["name", "rules"],
    name=STRING,
    version=STRING,
    semanticVersion={"type": "string", "pattern": r"^\d+\.\d+\.\d+$"},
    rules=several(RULE, uniqueItems=True),
)
RESULT = closed(
    ["ruleId", "ruleIndex", "message", "locations", "partialFingerprints"],
    ruleId=STRING,
    ruleIndex={"type": "integer", "minimum": 0},
    level=LEVEL,
    message=MESSAGE,
    locations=several(LOCATION, minItems=1),
    partialFingerprints={"type": "object", "additionalProperties": STRING, "minProperties": 1},
    properties={"type": "object"},
)
NOTIFICATION = closed(
    ["message"],
    level=LEVEL,
    message=MESSAGE,
    associatedRule=closed(["index"], id=STRING, index={"type": "integer", "minimum": 0}),
)
RUN = closed(
    ["tool", "results"],
    tool=closed(["driver"], driver=DRIVER),
    originalUriBaseIds={"type": "object", "additionalProperties": closed([], uri=STRING, description=MESSAGE)},
    invocations=several(
        closed(
            ["executionSuccessful"],
            executionSuccessful={"type": "boolean"},
            toolExecutionNotifications=several(NOTIFICATION),
        )
    ),
    columnKind={"enum": ["utf16CodeUnits", "unicodeCodePoints"]},
    results=several(RESULT, maxItems=5000),  # what GitHub keeps of a run; more than 25000 it refuses
)
LOG = closed(["version", "runs"], **{"$schema": STRING, "version": {"const": "2.1.0"}, "runs": several(RUN, minItems=1)})


def faults_of_run(run):
    rules = run["tool"]["driver"]["rules"]
    if len({rule["id"] for rule in rules}) != len(rules):
        yield "two rules have one id"
    named = [(result["ruleId"], result["ruleIndex"]) for result in run["results"]]
    for invocation in run.get("invocations", []):
        for notification in invocation.get("toolExecutionNotifications", []):
            if rule := notification.get("associatedRule"):
                named.append((rule["id"], rule["index"]))
    for rule_id, index in named:
        if index >= len(rules) or rules[index]["id"] != rule_id:
            yield f"rule {index} is not {rule_id!r}"
    for result in run["results"]:
        for location in result["locations"]:
            base = location["physicalLocation"]["artifactLocation"].get("uriBaseId")
            if base not in run["originalUriBaseIds"]:
                yield f"{base!r} is no base of URIs"
            if re.search(r"[\x00-\x1f]", result["message"]["text"]):
                yield "a message has control characters"


def main(path):
    with open(path, encoding="utf-8") as file:
        log = json.load(file)
    faults = [f"{'/'.join(map(str, e.absolute_path))}: {e.message[:200]}" for e in Draft202012Validator(LOG).iter_errors(log)]
    if not faults:
        faults = [fault for run in log["runs"] for fault in faults_of_run(run)]
    for fault in faults:
        print(f"{path}: {fault}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
