"""What docs/service.md and docker/compose.yaml let people copy: docs_test.py PROGRAM STUBS PAGE [unittest's own]

The clients run as they stand there and print what `analyze` says; commands are run, tables are compared with what the
service answers. The client in JavaScript needs node with @grpc/grpc-js and @grpc/proto-loader (NODE_PATH, or node_modules
in the source folder), and is skipped without them.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import threading
import unittest
import urllib.request

import yaml

from service_client import *

STUBS = str(pathlib.Path(sys.argv[2]).resolve())
PAGE = pathlib.Path(sys.argv[3]).read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```(\w+)\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
DOCKER = SOURCE / "docker"
OPTION = re.compile(r"(?<![\w-])--[a-z][a-z-]*")
# Commands of programs that have options of their own.
OTHER_COMMANDS = re.compile(r"\b(python3|protoc|openssl|adduser|docker|grpcurl) [^`\n]*")


def block(language, beginning):
    """The only block of that language with a line that begins so."""
    start = re.compile(f"^{re.escape(beginning)}", re.MULTILINE)
    found = [text for kind, text in BLOCKS if kind == language and start.search(text)]
    assert len(found) == 1, f"{len(found)} blocks of {language} begin with '{beginning}'"
    return found[0]


def python_client():
    return block("python", "import pathlib, sys")


def with_upload_of_several(client, variant, end):
    """`client` with its function `upload`, which goes up to `end`, replaced."""
    begin = re.search(r"^(async function\* |def )upload", client, re.MULTILINE).start()
    return client[:begin] + variant + client[client.index(end, begin):]


def with_channel(client, channel, imports=""):
    """`client` with its line `channel = ...` replaced by a block that makes another."""
    changed = re.sub(r"^channel = .*\n", lambda _: imports + channel, client, flags=re.MULTILINE)
    assert changed != client, "the client makes no channel"
    return changed


def start_python(script, *arguments, cwd):
    return subprocess.run([sys.executable, "-", *map(str, arguments)], input=script, capture_output=True, text=True,
                          cwd=cwd, env={**os.environ, "PYTHONPATH": STUBS}, timeout=PATIENCE)


def run_python(script, *arguments, cwd):
    ended = start_python(script, *arguments, cwd=cwd)
    assert ended.returncode == 0, ended.stderr
    return ended.stdout


def run_node(script, *arguments):
    ended = subprocess.run(["node", "-", *map(str, arguments)], input=script, capture_output=True, text=True, cwd=SOURCE,
                           timeout=PATIENCE)
    assert ended.returncode == 0, ended.stderr
    return ended.stdout


def has_node_packages():
    if shutil.which("node") is None:
        return False
    script = "require('@grpc/grpc-js'); require('@grpc/proto-loader')"
    return subprocess.run(["node", "-"], input=script, text=True, cwd=SOURCE, capture_output=True).returncode == 0


def printed(text):
    """[(aggregate, node)] of a client's lines."""
    return [(float(line.split(" ", 1)[0]), line.split(" ", 1)[1]) for line in text.splitlines()]


def aggregates_here(path):
    rows = analyze_here(path, "--metrics", ",".join(QUICK))["meshes"]
    assert rows, f"{path} has no meshes"
    return [(row["aggregate"], row["node"]) for row in rows]


def table(*header):
    """Rows, as lists of cells, of the only table with these first cells in its header."""
    start = re.escape("| " + " | ".join(header) + " |")
    found = re.findall(rf"^{start}.*\n\|[-| :]+\n((?:\|.*\n)+)", PAGE, re.MULTILINE)
    assert len(found) == 1, f"{len(found)} tables with the header {header}"
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in found[0].splitlines()]


def quoted(cell):
    return re.findall(r"`([^`]+)`", cell)


