"""ci_page.py PROGRAM PAGE : exit 0 when what docs/ci.md lets people copy is right, 1 with every fault otherwise.

YAML parses and has what its service needs, scripts in it are good shell, every command and option of the program
exists in its --help, and the program takes every budget.
"""

import pathlib
import re
import subprocess
import sys
import tempfile

import yaml

FENCE = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def help_of(program, command):
    result = subprocess.run([program, command, "--help"], capture_output=True, text=True, check=False)
    return result.stdout if result.returncode == 0 else None


def commands_in(page):
    """(command, its options) of every call of the program, with lines that end in a backslash joined."""
    for line in page.replace("\\\n", " ").splitlines():
        for call in re.findall(r"scene-analyzer ([a-z]+)((?: [^`|;&#]*)?)", line):
            yield call[0], re.findall(r"(?<!\S)--[a-z-]+", call[1])


def option_faults(program, page):
    helps = {}
    calls = list(commands_in(page))
    if not any(command == "check" and "--budget" in options for command, options in calls):
        yield "no call of check was found"
    for command, options in calls:
        if command not in helps:
            helps[command] = help_of(program, command)
        if helps[command] is None:
            yield f"the program has no command {command}"
            continue
        known = set(re.findall(r"--[a-z-]+", helps[command]))
        yield from (f"{command} has no option {option}" for option in options if option not in known)
    for option in re.findall(r"`(--[a-z-]+)", page):
        if option not in set(re.findall(r"--[a-z-]+", help_of(program, "check"))):
            yield f"check has no option {option}"


def shell_faults(script):
    result = subprocess.run(["bash", "-n"], input=script, capture_output=True, text=True, check=False)
    if result.returncode != 0:
        yield f"{script[:60]!r}...: {result.stderr.strip()}"


def workflow_faults(workflow):
    # YAML 1.1 takes the key `on` for a truth value.
    for key in ("name", True, "jobs"):
        if key not in workflow:
            yield f"a workflow without {'on' if key is True else key}"
    for name, job in workflow["jobs"].items():
        if "runs-on" not in job or not job.get("steps"):
            yield f"job {name} lacks runs-on or steps"
        for step in job.get("steps", []):
            if ("run" in step) == ("uses" in step):
                yield f"a step has to have one of run and uses: {step}"
            if "uses" in step and not re.fullmatch(r"[\w.-]+(/[\w.-]+)+@v\d+", step["uses"]):
                yield f"{step['uses']} names no version"
            yield from shell_faults(step.get("run", ""))


def yaml_faults(text):
    try:
        document = yaml.safe_load(text)
    except yaml.YAMLError as error:
        yield f"YAML: {error}"
        return
    if "jobs" in document:
        yield from workflow_faults(document)
        return
    for name, job in document.items():
        if not job.get("script"):
            yield f"job {name} has no script"
        for line in job.get("script", []):
            yield from shell_faults(line)


def budget_faults(program, text):
    with tempfile.TemporaryDirectory() as folder:
        budget = pathlib.Path(folder, "budget.toml")
        budget.write_text(text, encoding="utf-8")
        # The asset is missing, which is another exit code than a budget that is refused.
        command = [program, "check", "none.glb", "--quiet", "--budget", str(budget)]
        result = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
        if result.returncode != 3:
            yield f"a budget is refused: {result.stderr.strip()}"


def main(program, path):
    page = pathlib.Path(path).read_text(encoding="utf-8")
    blocks = FENCE.findall(page)
    faults = list(option_faults(program, page))
    for language, text in blocks:
        if language == "yaml":
            faults += yaml_faults(text)
        elif language == "toml":
            faults += budget_faults(program, text)
    kinds = [language for language, _ in blocks]
    if kinds.count("yaml") < 2 or "toml" not in kinds:
        faults.append("the page has lost its workflows or its budget")
    for fault in faults:
        print(f"{path}: {fault}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(str(pathlib.Path(sys.argv[1]).resolve()), sys.argv[2]))
