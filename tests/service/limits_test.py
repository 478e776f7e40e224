"""What clients may ask for, what is too much, and clients that keep the service waiting."""
import json
import pathlib
import shutil
import struct
import subprocess
import tempfile
import threading
import time

from service_case import *

from grpc.health.v1 import health_pb2, health_pb2_grpc

CALLS = "/scene_analyzer.v1.SceneAnalyzer/"
# A client that takes what it asks for alone: nothing is read ahead for it.
NO_READ_AHEAD = (("grpc.http2.bdp_probe", 0), ("grpc.http2.lookahead_bytes", 1 << 16),
                 ("grpc.use_local_subchannel_pool", 1))


def many_instances(count):
    """A glTF with one triangle that stands in `count` places."""
    corners = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(count))}],
        "nodes": [{"mesh": 0, "name": f"place {i}", "translation": [i, 0, 0]} for i in range(count)],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "buffers": [{"uri": "corners.bin", "byteLength": len(corners)}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": len(corners)}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
                       "max": [1, 1, 0]}]}
    return {"places.gltf": json.dumps(document).encode(), "corners.bin": corners}


def peak_memory(service):
    """Bytes."""
    status = pathlib.Path(f"/proc/{service.process.pid}/status").read_text()
    return next(int(line.split()[1]) << 10 for line in status.splitlines() if line.startswith("VmHWM:"))


class Sizes(Case):
    def test_what_is_rated_together(self):
        with tempfile.TemporaryDirectory() as store, Service("--store", store) as service:
            stub = service.stub()
            places = analyze(stub, many_instances(9_999), pb.MeasuringParameters(metrics=["distance"]))
            key = places.analysis.content_key
            self.assertEqual(len(rate(stub, *[key] * 3).meshes), 3 * 9_999)
            before = peak_memory(service)
            # Each counts as its instances and one more: a hundred make a million.
            error = self.assert_fails(Code.RESOURCE_EXHAUSTED, lambda: rate(stub, *[key] * 101))
            self.assertIn("1000000 meshes", error.details())
            self.assertEqual(pushback(error), "-1")
            self.assertLess(peak_memory(service) - before, 1 << 30)
            self.assert_works(service)

    def test_rendering_times_of_an_analysis(self):
        with Service() as service:
            analysis = analyze(service.stub(), {"a.obj": obj()}).analysis
            for _ in range(65):
                analysis.render_timings.add()
            error = self.assert_fails(Code.INVALID_ARGUMENT, lambda: rate(service.stub(), analysis))
            self.assertIn("render_timings", error.details())
            self.assert_works(service)

    def test_messages_beyond_their_size(self):
        with Service() as service:
            large = pb.RateRequest()
            large.assets.add().content_key = "0" * (33 << 20)
            error = self.assert_fails(Code.RESOURCE_EXHAUSTED, lambda: service.stub().Rate(large))
            self.assertIn("content keys in place of analyses", error.details())
            self.assertEqual(pushback(error), "-1")
            data = pb.AnalyzeRequest(data=b"#" * (33 << 20))
            parameters = pb.AnalyzeRequest(parameters=pb.AnalyzeParameters())
            error = self.assert_fails(Code.RESOURCE_EXHAUSTED,
                                      lambda: list(service.stub().Analyze(iter([parameters, data]))))
            self.assertIn("at most 4 MiB", error.details())
            self.assertEqual(pushback(error), "-1")
            self.assert_works(service)

    def test_limits_themselves_are_accepted(self):
        file = obj(3, 2)  # 12 triangles
        file += b"#" * ((1 << 20) - len(file))
        with Service("--max-triangles", "12", "--max-upload", "1M", "--max-start-searches", "100") as service:
            at_most = pb.MeasuringParameters(start_searches=100)
            self.assertEqual(analyze(service.stub(), {"a.obj": file}, at_most).analysis.geometries[0].triangles, 12)
            error = self.assert_fails(Code.RESOURCE_EXHAUSTED, lambda: analyze(service.stub(), {"a.obj": file + b"#"}))
            self.assertIn("--max-upload", error.details())
            error = self.assert_fails(Code.INVALID_ARGUMENT, lambda: analyze(service.stub(), {"a.obj": obj(7, 1)}))
            self.assertIn("14 triangles", error.details())
            more = pb.MeasuringParameters(start_searches=101)
            error = self.assert_fails(Code.INVALID_ARGUMENT, lambda: analyze(service.stub(), {"a.obj": obj()}, more))
            self.assertIn("start_searches: 101", error.details())
            self.assertIn("--max-start-searches", error.details())
            # Who says nothing gets what there is, not more than that.
            self.assertEqual(analyze(service.stub(), {"a.obj": obj(2, 2)}).analysis.parameters.start_searches, 100)


