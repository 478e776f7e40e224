"""Clients, connections, devices and machines that fail: every request gets one answer, and the service goes on."""
import os
import pathlib
import signal
import socket
import subprocess
import tempfile
import threading
import time

from service_case import *

from grpc.health.v1 import health_pb2, health_pb2_grpc

LARGE = obj(300, 300)  # seconds of work


class Requests(Case):
    @classmethod
    def setUpClass(cls):
        cls.service = Service("--silence", "2")
        cls.stub = cls.service.stub()

    @classmethod
    def tearDownClass(cls):
        with cls.service:
            pass

    def tearDown(self):
        self.assert_idle(self.service)
        self.assert_works(self.service)

    def test_messages_out_of_order(self):
        parameters = pb.AnalyzeRequest(parameters=pb.AnalyzeParameters())
        header = pb.AnalyzeRequest(file=pb.FileHeader(name="a.obj", size=len(obj())))
        data = pb.AnalyzeRequest(data=obj())
        short = pb.AnalyzeRequest(data=obj()[:-1])
        for text, messages in (("first message", []), ("first message", [header, data]), ("first message", [data]),
                               ("before the header", [parameters, data]), ("twice", [parameters, header, parameters]),
                               ("no file was sent", [parameters]), ("announced", [parameters, header, data, data]),
                               ("announced", [parameters, header, short]), ("announced", [parameters, header]),
                               ("sent already", [parameters, header, data, header]),
                               ("neither", [parameters, header, pb.AnalyzeRequest()])):
            error = self.assert_fails(Code.INVALID_ARGUMENT, lambda: list(self.stub.Analyze(iter(messages))))
            self.assertIn(text, error.details())

    def test_wrong_parameters_are_refused_before_anything_is_sent(self):
        for text, measuring in (("did you mean", pb.MeasuringParameters(metrics=["planar_group_variatoin"])),
                                ("a name of 3000000 bytes", pb.MeasuringParameters(metrics=["x" * 3_000_000])),
                                ("measuring.alpha_degrees: -1", pb.MeasuringParameters(alpha_degrees=-1)),
                                ("measuring.alpha_degrees: nan", pb.MeasuringParameters(alpha_degrees=float("nan"))),
                                ("measuring.dim: 1", pb.MeasuringParameters(dim=1)),
                                ("measuring.steps: 257", pb.MeasuringParameters(steps=257)),
                                ("timing_budget", pb.MeasuringParameters(timing_budget_seconds=31))):
            def endless():
                yield pb.AnalyzeRequest(parameters=pb.AnalyzeParameters(measuring=measuring))
                while True:
                    yield pb.AnalyzeRequest(file=pb.FileHeader(name="a.obj"))
                    time.sleep(1)
            error = self.assert_fails(Code.INVALID_ARGUMENT, lambda: list(self.stub.Analyze(endless())))
            self.assertIn(text, error.details())

    def test_wrong_ratings(self):
        analysis = analyze(self.stub, {"a.obj": obj()}).analysis
        for text, rating in (("rating.metrics", {"metrics": ["x"]}), ("rating.weights", {"weights": {"distance": -1}}),
                             ("all are 0", {"weights": {"distance": 0}}),
                             ("rating.eye", {"eye": pb.Vector3(x=float("inf"))})):
            self.assertIn(text, self.assert_fails(Code.INVALID_ARGUMENT, lambda: rate(self.stub, analysis, **rating))
                          .details())
        self.assert_fails(Code.INVALID_ARGUMENT, lambda: rate(self.stub))
        analysis.geometries[0].polygons_per_planar_group = 7
        error = self.assert_fails(Code.INVALID_ARGUMENT, lambda: rate(self.stub, analysis))
        self.assertIn("assets[0]", error.details())
        self.assert_fails(Code.NOT_FOUND, lambda: rate(self.stub, "0" * 32))
        self.assert_fails(Code.NOT_FOUND, lambda: self.stub.GetAnalysis(pb.GetAnalysisRequest(content_key="../x")))

    def test_deadline(self):
        self.assert_fails(Code.DEADLINE_EXCEEDED, lambda: analyze(self.stub, {"large.obj": LARGE}, timeout=0.7))

    def test_cancel_while_importing_and_while_measuring(self):
        for steps in (["importing", "checking the analysis file"], ["areas and adjacency", "planar groups",
                                                                    "co-occurrence", "spectra"]):
            call = self.stub.Analyze(parts_of(pb.AnalyzeRequest, {"large.obj": LARGE}, pb.AnalyzeParameters()))
            wait_until(lambda: next(call).progress.step in steps, f"the service is at {steps}")
            busy = self.service.metric("scene_analyzer_device_busy_seconds_total")
            call.cancel()
            self.assert_idle(self.service)
            self.assertGreaterEqual(self.service.metric("scene_analyzer_device_busy_seconds_total"), busy)

    def test_a_client_that_is_killed_while_it_sends(self):
        def never_ending():
            yield pb.AnalyzeRequest(parameters=pb.AnalyzeParameters())
            yield pb.AnalyzeRequest(file=pb.FileHeader(name="a.obj"))
            while True:
                yield pb.AnalyzeRequest(data=b"#" * 1000)
                time.sleep(0.01)
        channel = self.service.channel(("grpc.use_local_subchannel_pool", 1))
        call = rpc.SceneAnalyzerStub(channel).Analyze(never_ending())
        wait_until(self.service.upload_files, "the upload has begun")
        channel.close()
        self.assertTrue(call.done())

    def test_a_client_that_falls_silent(self):
        silent = threading.Event()

        def half():
            yield pb.AnalyzeRequest(parameters=pb.AnalyzeParameters())
            yield pb.AnalyzeRequest(file=pb.FileHeader(name="a.obj"))
            silent.wait(PATIENCE)
        call = self.stub.Analyze(half())
        self.assert_fails(Code.CANCELLED, lambda: list(call))
        silent.set()

    def test_connections_that_never_say_anything(self):
        host, port = self.service.address.rsplit(":", 1)
        idle = [socket.create_connection((host, int(port))) for _ in range(100)]
        for connection in idle[50:]:
            connection.sendall(b"PRI * HTTP/2.0\r\n\r\nSM\r\n")
        self.assert_works(self.service)
        for connection in idle:
            connection.settimeout(PATIENCE)
            while connection.recv(1 << 16):  # until the service hangs up
                pass
            connection.close()


