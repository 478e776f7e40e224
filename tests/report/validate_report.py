"""validate_report.py SCHEMA REPORT... : exit 0 when every report follows the schema, 1 with every fault otherwise."""

import json
import sys

from jsonschema import Draft202012Validator


def refuse_constant(name):
    raise ValueError(f"{name} is not JSON")


def main(schema_path, report_paths):
    with open(schema_path, encoding="utf-8") as file:
        schema = json.load(file)
    Draft202012Validator.check_schema(schema)
    validator = Draft202012Validator(schema)
    faults = 0
    for path in report_paths:
        with open(path, encoding="utf-8") as file:
            report = json.load(file, parse_constant=refuse_constant)
        for error in validator.iter_errors(report):
            faults += 1
            print(f"{path}: {'/'.join(map(str, error.absolute_path))}: {error.message[:200]}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