class Waiting(Case):
    """Clients that are slow, or talk nonsense."""

    @classmethod
    def setUpClass(cls):
        cls.store = tempfile.TemporaryDirectory(prefix="service-test-store-")
        cls.service = Service("--store", cls.store.name, "--silence", "1")
        # More as a message than is sent to who does not read, and less than a slow client has more than seconds for.
        cls.places = many_instances(4_000)
        analysis = analyze(cls.service.stub(), cls.places, pb.MeasuringParameters(metrics=["distance"])).analysis
        assert 200_000 < analysis.ByteSize() < 1_000_000, analysis.ByteSize()
        cls.key = analysis.content_key

    @classmethod
    def tearDownClass(cls):
        with cls.service:
            pass
        cls.store.cleanup()

    def tearDown(self):
        self.assert_idle(self.service)
        self.assert_works(self.service)

    def raw(self, method):
        """A call of messages that are just bytes, also of methods that take only one of them."""
        return self.service.channel(*NO_READ_AHEAD).stream_stream(CALLS + method, request_serializer=bytes)

    def calls_that_ended(self, method, code):
        return self.service.metric(f'scene_analyzer_requests_total{{code="{code}",method="{method}"}}')

    def test_messages_that_are_none(self):
        garbage = b"\xff" * 100
        parameters = pb.AnalyzeRequest(parameters=pb.AnalyzeParameters()).SerializeToString()
        header = pb.AnalyzeRequest(file=pb.FileHeader(name="a.obj")).SerializeToString()
        sized = pb.AnalyzeRequest(file=pb.FileHeader(name="a.obj", size=100)).SerializeToString()
        for method, messages in (("Analyze", [parameters, header, garbage, header]), ("Analyze", [garbage]), ("Analyze", []),
                                 ("Analyze", [parameters, garbage, header]), ("Rate", [garbage]), ("GetAnalysis", [garbage]), ("ListDevices", [garbage])):
            error = self.assert_fails(Code.INVALID_ARGUMENT, lambda: list(self.raw(method)(iter(messages))))
            self.assertRegex(error.details(), "cannot be parsed|first message", method)
        error = self.assert_fails(Code.INVALID_ARGUMENT, lambda: list(self.raw("Analyze")(iter([parameters, sized, garbage]))))
        self.assertIn("a.obj", error.details())

    def test_an_upload_that_trickles(self):
        ended = threading.Event()

        def trickle():
            yield pb.AnalyzeRequest(parameters=pb.AnalyzeParameters())
            yield pb.AnalyzeRequest(file=pb.FileHeader(name="a.obj"))
            while not ended.wait(0.05):  # never silent
                yield pb.AnalyzeRequest(data=b"#" * 10)
        error = self.assert_fails(Code.CANCELLED, lambda: list(self.service.stub().Analyze(trickle())))
        ended.set()
        self.assertIn("slower than", error.details())

    def test_a_request_of_one_message_that_never_comes(self):
        for method in ("Rate", "GetAnalysis", "ListDevices"):
            ended = threading.Event()

            def nothing():
                ended.wait(PATIENCE)
                yield from ()
            self.assert_fails(Code.CANCELLED, lambda: list(self.raw(method)(nothing())))
            ended.set()

    def test_answers_that_nobody_reads(self):
        upload = [part.SerializeToString() for part in parts_of(
            pb.AnalyzeRequest, self.places, pb.AnalyzeParameters(measuring=pb.MeasuringParameters(metrics=["distance"])))]
        rating = pb.RateRequest(assets=[pb.AnalysisReference(content_key=self.key)]).SerializeToString()
        for method, messages in (("Analyze", upload), ("Rate", [rating]),
                                 ("GetAnalysis", [pb.GetAnalysisRequest(content_key=self.key).SerializeToString()])):
            before = self.calls_that_ended(method, "CANCELLED")
            call = self.raw(method)(iter(messages))
            wait_until(lambda: self.calls_that_ended(method, "CANCELLED") > before, f"{method} is given up")
            self.assertIn("no longer reads the answer", self.service.log())
            call.cancel()


