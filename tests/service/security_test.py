"""Who may ask, and what clients cannot do to the service's machine."""
import pathlib
import subprocess
import tempfile
import unittest

from service_client import *

TOKEN, OTHER = "0123456789abcdef-first", "0123456789abcdef-other"


def status_of(call):
    """(code, message) of a call that must fail."""
    try:
        call()
    except grpc.RpcError as error:
        return error.code(), error.details()
    raise AssertionError("the call has not failed")


def refusal(*options):
    """What the program says when it does not even start."""
    listen = () if "--listen" in options else ("--listen", "127.0.0.1:0")
    ended = subprocess.run([str(word) for word in (PROGRAM, "serve", *listen, *options)],
                           capture_output=True, text=True, timeout=PATIENCE)
    assert ended.returncode == 2, (ended.returncode, ended.stderr)
    return ended.stderr


class Certificates:
    """An authority, a certificate for the service and one for a client."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.run("req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-keyout", "ca.key",
                 "-out", "ca.pem", "-days", "2", "-subj", "/CN=Test authority")
        self.issue("service", "subjectAltName=DNS:localhost,IP:127.0.0.1")
        self.issue("client", "subjectAltName=DNS:client")

    def run(self, *arguments):
        subprocess.run(["openssl", *arguments], cwd=self.folder, check=True, capture_output=True)

    def issue(self, name, extension):
        (self.folder / "extension").write_text(extension)
        self.run("req", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-keyout", f"{name}.key",
                 "-out", f"{name}.csr", "-subj", f"/CN={name}")
        self.run("x509", "-req", "-in", f"{name}.csr", "-CA", "ca.pem", "-CAkey", "ca.key", "-CAcreateserial", "-out",
                 f"{name}.pem", "-days", "2", "-extfile", "extension")

    def path(self, name):
        return self.folder / name

    def bytes(self, name):
        return self.path(name).read_bytes()


class Encryption(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="service-test-certificates-")
        cls.certificates = Certificates(cls.folder.name)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def tls(self, *more):
        of = self.certificates.path
        return ["--tls-cert", of("service.pem"), "--tls-key", of("service.key"), *more]

    def devices(self, service, credentials):
        channel = grpc.secure_channel(f"localhost:{service.port}", credentials)
        return rpc.SceneAnalyzerStub(channel).ListDevices(pb.ListDevicesRequest(), timeout=PATIENCE).devices

    def test_tls(self):
        of = self.certificates.bytes
        with Service(*self.tls()) as service:
            self.assertTrue(self.devices(service, grpc.ssl_channel_credentials(of("ca.pem"))))
            code, _ = status_of(lambda: service.stub().ListDevices(pb.ListDevicesRequest(), timeout=10))
            self.assertEqual(code, grpc.StatusCode.UNAVAILABLE, "without TLS")
            code, _ = status_of(lambda: self.devices(service, grpc.ssl_channel_credentials(of("client.pem"))))
            self.assertEqual(code, grpc.StatusCode.UNAVAILABLE, "an authority that the client does not know")

    def test_mutual_tls(self):
        of = self.certificates.bytes
        with Service(*self.tls("--client-ca", self.certificates.path("ca.pem"))) as service:
            known = grpc.ssl_channel_credentials(of("ca.pem"), of("client.key"), of("client.pem"))
            self.assertTrue(self.devices(service, known))
            code, _ = status_of(lambda: self.devices(service, grpc.ssl_channel_credentials(of("ca.pem"))))
            self.assertEqual(code, grpc.StatusCode.UNAVAILABLE, "without a certificate")

    def test_certificates_that_cannot_be_used_are_said_at_the_start(self):
        of = self.certificates.path
        self.assertIn("is not the key of", refusal("--tls-cert", of("service.pem"), "--tls-key", of("client.key")))
        self.assertIn("no certificate in PEM", refusal("--tls-cert", of("ca.key"), "--tls-key", of("service.key")))
        self.assertIn("no private key", refusal("--tls-cert", of("service.pem"), "--tls-key", of("service.pem")))
        self.assertIn("cannot be read", refusal("--tls-cert", of("none"), "--tls-key", of("service.key")))
        self.assertIn("no certificate in PEM", refusal(*self.tls("--client-ca", of("ca.key"))))

    def test_other_machines_need_tls_or_the_word_insecure(self):
        for address in ("0.0.0.0:0", "[::]:0", "192.0.2.1:0", "example.org:0"):
            self.assertIn("--insecure", refusal("--listen", address))
        with Service("--listen", "0.0.0.0:0", "--insecure") as service:
            channel = grpc.insecure_channel(f"127.0.0.1:{service.port}")
            self.assertTrue(rpc.SceneAnalyzerStub(channel).ListDevices(pb.ListDevicesRequest()).devices)


class Tokens(unittest.TestCase):
    def test_tokens(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "tokens"
            file.write_text(f"# of the build machines\n{TOKEN}\n")
            with Service("--token-file", file) as service:
                self.check_tokens(service, file)

    def check_tokens(self, service, file):
        stub = service.stub()

        def ask(*metadata):
            return stub.ListDevices(pb.ListDevicesRequest(), metadata=metadata, timeout=PATIENCE)
        for wrong in ([], [("authorization", TOKEN)], [("authorization", f"Bearer {TOKEN}x")],
                      [("authorization", f"Bearer {TOKEN[:-1]}")], [("authorization", f"Bearer {OTHER}")]):
            self.assertEqual(status_of(lambda: ask(*wrong))[0], grpc.StatusCode.UNAUTHENTICATED, wrong)
        self.assertTrue(ask(("authorization", f"Bearer {TOKEN}")).devices)
        code, _ = status_of(lambda: analyze(stub, {"a.obj": obj()}))
        self.assertEqual(code, grpc.StatusCode.UNAUTHENTICATED)
        self.assertEqual(service.upload_files(), [])
        file.write_text(f"{OTHER}\n")
        service.process.send_signal(signal.SIGHUP)
        wait_until(lambda: "read again" in service.log(), "the tokens are read again")
        self.assertTrue(ask(("authorization", f"Bearer {OTHER}")).devices)
        self.assertEqual(status_of(lambda: ask(("authorization", f"Bearer {TOKEN}")))[0],
                         grpc.StatusCode.UNAUTHENTICATED)
        file.write_text("short\n")
        service.process.send_signal(signal.SIGHUP)
        wait_until(lambda: "stay as they were" in service.log(), "the bad file is refused")
        self.assertTrue(ask(("authorization", f"Bearer {OTHER}")).devices)
        self.assertNotIn(TOKEN, service.log())

    def test_bad_token_files_are_said_at_the_start(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "tokens"
            self.assertIn("cannot be read", refusal("--token-file", file))
            file.write_text("# nothing\n")
            self.assertIn("holds no token", refusal("--token-file", file))
            file.write_text("too short\n")
            self.assertIn("tokens:1", refusal("--token-file", file))


class Files(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="service-test-root-")
        cls.outside = pathlib.Path(cls.folder.name)
        cls.root = cls.outside / "root"
        write_files(cls.root, {"inside.obj": obj()})
        write_files(cls.outside, {"secret.obj": obj(), "secret.mtl": b"newmtl secret\n"})
        (cls.root / "link.obj").symlink_to(cls.outside / "secret.obj")
        (cls.root / "folder").symlink_to(cls.outside)
        (cls.root / "fine.obj").symlink_to("inside.obj")
        cls.service = Service("--root", cls.root, "--max-upload", "1M", "--max-triangles", "5000")
        cls.stub = cls.service.stub()

    @classmethod
    def tearDownClass(cls):
        with cls.service:
            pass
        cls.folder.cleanup()

    def assert_refused(self, code, text, files, **more):
        got, message = status_of(lambda: analyze(self.stub, files, **more))
        self.assertEqual(got, code, message)
        self.assertIn(text, message)
        self.assertNotIn(str(self.service.uploads), message)
        self.assertNotIn(str(self.outside), message.replace(more.get("path", "none"), ""))
        wait_until(lambda: not self.service.upload_files(), "the upload is removed")

    def test_the_root_cannot_be_left(self):
        self.assertEqual(len(analyze(self.stub, {}, path="fine.obj").analysis.instances), 1)
        for path in ("../secret.obj", "link.obj", "folder/secret.obj", str(self.outside / "secret.obj"), ".", "none.obj",
                     "inside.obj/../../secret.obj"):
            self.assert_refused(grpc.StatusCode.NOT_FOUND, "is no asset below", {}, path=path)

    def test_without_a_root_paths_are_refused(self):
        with Service() as service:
            code, message = status_of(lambda: analyze(service.stub(), {}, path="inside.obj"))
            self.assertEqual(code, grpc.StatusCode.INVALID_ARGUMENT)
            self.assertIn("--root", message)

    def test_names_never_lead_anywhere(self):
        for name in ("../evil.obj", "/tmp/evil.obj", "C:\\evil.obj", "a/b.obj", "", ".", "..", "x/", "x" * 1025 + ".obj",
                     "http://example.org/a.obj"):
            self.assert_refused(grpc.StatusCode.INVALID_ARGUMENT, "name", {name: obj()})
        for name in ("../evil.mtl", "/etc/evil.mtl", "..\\evil.mtl", "a/../../evil.mtl"):
            self.assert_refused(grpc.StatusCode.INVALID_ARGUMENT, "is no file's name", {"a.obj": obj(), name: b"x"})
        self.assertFalse(list(self.service.uploads.parent.rglob("*evil*")))

    def test_an_upload_cannot_read_other_files(self):
        # The material library lies beside the service's uploads, and below its root.
        for place in (self.outside / "secret.mtl", "../../../secret.mtl", "../lock", "/etc/passwd"):
            data = obj(material="m").replace(b"mtllib m.mtl", f"mtllib {place}".encode())
            result = analyze(self.stub, {"a.obj": data})
            self.assertEqual([file.path for file in result.analysis.files if file.found], [b"a.obj"])

    def test_numbered_files_of_the_upload_are_not_names(self):
        data = obj(material="m").replace(b"mtllib m.mtl", b"mtllib 1")
        result = analyze(self.stub, {"a.obj": data, "m.mtl": b"newmtl m\nKd 1 0 0\n"})
        self.assertEqual([file.path for file in result.analysis.files if file.found], [b"a.obj"])

    def test_too_much(self):
        self.assert_refused(grpc.StatusCode.RESOURCE_EXHAUSTED, "--max-upload", {"a.obj": obj() + b"#" * (1 << 20)})
        self.assert_refused(grpc.StatusCode.INVALID_ARGUMENT, "--max-triangles", {"a.obj": obj(60, 60)})

    def test_bad_assets_say_why(self):
        for name, data, text in (("a.obj", b"", "is empty"), ("a.gltf", b"{", "JSON"), ("a.xyz", b"1", "unsupported"),
                                 ("a.glb", png(), "a.glb")):
            self.assert_refused(grpc.StatusCode.INVALID_ARGUMENT, text, {name: data})


if __name__ == "__main__":
    run_tests()
