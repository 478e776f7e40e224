#!/usr/bin/env python3
"""The manifests of docker/kubernetes against what a cluster would refuse or quietly get wrong: kubernetes_test.py PROGRAM

There is no cluster here. What is checked: the rules of the batch/v1 API that these manifests touch, that exit codes and
options are those of the program, that the shell around the program turns each exit code into the right one, and that
these checks notice manifests that are wrong.
"""
import copy
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time

import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDER = ROOT / "docker/kubernetes"
EXIT_CODES = ROOT / "src/host/cli/exit_code.h"
TRY_ELSEWHERE = 75  # what the shell makes of 2 on a node without a usable device

# Unknown fields are dropped by a server without a word, unless the client validates.
FIELDS = {
    "job": "apiVersion kind metadata spec",
    "spec": "activeDeadlineSeconds backoffLimit backoffLimitPerIndex completionMode completions managedBy manualSelector "
            "maxFailedIndexes parallelism podFailurePolicy podReplacementPolicy selector successPolicy suspend template "
            "ttlSecondsAfterFinished",
    "rule": "action onExitCodes onPodConditions",
    "onExitCodes": "containerName operator values",
    "template": "metadata spec",
    "pod": "activeDeadlineSeconds affinity automountServiceAccountToken containers imagePullSecrets initContainers "
           "nodeSelector priorityClassName restartPolicy runtimeClassName schedulerName securityContext serviceAccountName "
           "terminationGracePeriodSeconds tolerations topologySpreadConstraints volumes",
    "container": "args command env envFrom image imagePullPolicy lifecycle name resources securityContext "
                 "terminationMessagePath terminationMessagePolicy volumeMounts workingDir",
}
LARGEST = 100_000  # completions and parallelism of an Indexed Job


def unknown_fields(kind, found, place):
    return [f"{place}: unknown field {name}" for name in found if name not in FIELDS[kind].split()]


def problems_of_rule(rule, containers, indexed_retries, codes):
    found = unknown_fields("rule", rule, "rule")
    actions = {"FailJob", "Ignore", "Count"} | ({"FailIndex"} if indexed_retries else set())
    if rule.get("action") not in actions:
        found.append(f"action {rule.get('action')}: possible are {sorted(actions)}")
    if ("onExitCodes" in rule) == ("onPodConditions" in rule):
        found.append("a rule has either onExitCodes or onPodConditions")
    for condition in rule.get("onPodConditions", []):
        if not isinstance(condition.get("status", "True"), str):
            found.append("the status of a condition is a string: quote it")
    if "onExitCodes" in rule:
        found += problems_of_exit_codes(rule["onExitCodes"], containers, codes)
    return found


def problems_of_exit_codes(on_codes, containers, codes):
    found = unknown_fields("onExitCodes", on_codes, "onExitCodes")
    values = on_codes.get("values", [])
    if not 1 <= len(values) <= 255 or values != sorted(set(values)):
        found.append(f"values {values}: 1 to 255, in order, none twice")
    if on_codes.get("operator") not in ("In", "NotIn") or (on_codes.get("operator") == "In" and 0 in values):
        found.append("operator is In or NotIn, and In cannot have 0")
    if on_codes.get("containerName") not in containers:
        found.append(f"container {on_codes.get('containerName')} does not exist")
    found += [f"exit code {value} is none of the program's failures" for value in values if value not in codes - {0}]
    return found


def problems_of_policy(spec, pod, codes):
    rules = spec.get("podFailurePolicy", {}).get("rules", [])
    found = []
    if not 1 <= len(rules) <= 20:
        found.append("a podFailurePolicy has 1 to 20 rules")
    if pod.get("restartPolicy") != "Never":
        found.append("podFailurePolicy and backoffLimitPerIndex need restartPolicy: Never")
    if spec.get("podReplacementPolicy", "Failed") != "Failed":
        found.append("with a podFailurePolicy, podReplacementPolicy can only be Failed")
    containers = [each["name"] for each in pod.get("initContainers", []) + pod["containers"]]
    for rule in rules:
        found += problems_of_rule(rule, containers, "backoffLimitPerIndex" in spec, codes)
    # A pod that is evicted ends with an exit code, too: that rule has to be asked first.
    first = rules[0] if rules else {}
    if first.get("action") != "Ignore" or "DisruptionTarget" not in [c["type"] for c in first.get("onPodConditions", [])]:
        found.append("the first rule ignores DisruptionTarget")
    return found


