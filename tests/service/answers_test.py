"""What the service answers is what the commands answer."""
import pathlib
import tempfile
import unittest

from service_client import *

from grpc.health.v1 import health_pb2, health_pb2_grpc
from grpc.reflection.v1alpha import reflection_pb2, reflection_pb2_grpc


class Answers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="service-test-root-")
        root = pathlib.Path(cls.folder.name)
        write_files(root / "room", gltf_files())
        write_files(root, obj_files())
        cls.root = root
        cls.store = tempfile.TemporaryDirectory(prefix="service-test-store-")
        cls.service = Service("--root", root, "--store", cls.store.name)
        cls.stub = cls.service.stub()

    @classmethod
    def tearDownClass(cls):
        with cls.service:
            pass
        cls.folder.cleanup()
        cls.store.cleanup()

    def assert_same_numbers(self, result, path, **rating):
        """The ratings of `result` are those of `analyze` for the same files, to the last bit."""
        options = ["--metrics", ",".join(QUICK)]
        here = analyze_here(path, *options)
        rated = rate(self.stub, result.analysis, metrics=QUICK, **rating)
        self.assertEqual(len(rated.meshes), len(here["meshes"]))
        self.assertGreater(len(rated.meshes), 0)
        self.assertEqual(rated.unique_triangles, here["scene"]["unique_triangles"])
        self.assertEqual(rated.drawn_triangles, here["scene"]["drawn_triangles"])
        self.assertEqual([rated.eye.x, rated.eye.y, rated.eye.z], here["scene"]["eye"])
        for mesh, row in zip(rated.meshes, here["meshes"]):
            for key in QUICK:
                self.assertEqual(mesh.ratings.HasField(key), row["ratings"][key] is not None)
                if row["ratings"][key] is not None:
                    self.assertEqual(getattr(mesh.ratings, key), row["ratings"][key], key)
                    self.assertEqual(getattr(mesh.relative_ratings, key), row["relative_ratings"][key], key)
            self.assertEqual(mesh.aggregate, row["aggregate"])
            self.assertEqual(mesh.surface_area, row["surface_area"])
        for instance, row in zip(result.analysis.instances, here["meshes"]):
            self.assertEqual(instance.node.decode(), row["node"])
            self.assertEqual(result.analysis.geometries[instance.geometry].triangles, row["triangles"])

    def test_gltf_with_bin_and_texture(self):
        result = analyze(self.stub, gltf_files())
        self.assertEqual(len(result.analysis.instances), 2)
        self.assert_same_numbers(result, self.root / "room" / "hall.gltf")
        self.assertEqual([file.path.decode() for file in result.analysis.files],
                         ["hall.gltf", "data/hall.bin", "textures/wood grain.png"])
        self.assertTrue(all(file.found for file in result.analysis.files))
        self.assertEqual(result.messages, [])

    def test_obj_with_mtl(self):
        result = analyze(self.stub, obj_files())
        self.assert_same_numbers(result, self.root / "shelf.obj")
        self.assertEqual([file.path.decode() for file in result.analysis.files], ["shelf.obj", "shelf.mtl"])

    def test_demo_scene(self):
        progress = []
        result = analyze(self.stub, {"living-room.glb": DEMO.read_bytes()}, progress=progress)
        self.assert_same_numbers(result, DEMO)
        self.assertEqual(result.analysis.asset, b"living-room.glb")
        fractions = [one.fraction for one in progress]
        self.assertEqual(fractions, sorted(fractions))

    def test_missing_files_are_said_and_change_the_key(self):
        files = gltf_files("cellar")
        whole = analyze(self.stub, files)
        del files["textures/wood grain.png"]
        part = analyze(self.stub, files)
        self.assertFalse(part.from_store)
        self.assertNotEqual(part.analysis.content_key, whole.analysis.content_key)
        self.assertIn("wood%20grain.png", b"".join(part.messages).decode())
        self.assertNotIn(self.service.uploads.name, b"".join(part.messages).decode())

    def test_the_same_files_are_answered_from_the_store(self):
        files = {"again.obj": obj(5, 5)}
        first = analyze(self.stub, files)
        self.assertFalse(first.from_store)
        second = analyze(self.stub, files)
        self.assertTrue(second.from_store)
        self.assertEqual(second.analysis, first.analysis)
        self.assertFalse(analyze(self.stub, {"renamed.obj": files["again.obj"]}).from_store)
        self.assertFalse(analyze(self.stub, files, pb.MeasuringParameters(alpha_degrees=5)).from_store)
        kept = self.stub.GetAnalysis(pb.GetAnalysisRequest(content_key=first.analysis.content_key))
        self.assertEqual(kept.analysis, first.analysis)
        by_key = rate(self.stub, first.analysis.content_key)
        self.assertEqual(by_key, rate(self.stub, first.analysis))

    def test_more_metrics_than_are_stored_are_measured(self):
        files = {"more.obj": obj(4, 9)}
        few = analyze(self.stub, files, pb.MeasuringParameters(metrics=["cooccurrence_contrast"]))
        self.assertFalse(few.analysis.geometries[0].HasField("fourier_transform"))
        many = analyze(self.stub, files)
        self.assertFalse(many.from_store)
        self.assertTrue(many.analysis.geometries[0].HasField("fourier_transform"))
        self.assertTrue(analyze(self.stub, files, pb.MeasuringParameters(metrics=["cooccurrence_contrast"])).from_store)

    def test_rendering_time_is_measured_where_it_is_asked_for(self):
        files = {"timed.obj": obj(3, 3)}
        quick = pb.MeasuringParameters(metrics=["rendering_time"], timing_budget_seconds=0.05, steps=2, timing_width=64,
                                       timing_height=64)
        result = analyze(self.stub, files, quick)
        self.assertGreater(result.analysis.render_timings[0].times[0].mean_ns, 0)
        self.assertEqual(result.analysis.render_timings[0].width, 64)
        self.assertTrue(analyze(self.stub, files, quick).from_store)
        self.assertFalse(analyze(self.stub, {"untimed.obj": obj(3, 3)}).analysis.render_timings)

    def test_an_asset_below_the_root(self):
        result = analyze(self.stub, {}, path="room/hall.gltf")
        self.assert_same_numbers(result, self.root / "room" / "hall.gltf")
        self.assertEqual(result.analysis.asset, b"room/hall.gltf")
        self.assertTrue(analyze(self.stub, gltf_files()).from_store, "the same files, sent")

    def test_several_assets_as_one_scene(self):
        analyses = [analyze(self.stub, files).analysis for files in (obj_files(), gltf_files())]
        rated = rate(self.stub, *analyses, metrics=QUICK, relative=True, weights={"relative_density": 2,
                                                                                  "distance": 1})
        here = analyze_here(self.root / "shelf.obj", self.root / "room" / "hall.gltf", "--metrics", ",".join(QUICK),
                            "--relative", "--weights", "relative_density=2,distance=1")
        self.assertEqual([mesh.aggregate for mesh in rated.meshes], [row["aggregate"] for row in here["meshes"]])
        self.assertEqual([mesh.asset for mesh in rated.meshes], [0, 1, 1])

    def test_pictures_are_those_of_the_command(self):
        with tempfile.TemporaryDirectory() as folder:
            for subject in ("aggregate", "relative_density", "planar_groups"):
                path = pathlib.Path(folder) / "picture.png"
                analyze_here(self.root / "room" / "hall.gltf", "--metrics", ",".join(QUICK), "--image", path, "--metric",
                             subject, "--size", "320x240")
                picture = render(self.stub, gltf_files(), subject=subject, width=320, height=240,
                                 measuring=pb.MeasuringParameters(metrics=QUICK))
                self.assertEqual(picture.png, path.read_bytes(), subject)
                self.assertEqual(picture.messages, [])

    def test_own_colours(self):
        picture = render(self.stub, gltf_files(), subject="own_colours", width=320, height=240)
        self.assertTrue(picture.png.startswith(b"\x89PNG"))

    def test_devices(self):
        devices = self.stub.ListDevices(pb.ListDevicesRequest()).devices
        self.assertEqual([device.in_use for device in devices].count(True), 1)

    def test_health(self):
        health = health_pb2_grpc.HealthStub(self.service.channel())
        for name in ("", "scene_analyzer.v1.SceneAnalyzer"):
            answer = health.Check(health_pb2.HealthCheckRequest(service=name))
            self.assertEqual(answer.status, health_pb2.HealthCheckResponse.SERVING)

    def test_reflection(self):
        reflection = reflection_pb2_grpc.ServerReflectionStub(self.service.channel())
        request = reflection_pb2.ServerReflectionRequest(list_services="")
        answer = next(reflection.ServerReflectionInfo(iter([request])))
        names = [service.name for service in answer.list_services_response.service]
        self.assertIn("scene_analyzer.v1.SceneAnalyzer", names)
        for symbol in ("scene_analyzer.v1.SceneAnalyzer", "grpc.health.v1.Health"):
            request = reflection_pb2.ServerReflectionRequest(file_containing_symbol=symbol)
            answer = next(reflection.ServerReflectionInfo(iter([request])))
            self.assertGreater(len(answer.file_descriptor_response.file_descriptor_proto), 0, symbol)

    def test_request_ids_come_back_and_are_in_the_log(self):
        call = self.stub.ListDevices.with_call
        _, made = call(pb.ListDevicesRequest(), metadata=[("x-request-id", "build-17.a_b")])
        self.assertIn(("x-request-id", "build-17.a_b"), [tuple(one) for one in made.trailing_metadata()])
        wait_until(lambda: "build-17.a_b" in self.service.log(), "the log has the id")
        _, made = call(pb.ListDevicesRequest(), metadata=[("x-request-id", 'no"id')])
        ids = [one.value for one in made.trailing_metadata() if one.key == "x-request-id"]
        self.assertRegex(ids[0], "^[0-9a-f]{32}$")

    def test_metrics(self):
        before = self.service.metric('scene_analyzer_requests_total{code="OK",method="Analyze"}')
        triangles = self.service.metric("scene_analyzer_triangles_total")
        busy = self.service.metric("scene_analyzer_device_busy_seconds_total")
        analyze(self.stub, {"counted.obj": obj(3, 4)})
        name = 'scene_analyzer_requests_total{code="OK",method="Analyze"}'
        wait_until(lambda: self.service.metric(name) == before + 1, "the call is counted")
        self.assertEqual(self.service.metric("scene_analyzer_triangles_total"), triangles + 24)
        self.assertGreater(self.service.metric("scene_analyzer_device_busy_seconds_total"), busy)
        self.assertEqual(self.service.metric("scene_analyzer_requests_admitted"), 0)


if __name__ == "__main__":
    run_tests()