class Load(Case):
    def test_64_clients_and_a_queue_of_16(self):
        with Service("--queue", "16") as service:
            refused = []

            def work(i):
                result = analyze_with_retries(service.stub(), {f"asset-{i}.obj": obj(2 + i, 3)}, refused)
                self.assertEqual(result.analysis.asset, f"asset-{i}.obj".encode())
                self.assertEqual(result.analysis.geometries[0].triangles, 6 * (2 + i))
            parallel(64, work)
            self.assertGreater(len(refused), 0, "the queue was never full")
            for error in refused:
                self.assertEqual(error.code(), Code.RESOURCE_EXHAUSTED)
                self.assertGreater(int(pushback(error)), 0)
            self.assertEqual(service.metric('scene_analyzer_requests_total{code="OK",method="Analyze"}'), 64)
            # Requests shared the device: fewer packs than requests.
            self.assertLess(service.metric("scene_analyzer_pack_requests_count"), 64)
            self.assert_idle(service)

    def test_the_space_for_uploads(self):
        with Service("--max-upload", "1M", "--upload-space", "1M") as service:
            began, go_on = threading.Event(), threading.Event()

            def slow():
                yield from parts_of(pb.AnalyzeRequest, {"a.obj": obj() + b"#" * 900_000}, pb.AnalyzeParameters())
                began.set()
                go_on.wait(PATIENCE)
            first = service.stub().Analyze(slow())
            began.wait(PATIENCE)
            wait_until(lambda: service.metric("scene_analyzer_upload_bytes") > 900_000, "the space is used")
            error = self.assert_fails(Code.RESOURCE_EXHAUSTED,
                                      lambda: analyze(service.stub(), {"b.obj": obj() + b"#" * 900_000}))
            self.assertIn("--upload-space", error.details())
            self.assertGreater(int(pushback(error)), 0)
            go_on.set()
            self.assertTrue(list(first)[-1].HasField("result"))
            self.assert_idle(service)