class Stores(Case):
    def test_a_full_one(self):
        with tempfile.TemporaryDirectory() as folder:
            small = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", folder], capture_output=True)
            if small.returncode:
                self.skipTest("mounting a small file system needs privileges")
            try:
                with Service("--store", folder) as service:
                    for i in range(3):
                        result = analyze(service.stub(), {**many_instances(3_000), f"unused-{i}": b"x"},
                                         pb.MeasuringParameters(metrics=["distance"]))
                        self.assertEqual(len(result.analysis.instances), 3_000)
                        self.assertFalse(result.from_store)
                    self.assertIn("No space left on device", service.log())
                    left = [path for path in pathlib.Path(folder).rglob("*") if path.is_file() and path.name != "lock"]
                    self.assertFalse(left, "something half-written is left")
                    self.assert_works(service)
            finally:
                subprocess.run(["umount", folder], check=True)

    def test_one_that_is_taken_away(self):
        with tempfile.TemporaryDirectory() as folder:
            store = pathlib.Path(folder) / "store"
            with Service("--store", store) as service:
                key = analyze(service.stub(), {"a.obj": obj()}).analysis.content_key
                shutil.rmtree(store)
                store.write_text("in its place")
                self.assert_fails(Code.NOT_FOUND,
                                  lambda: service.stub().GetAnalysis(pb.GetAnalysisRequest(content_key=key)))
                for name in ("a.obj", "b.obj"):
                    self.assertFalse(analyze(service.stub(), {name: obj()}).from_store)
                self.assertIn(str(store), service.log())
                self.assertEqual(store.read_text(), "in its place")


class Draining(Case):
    def test_what_is_asked_after_sigterm(self):
        with tempfile.TemporaryDirectory() as store, Service("--store", store) as service:
            stub = service.stub()
            key = analyze(stub, {"a.obj": obj()}).analysis.content_key
            self.assertEqual(stub.GetAnalysis(pb.GetAnalysisRequest(content_key=key)).analysis.content_key, key)
            go_on = threading.Event()
            call = stub.Analyze(held_back(parts_of(pb.AnalyzeRequest, {"slow.obj": obj(9, 9)}, pb.AnalyzeParameters()),
                                          go_on))
            wait_until(lambda: service.metric("scene_analyzer_requests_admitted") == 1, "it is taken")
            service.process.terminate()
            wait_until(lambda: "no more requests" in service.log(), "the signal is understood")
            for ask in (lambda: stub.GetAnalysis(pb.GetAnalysisRequest(content_key=key)), lambda: rate(stub, key)):
                self.assertIn("shutting down", self.assert_fails(Code.UNAVAILABLE, ask).details())
            health = health_pb2_grpc.HealthStub(service.channel())
            self.assertEqual(health.Check(health_pb2.HealthCheckRequest()).status,
                             health_pb2.HealthCheckResponse.NOT_SERVING)
            go_on.set()
            self.assertEqual(list(call)[-1].result.analysis.geometries[0].triangles, 162)
            service.wait(0)


if __name__ == "__main__":
    run_tests()