class Clients(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="service-test-docs-")
        cls.root = pathlib.Path(cls.folder.name)
        cls.files = gltf_files()
        cls.hall = write_files(cls.root / "rooms", cls.files)
        shutil.copy(DEMO, cls.root / "rooms" / "hall.glb")
        cls.service = Service("--root", cls.root)

    @classmethod
    def tearDownClass(cls):
        with cls.service:
            pass
        cls.folder.cleanup()

    def all_hall_files(self):
        return [self.root / "rooms" / name for name in self.files]

    def assert_all_were_sent(self):
        size = sum(map(len, self.files.values()))
        wait_until(lambda: re.search(rf"hall\.gltf, {size} bytes sent", self.service.log()), "all bytes are in the log")
        self.service.lines.clear()

    def test_python(self):
        out = run_python(python_client(), self.service.address, DEMO, cwd=self.root)
        self.assertEqual(printed(out), aggregates_here(DEMO))
        self.assertIn(re.search(r"It prints a line for each mesh, `([^`]+)`", PAGE)[1].split(" ", 1)[1], out)

    def test_python_with_several_files(self):
        variant = block("python", "def upload(asset, *others)")
        client = with_upload_of_several(python_client(), variant + "\n", "channel = ")
        out = run_python(client, self.service.address, *self.all_hall_files(), cwd=self.root)
        self.assertEqual(printed(out), aggregates_here(self.hall))
        self.assert_all_were_sent()

    @unittest.skipUnless(has_node_packages(), "node, @grpc/grpc-js or @grpc/proto-loader is missing")
    def test_javascript(self):
        client = block("js", "const fs = ")
        self.assertEqual(printed(run_node(client, self.service.address, DEMO)), aggregates_here(DEMO))
        variant = block("js", "async function* upload(asset, ...others)")
        client = with_upload_of_several(client, variant, "\nasync function main")
        out = run_node(client, self.service.address, *self.all_hall_files())
        self.assertEqual(printed(out), aggregates_here(self.hall))
        self.assert_all_were_sent()

    def test_a_picture(self):
        client = python_client()
        script = client[:client.index("for event in")] + block("python", "order = pb.RenderParameters")
        run_python(script, self.service.address, cwd=self.root)
        picture = (self.root / "hall.png").read_bytes()
        self.assertEqual(struct.unpack(">II", picture[16:24]), (1280, 720))


class Retries(unittest.TestCase):
    """With a queue of one, which another client holds until the service has refused often enough."""

    def ask_while_the_queue_is_full(self, script, refusals):
        with Service("--queue", "1") as service, tempfile.TemporaryDirectory() as folder:
            leave = threading.Event()

            def hold():
                yield pb.AnalyzeRequest(parameters=pb.AnalyzeParameters())
                leave.wait(PATIENCE)
            holder = service.stub().Analyze(hold())
            wait_until(lambda: service.metric("scene_analyzer_requests_admitted") == 1, "the queue is full")
            ended = []
            client = threading.Thread(
                target=lambda: ended.append(start_python(script, service.address, DEMO, cwd=folder)))
            client.start()
            busy = 'scene_analyzer_failures_total{reason="busy"}'
            wait_until(lambda: service.metric(busy) >= refusals or not client.is_alive(), "the client was refused")
            seen = service.metric(busy)
            leave.set()
            client.join()
            self.assertEqual(holder.code(), grpc.StatusCode.INVALID_ARGUMENT)  # it has sent no file
            return seen, ended[0]

    def test_by_grpc(self):
        script = with_channel(python_client(), block("python", "retries = "), "import json\n")
        # The file is larger than what gRPC sends again by default, so that one refusal would be the end.
        self.assertGreater(DEMO.stat().st_size, 256 << 10)
        refused, _ = self.ask_while_the_queue_is_full(script, 2)
        self.assertGreaterEqual(refused, 2, "gRPC has not tried again")

    def test_by_the_client(self):
        client, patiently = python_client(), block("python", "def patiently")
        script = (client[:client.index("for event in")] + "import random, time\nasset = pathlib.Path(sys.argv[2])\n" +
                  patiently + "print(len(result.analysis.instances))\n")
        _, ended = self.ask_while_the_queue_is_full(script, 2)
        self.assertEqual((ended.returncode, ended.stdout), (0, "32\n"), ended.stderr)


class Security(unittest.TestCase):
    def test_certificates_and_tokens(self):
        with tempfile.TemporaryDirectory(prefix="service-test-docs-") as folder:
            subprocess.run(["bash", "-e"], input=block("sh", "openssl"), text=True, cwd=folder, check=True,
                           capture_output=True)
            command = re.search(r"^    scene-analyzer serve (--listen \S+ --tls-cert (?:.*\\\n)*.*)$", PAGE, re.MULTILINE)
            words = command[1].replace("\\\n", " ").split()
            options = [str(pathlib.Path(folder, word)) if word in os.listdir(folder) else word for word in words]
            options[options.index("--listen") + 1] = "0.0.0.0:0"
            with Service(*options) as service:
                address = f"localhost:{service.port}"
                client = with_channel(python_client(), block("python", "credentials = "))
                self.assertEqual(printed(run_python(client, address, DEMO, cwd=folder)), aggregates_here(DEMO))
                for needed in ("grpc.access_token_call_credentials", 'pathlib.Path("client.key")'):
                    self.assertIn(needed, client)
                pathlib.Path(folder, "tokens").write_text("another-token-not-yet-known\n")
                with self.assertRaisesRegex(AssertionError, "UNAUTHENTICATED"):
                    run_python(client, address, DEMO, cwd=folder)
                service.process.send_signal(signal.SIGHUP)
                wait_until(lambda: "tokens were read again" in service.log(), "the tokens are read again")
                run_python(client, address, DEMO, cwd=folder)