def problems_of_indexes(spec, environment):
    found = []
    completions, parallelism = spec.get("completions"), spec.get("parallelism", 1)
    if spec.get("completionMode") != "Indexed":
        found += [f"{name} needs completionMode: Indexed" for name in ("backoffLimitPerIndex", "maxFailedIndexes")
                  if name in spec]
        return found
    if not isinstance(completions, int) or not 1 <= completions <= LARGEST or not 0 <= parallelism <= LARGEST:
        return [f"completions and parallelism of an Indexed Job are given and at most {LARGEST}"]
    if "maxFailedIndexes" in spec:
        if "backoffLimitPerIndex" not in spec:
            found.append("maxFailedIndexes needs backoffLimitPerIndex")
        if spec["maxFailedIndexes"] > completions:
            found.append("maxFailedIndexes is more than there are indexes")
    if environment.get("SHARD_COUNT") != str(completions):
        found.append(f"SHARD_COUNT is {environment.get('SHARD_COUNT')!r}, not \"{completions}\": shards would be missing")
    if parallelism > completions:
        found.append("parallelism is more than there are indexes")
    return found


def problems_of_pod(pod):
    found = unknown_fields("pod", pod, "pod")
    volumes = {volume["name"]: volume for volume in pod.get("volumes", [])}
    mounted = set()
    for container in pod["containers"]:
        found += unknown_fields("container", container, container["name"])
        for variable in container.get("env", []):
            if "value" in variable and not isinstance(variable["value"], str):
                found.append(f"{variable['name']}: values of variables are strings: quote it")
        for mount in container.get("volumeMounts", []):
            mounted.add(mount["name"])
            if mount["name"] not in volumes:
                found.append(f"volume {mount['name']} is mounted and does not exist")
            if mount["name"] == "library" and mount.get("readOnly") is not True:
                found.append("the library is mounted read-only")
        for name, wanted in container.get("resources", {}).get("requests", {}).items():
            limit = container["resources"].get("limits", {}).get(name)
            if "/" in name and wanted != limit:
                found.append(f"{name}: requests and limits of devices are equal")
    found += [f"volume {name} is not used" for name in set(volumes) - mounted]
    return found


def problems_of(job, codes):
    spec, template = job["spec"], job["spec"]["template"]
    pod = template["spec"]
    found = unknown_fields("job", job, "job") + unknown_fields("spec", spec, "spec")
    found += unknown_fields("template", template, "template") + problems_of_pod(pod)
    if (job["apiVersion"], job["kind"]) != ("batch/v1", "Job"):
        found.append("not a batch/v1 Job")
    if not re.fullmatch("[a-z0-9]([-a-z0-9]{0,61}[a-z0-9-])?", job["metadata"].get("name") or job["metadata"]["generateName"]):
        found.append("names have at most 63 lower-case letters, digits and dashes")
    environment = {each["name"]: each.get("value") for each in pod["containers"][0].get("env", [])}
    return found + problems_of_policy(spec, pod, codes) + problems_of_indexes(spec, environment)


def program_exit_codes(program):
    """Those of the enumeration, and those that --help explains."""
    named = re.findall(r"^ +k\w+\s*=\s*(\d+)", EXIT_CODES.read_text(encoding="utf-8"), re.MULTILINE)
    for command in ("batch", "merge"):
        text = subprocess.run([program, command, "--help"], capture_output=True, text=True, check=False).stdout
        for codes in re.findall(r"^ {2}(\d+(?:, \d+)*) {2}", text.partition("Exit codes:")[2], re.MULTILINE):
            named += codes.split(", ")
    return set(map(int, named))


def load(name):
    return yaml.safe_load((FOLDER / name).read_text(encoding="utf-8"))


def words_of(job):
    container = job["spec"]["template"]["spec"]["containers"][0]
    return " ".join(map(str, container["command"] + container["args"]))


def problems_of_options(program, command, text):
    run = subprocess.run([program, command, "--help"], capture_output=True, text=True, check=False)
    if run.returncode != 0:
        return [f"{program} {command} --help: exit code {run.returncode}"]
    known = re.findall(r"--[a-z][a-z-]*", run.stdout)
    used = {option for line in re.findall(rf"scene-analyzer {command}\b[^\n]*", text)
            for option in re.findall(r"--[a-z][a-z-]*", line)}
    return [f"{command} has no option {option}" for option in sorted(used - set(known))] + \
        ([] if used else [f"no call of {command} was found"])


