"""What tests ask of a service again and again."""
import subprocess
import threading
import time
import unittest

from service_client import *

Code = grpc.StatusCode


def parallel(count, work):
    """The results of work(0), work(1), ... on a thread each; what one raises is raised."""
    results, errors = [None] * count, []

    def run(i):
        try:
            results[i] = work(i)
        except BaseException as error:  # for the main thread
            errors.append(error)
    threads = [threading.Thread(target=run, args=(i,)) for i in range(count)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    if errors:
        raise errors[0]
    return results


def held_back(parts, go_on):
    """The parts of a request, the last of them when `go_on` is set."""
    *others, last = parts
    yield from others
    go_on.wait(PATIENCE)
    yield last


def pushback(error):
    return {one.key: one.value for one in error.trailing_metadata()}.get("grpc-retry-pushback-ms")


def analyze_with_retries(stub, files, refused=None):
    """As clients are told to do: tries again after the time that the service names."""
    end = time.monotonic() + PATIENCE
    while True:
        try:
            return analyze(stub, files)
        except grpc.RpcError as error:
            if error.code() not in (Code.RESOURCE_EXHAUSTED, Code.UNAVAILABLE) or time.monotonic() > end:
                raise
            if refused is not None:
                refused.append(error)
            time.sleep(int(pushback(error) or 100) / 1000)


def has_children(service):
    return subprocess.run(["pgrep", "-P", str(service.process.pid)], capture_output=True).returncode == 0


class Case(unittest.TestCase):
    def assert_idle(self, service):
        wait_until(lambda: not service.upload_files(), "all uploads are removed")
        wait_until(lambda: service.metric("scene_analyzer_requests_admitted") == 0, "no request is left")
        wait_until(lambda: not has_children(service), "no import worker is left")

    def assert_works(self, service):
        result = analyze(service.stub(), {"works.obj": obj(3, 2)})
        self.assertEqual(result.analysis.geometries[0].triangles, 12)

    def assert_fails(self, code, call):
        with self.assertRaises(grpc.RpcError) as raised:
            call()
        self.assertEqual(raised.exception.code(), code, raised.exception.details())
        return raised.exception