class End(Case):
    def test_sigterm_while_requests_are_worked_on(self):
        with Service() as service:
            watch = health_pb2_grpc.HealthStub(service.channel()).Watch(health_pb2.HealthCheckRequest())
            self.assertEqual(next(watch).status, health_pb2.HealthCheckResponse.SERVING)
            stub, go_on = service.stub(), threading.Event()
            calls = [stub.Analyze(held_back(parts_of(pb.AnalyzeRequest, {f"large-{i}.obj": obj(200 + i, 200)},
                                                     pb.AnalyzeParameters()), go_on)) for i in range(4)]
            wait_until(lambda: service.metric("scene_analyzer_requests_admitted") == 4, "all are taken")
            go_on.set()
            service.process.send_signal(signal.SIGTERM)
            self.assertEqual(next(watch).status, health_pb2.HealthCheckResponse.NOT_SERVING)
            wait_until(lambda: "no more requests" in service.log(), "health comes first")
            error = self.assert_fails(Code.UNAVAILABLE, lambda: analyze(stub, {"late.obj": obj()}))
            self.assertIn("shutting down", error.details())
            for i, call in enumerate(calls):
                self.assertEqual(list(call)[-1].result.analysis.geometries[0].triangles, 400 * (200 + i))
            service.wait(0)

    def test_drain_timeout(self):
        with Service("--drain-timeout", "1") as service:
            call = service.stub().Analyze(parts_of(pb.AnalyzeRequest, {"large.obj": obj(1000, 1000)},
                                                   pb.AnalyzeParameters()))
            wait_until(lambda: service.metric("scene_analyzer_requests_admitted") == 1, "it is taken")
            service.process.send_signal(signal.SIGTERM)
            with self.assertRaises(grpc.RpcError) as raised:
                list(call)
            self.assertIn(raised.exception.code(), (Code.UNAVAILABLE, Code.CANCELLED))
            service.wait(0)
            self.assertIn("--drain-timeout", service.log())

    def test_a_second_signal_ends_it_at_once(self):
        with Service("--drain-timeout", "3000") as service:
            call = service.stub().Analyze(parts_of(pb.AnalyzeRequest, {"large.obj": obj(1000, 1000)},
                                                   pb.AnalyzeParameters()))
            wait_until(lambda: service.metric("scene_analyzer_requests_admitted") == 1, "it is taken")
            service.process.send_signal(signal.SIGTERM)
            wait_until(lambda: "no more requests" in service.log(), "the first signal is understood")
            service.process.send_signal(signal.SIGTERM)
            service.wait(128 + signal.SIGTERM)
            with self.assertRaises(grpc.RpcError):
                list(call)

    def test_kill_and_restart_with_the_store(self):
        with tempfile.TemporaryDirectory() as folder:
            store = pathlib.Path(folder) / "store"
            service = Service("--store", store)
            kept = {f"kept-{i}.obj": obj(3 + i, 3) for i in range(5)}
            for name, data in kept.items():
                self.assertFalse(analyze(service.stub(), {name: data}).from_store)
            stub = service.stub()
            calls = [stub.Analyze(parts_of(pb.AnalyzeRequest, {f"load-{i}.obj": obj(20 + i, 30)},
                                           pb.AnalyzeParameters())) for i in range(16)]
            next(calls[-1])
            os.killpg(service.process.pid, signal.SIGKILL)
            service.process.wait()
            answered = 0
            for call in calls:
                try:
                    answered += list(call)[-1].HasField("result")
                except grpc.RpcError as error:
                    self.assertIn(error.code(), (Code.UNAVAILABLE, Code.CANCELLED))
            left = list(service.uploads.iterdir())
            self.assertEqual(len(left), 1, "a killed service leaves its uploads")
            with Service("--store", store, uploads=service.uploads) as again:
                self.assertFalse(left[0].exists(), "the next one removes them")
                for name, data in kept.items():
                    self.assertTrue(analyze(again.stub(), {name: data}).from_store)
                for i in range(16):
                    result = analyze(again.stub(), {f"load-{i}.obj": obj(20 + i, 30)})
                    self.assertEqual(result.analysis.geometries[0].triangles, 60 * (20 + i))
                self.assertFalse([path for path in store.rglob("*.tmp")])
            service.process.stderr.close()
            service.folder.cleanup()

    def test_one_service_per_port_and_per_store(self):
        with tempfile.TemporaryDirectory() as folder, Service("--store", folder) as service:
            for options, text in ((["--listen", service.address], "can listen at"),
                                  (["--listen", "127.0.0.1:0", "--store", folder], "another service uses")):
                ended = subprocess.run([PROGRAM, "serve", *options], capture_output=True, text=True, timeout=PATIENCE)
                self.assertEqual(ended.returncode, 2)
                self.assertIn(text, ended.stderr)


class DeviceLost(Case):
    def start(self, rule):
        return Service(env={"VK_ADD_LAYER_PATH": str(LAYERS), "VK_INSTANCE_LAYERS": "VK_LAYER_SCENE_ANALYZER_fault",
                            "SCENE_ANALYZER_FAULT": rule, "SCENE_ANALYZER_VALIDATION": "0"})

    def test_one_client(self):
        for lost_at in (1, 3, 5):
            with self.start(f"vkQueueSubmit2:{lost_at}=device_lost") as service:
                error = self.assert_fails(Code.UNAVAILABLE, lambda: analyze(service.stub(), {"a.obj": obj()}))
                self.assertIn("fresh device", error.details())
                self.assert_works(service)
                self.assertEqual(service.metric("scene_analyzer_device_losses_total"), 1)
                self.assert_idle(service)

    def test_neighbours(self):
        with self.start("vkQueueSubmit2:9=device_lost") as service:
            def work(i):
                result = analyze_with_retries(service.stub(), {f"asset-{i}.obj": obj(2 + i, 3)})
                self.assertEqual(result.analysis.geometries[0].triangles, 6 * (2 + i))
            parallel(24, work)
            self.assertEqual(service.metric("scene_analyzer_device_losses_total"), 1)
            self.assert_idle(service)

    def test_out_of_memory_is_no_loss(self):
        with self.start("vkAllocateMemory:3=out_of_device_memory") as service:
            result = analyze(service.stub(), {"a.obj": obj()})
            self.assertEqual(len(result.analysis.instances), 1)
            self.assert_works(service)


if __name__ == "__main__":
    run_tests()