# (how a manifest is broken, a word of the problem that has to be found)
BROKEN = [
    (lambda job: job["spec"].update(backOffLimitPerIndex=1), "unknown field"),
    (lambda job: job["spec"].update(completions=33), "SHARD_COUNT"),
    (lambda job: job["spec"].pop("completionMode"), "needs completionMode"),
    (lambda job: job["spec"].pop("backoffLimitPerIndex"), "FailIndex"),
    (lambda job: job["spec"].update(maxFailedIndexes=100), "maxFailedIndexes"),
    (lambda job: job["spec"].update(podReplacementPolicy="TerminatingOrFailed"), "podReplacementPolicy"),
    (lambda job: job["spec"]["podFailurePolicy"]["rules"].reverse(), "first rule"),
    (lambda job: job["spec"]["podFailurePolicy"]["rules"][1]["onExitCodes"].update(values=[2, 0]), "in order"),
    (lambda job: job["spec"]["podFailurePolicy"]["rules"][1]["onExitCodes"].update(values=[42]), "none of the program's"),
    (lambda job: job["spec"]["podFailurePolicy"]["rules"][1]["onExitCodes"].update(containerName="main"), "does not exist"),
    (lambda job: job["spec"]["podFailurePolicy"]["rules"][0]["onPodConditions"][0].update(status=True), "quote it"),
    (lambda job: job["spec"]["template"]["spec"].update(restartPolicy="OnFailure"), "restartPolicy"),
    (lambda job: job["spec"]["template"]["spec"]["containers"][0]["env"][0].update(value=32), "quote it"),
    (lambda job: job["spec"]["template"]["spec"]["containers"][0]["volumeMounts"][0].pop("readOnly"), "read-only"),
    (lambda job: job["spec"]["template"]["spec"]["volumes"].pop(), "does not exist"),
]


def unnoticed(job, codes):
    found = []
    for i, (change, word) in enumerate(BROKEN):
        broken = copy.deepcopy(job)
        change(broken)
        if not any(word in problem for problem in problems_of(broken, codes)):
            found.append(f"broken manifest {i} ({word}) is not noticed")
    return found


DOUBLE = """#!/bin/sh
[ "$1" = devices ] && exit {selftest}
[ -z "{wait}" ] || {{ trap 'exit {code}' TERM; touch started; while :; do sleep 0.05; done; }}
exit {code}
"""


def code_of_shell(job, code, selftest=0, stop=False):
    """What the container's command makes of the program's exit code."""
    container = job["spec"]["template"]["spec"]["containers"][0]
    with tempfile.TemporaryDirectory() as folder:
        double = pathlib.Path(folder, "scene-analyzer")
        double.write_text(DOUBLE.format(code=code, selftest=selftest, wait="yes" if stop else ""), encoding="utf-8")
        double.chmod(0o755)
        with subprocess.Popen(container["command"] + container["args"], cwd=folder,
                              env={**os.environ, "PATH": f"{folder}:{os.environ['PATH']}"}) as shell:
            while stop and not os.path.exists(os.path.join(folder, "started")) and shell.poll() is None:
                time.sleep(0.02)
            if stop:
                shell.send_signal(signal.SIGTERM)
            return shell.wait(timeout=30)


def problems_of_shell(job):
    expected = [  # the program's exit code, other circumstances, the container's exit code
        (0, {}, 0), (3, {}, 0), (2, {}, 2), (2, {"selftest": 2}, TRY_ELSEWHERE), (137, {}, 137), (143, {"stop": True}, 143)]
    found = []
    for code, circumstances, wanted in expected:
        got = code_of_shell(job, code, **circumstances)
        if got != wanted:
            found.append(f"the shell makes {got} of {code} {circumstances}, not {wanted}")
    return found


def main():
    program = os.path.abspath(sys.argv[1])
    codes = program_exit_codes(program)
    analyze, merge = load("analyze-library.yaml"), load("merge-library.yaml")
    problems = problems_of(analyze, codes) + problems_of(merge, codes)
    problems += problems_of_options(program, "batch", words_of(analyze))
    problems += problems_of_options(program, "merge", words_of(merge))
    problems += problems_of_options(program, "devices", words_of(analyze))
    problems += problems_of_shell(analyze) + unnoticed(analyze, codes)
    for problem in problems:
        print("FAILED:", problem)
    if not problems:
        print(f"2 manifests are right, {len(BROKEN)} broken ones were noticed")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