class Options(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.help = subprocess.run([PROGRAM, "serve", "--help"], capture_output=True, text=True, check=True).stdout

    def known(self):
        """Option to what --help says of it, without line breaks."""
        entries = re.split(r"^\s+(?:-\w, )?(?=--[a-z])", self.help, flags=re.MULTILINE)[1:]
        return {OPTION.match(entry)[0]: " ".join(entry.split()) for entry in entries}

    def mentioned(self):
        return set(OPTION.findall(OTHER_COMMANDS.sub("", PAGE.replace("\\\n", " "))))

    def test_options_exist(self):
        self.assertGreater(len(self.mentioned()), 15)
        self.assertLessEqual(self.mentioned(), set(self.known()))

    def test_limits_are_those_of_the_help(self):
        rows = {quoted(option)[0]: default for option, _, default in table("option", "of what", "default")}
        limits = re.search(r"^ Limits options:\n(.*?)^ \w+ options:\n", self.help, re.MULTILINE | re.DOTALL)[1]
        self.assertLessEqual(set(OPTION.findall(limits)), set(rows))
        for option, default in rows.items():
            text = self.known()[option]
            self.assertRegex(text, rf"default {re.escape(default)}\b", option)

    def test_calls_exist(self):
        calls = set(re.findall(r"scene_analyzer\.v1\.SceneAnalyzer/(\w+)", PAGE))
        calls |= {name for row in table("call", "what", "measures") for name in quoted(row[0])}
        self.assertEqual(calls, {method.name for method in pb.DESCRIPTOR.services_by_name["SceneAnalyzer"].methods})


class Counted(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.service = Service("--log-format", "json")
        analyze(cls.service.stub(), {"a.obj": obj()})
        wait_until(lambda: "Analyze OK" in cls.service.log(), "it is counted and logged")
        with urllib.request.urlopen(cls.service.metrics_url, timeout=PATIENCE) as answer:
            cls.text = answer.read().decode()

    @classmethod
    def tearDownClass(cls):
        with cls.service:
            pass

    def labels(self, name):
        samples = re.findall(rf"^{name}(?:_count)?(?:{{(.*)}})? ", self.text, re.MULTILINE)
        return set(re.findall(r'(\w+)="', ",".join(samples))) - {"le", "quantile"}

    def test_metrics(self):
        answered = {name: (kind, self.labels(name))
                    for name, kind in re.findall(r"^# TYPE (\S+) (\w+)$", self.text, re.MULTILINE)}
        rows = table("metric", "type", "labels", "meaning")
        self.assertEqual({quoted(name)[0]: (kind, set(quoted(labels))) for name, kind, labels, _ in rows}, answered)
        reasons = next(set(quoted(meaning)) for name, _, _, meaning in rows if "failures" in name)
        series = re.findall(r'^scene_analyzer_failures_total{reason="(\w+)"}', self.text, re.MULTILINE)
        self.assertEqual(reasons, set(series))

    def test_expressions(self):
        lines = block("promql", "").splitlines()
        self.assertEqual(len(lines), 3)
        samples = set(re.findall(r"^(\w+)[{ ]", self.text, re.MULTILINE))
        for line in lines:
            names = set(re.findall(r"\b(?:scene_analyzer|exposer)_\w+", line))
            self.assertTrue(names and names <= samples, f"{line}: {names - samples}")
            for name, selector in re.findall(r"(\w+){(.*?)}", line):
                for label, value in re.findall(r'(\w+)="(\w+)"', selector):
                    self.assertRegex(self.text, rf'(?m)^{name}{{.*\b{label}="{value}"')

    def test_log(self):
        found = re.findall(r"^\| member \| \|\n\|[-|]+\n((?:\|.*\n)+)", PAGE, re.MULTILINE)
        every, of_call = [[name for row in rows.splitlines() for name in quoted(row.split("|")[1])] for rows in found]
        line = next(json.loads(line) for line in self.service.lines if "Analyze OK" in line)
        self.assertEqual(list(line), [name for name in line if name in every + of_call])
        self.assertEqual(set(line), set(every + of_call))
        self.assertEqual(set(json.loads(self.service.lines[0])), set(every))


class Compose(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.compose = yaml.safe_load((DOCKER / "compose.yaml").read_text(encoding="utf-8"))
        cls.analyzer = cls.compose["services"]["analyzer"]
        cls.dockerfile = (DOCKER / "Dockerfile").read_text(encoding="utf-8")
        cls.options = dict(word.removeprefix("--").partition("=")[::2] for word in cls.analyzer["command"][1:])

    def port(self, option):
        return int(self.options[option].rsplit(":", 1)[1])

    def test_it_is_built_from_here(self):
        build = self.analyzer["build"]
        self.assertEqual((DOCKER / build["context"]).resolve(), SOURCE)
        self.assertTrue((SOURCE / build["dockerfile"]).samefile(DOCKER / "Dockerfile"))
        self.assertIn('ENTRYPOINT ["scene-analyzer"]', self.dockerfile)

    def test_what_is_named_is_there(self):
        for name, service in self.compose["services"].items():
            for volume in service["volumes"]:
                source, target = re.fullmatch(r"(\$\{[^}]*\}|[^:]*):([^:]*)(?::ro)?", volume).groups()
                source = re.sub(r"\$\{\w+:-(.*)\}", r"\1", source)
                if source.startswith("."):
                    self.assertTrue((DOCKER / source).exists(), f"{name}: {source}")
                else:
                    self.assertIn(source, self.compose["volumes"], name)
                self.assertTrue(target.startswith("/"), volume)
            for secret in service.get("secrets", []):
                self.assertIn("file", self.compose["secrets"][secret])
        self.assertEqual(self.options["token-file"], "/run/secrets/" + self.analyzer["secrets"][0])
        # Else the volume would belong to root, and the service could not write into it.
        state = next(volume.split(":")[1] for volume in self.analyzer["volumes"] if volume.startswith("state:"))
        self.assertIn(f"install -d -o analyzer -g analyzer {state}", self.dockerfile)
        for path in (self.options["store"], self.analyzer["environment"]["XDG_CACHE_HOME"]):
            self.assertTrue(path.startswith(state + "/"), path)

    def test_ports_and_times_agree(self):
        host, outside, inside = self.analyzer["ports"][0].split(":")
        self.assertEqual((host, int(inside)), ("127.0.0.1", self.port("listen")), "not encrypted: this machine only")
        prometheus = yaml.safe_load((DOCKER / "prometheus.yml").read_text(encoding="utf-8"))
        targets = prometheus["scrape_configs"][0]["static_configs"][0]["targets"]
        self.assertEqual(targets, [f"analyzer:{self.port('metrics-listen')}"])
        self.assertIn(f"/dev/tcp/127.0.0.1/{self.port('metrics-listen')} ", self.analyzer["healthcheck"]["test"][-1])
        grace = int(self.analyzer["stop_grace_period"].removesuffix("s"))
        self.assertGreater(grace, int(self.options["drain-timeout"]))

    def test_the_command_and_its_health_check(self):
        with tempfile.TemporaryDirectory(prefix="service-test-docs-") as folder:
            tokens = pathlib.Path(folder, "tokens")
            tokens.write_text("0123456789abcdef\n")
            here = {"token-file": tokens, "store": pathlib.Path(folder, "store"), "root": SOURCE / "examples"}
            self.assertEqual(self.analyzer["command"][0], "serve")
            options = {**self.options, **here}
            for name in ("listen", "metrics-listen"):  # any free port
                del options[name]
            command = [f"--{name}={value}" if value else f"--{name}" for name, value in options.items()]
            with Service("--listen", "0.0.0.0:0", *command) as service:
                kind, *check = self.analyzer["healthcheck"]["test"]
                self.assertEqual(kind, "CMD")
                port = re.search(r":(\d+)/metrics", service.metrics_url)[1]
                check[-1] = check[-1].replace(f"/{self.port('metrics-listen')} ", f"/{port} ")
                self.assertEqual(subprocess.run(check, timeout=PATIENCE).returncode, 0)
                service.terminate()
            self.assertNotEqual(subprocess.run(check, timeout=PATIENCE, capture_output=True).returncode, 0)


if __name__ == "__main__":
    run_tests()
