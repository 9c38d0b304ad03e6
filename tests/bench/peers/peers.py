"""The other implementations, each run in a process of its own: what crashes one leaves the others alone.

    python peers.py PEER MODEL [--points FILE --chunk N --cap SECONDS] [--threads N] [--output FILE]

Builds and, given points, evaluates; prints times in seconds and the growth of resident memory in bytes as JSON. Where all
points would take longer than `--cap`, every so many chunks of them are asked ("stride") and the time is scaled.
"""
import argparse
import json
import math
import pathlib
import statistics
import time

import numpy as np

from models import chunks, read

REPEATS = 3
# Seconds after which a job is not repeated again within one process: the rounds repeat it too.
ENOUGH = 1.0


class Gpytoolbox:
    """The reference code (UT_SolidAngle) as gpytoolbox builds it; order 2, β = 2."""

    def __init__(self, model, threads):
        import gpytoolbox

        self.vertices, self.faces = model.vertices, model.faces.astype(np.int32)
        self.precompute = gpytoolbox.fast_winding_number_precompute

    def build(self):
        return self.precompute(self.vertices, self.faces)

    def evaluate(self, hierarchy, points):
        return hierarchy.winding_number(points)


class Libigl:
    """The same reference code as libigl builds it; order 2, β = 2."""

    def __init__(self, model, threads):
        import igl

        self.igl, self.vertices, self.faces = igl, model.vertices, model.faces

    def build(self):
        hierarchy = self.igl.FastWindingNumberBVH()
        hierarchy.init(self.vertices, self.faces, 2)
        return hierarchy

    def evaluate(self, hierarchy, points):
        return hierarchy.winding_number(points, 2.0)


class LibiglCloud:
    """libigl's points, with the paper's parameters; builds anew in every call."""

    def __init__(self, model, threads):
        import igl

        self.igl, self.model = igl, model

    build = None

    def evaluate(self, _, points):
        model = self.model
        return self.igl.fast_winding_number(model.points, model.normals, model.areas, points, 2, 2.3)


class LibiglAreas:
    """What libigl's points need before a field: octree, 20 neighbours and areas (of the paper's supplement) by CGAL."""

    evaluate = None

    def __init__(self, model, threads):
        import igl
        import igl.copyleft.cgal

        self.igl, self.cgal, self.model = igl, igl.copyleft.cgal, model

    def build(self):
        points = self.model.points
        indices, children, centers, widths = self.igl.octree(points)
        neighbours = self.igl.knn(points, points, 20, indices, children, centers, widths)
        return self.cgal.point_areas(points, neighbours, self.model.normals)


class PointCloudUtils:
    """Triangles or points of point-cloud-utils; builds anew in every call."""

    def __init__(self, model, threads):
        import point_cloud_utils

        self.peer, self.model = point_cloud_utils, model

    build = None

    def evaluate(self, _, points):
        model = self.model
        if hasattr(model, "faces"):
            return self.peer.triangle_soup_fast_winding_number(model.vertices, model.faces, points)
        return self.peer.point_cloud_fast_winding_number(model.points, model.normals, model.areas, points)


class Open3d:
    """Open3D's occupancy: parity of one Embree ray; 32-bit floats, made outside of the measured time."""

    def __init__(self, model, threads):
        import open3d

        self.open3d, self.threads = open3d, threads
        self.vertices = open3d.core.Tensor(model.vertices.astype(np.float32))
        self.faces = open3d.core.Tensor(model.faces.astype(np.uint32))

    def convert(self, points):
        return self.open3d.core.Tensor(points.astype(np.float32))

    def build(self):
        scene = self.open3d.t.geometry.RaycastingScene(nthreads=self.threads)
        scene.add_triangles(self.vertices, self.faces)
        # Embree builds when the first ray is cast.
        scene.compute_occupancy(self.convert(np.zeros((1, 3))), nthreads=self.threads)
        return scene

    def evaluate(self, scene, points):
        return scene.compute_occupancy(points, nthreads=self.threads).numpy().astype(float)


PEERS = {
    "gpytoolbox": Gpytoolbox,
    "libigl": Libigl,
    "libigl-areas": LibiglAreas,
    "libigl-cloud": LibiglCloud,
    "point-cloud-utils": PointCloudUtils,
    "open3d": Open3d,
}


def timed(job):
    start = time.perf_counter()
    result = job()
    return time.perf_counter() - start, result


def memory():
    """Resident bytes: now, and at their highest since the last `reset_peak`."""
    lines = pathlib.Path("/proc/self/status").read_text().splitlines()
    words = {line.split(":")[0]: line.split()[1] for line in lines if line.startswith(("VmRSS", "VmHWM"))}
    return 1024 * int(words["VmRSS"]), 1024 * int(words["VmHWM"])


def reset_peak():
    try:
        pathlib.Path("/proc/self/clear_refs").write_text("5")
    except OSError:
        pass  # Not everywhere allowed: then the peak is that since the start.


def measure_build(build_once):
    """Seconds of a build, what it built, and the growth of memory by it."""
    reset_peak()
    before, _ = memory()
    seconds, built = timed(build_once)
    resident, peak = memory()
    growth = {"resident": max(resident - before, 0), "peak": max(peak - before, 0), "process": peak}
    return seconds, built, growth


def stride_for(peer, built, build, points, options):
    """How many chunks to go on by, so that all asked chunks take about the time allowed."""
    convert = getattr(peer, "convert", lambda given: given)
    total = math.ceil(len(points) / options.chunk)
    # Two chunks, a third and a half through: a plane at the rim may meet little of the model.
    parts = [points[options.chunk * (total // k) :][: options.chunk] for k in (2, 3)]
    sample = convert(np.ascontiguousarray(np.concatenate(parts)))
    seconds, _ = timed(lambda: peer.evaluate(built, sample))
    whole = max(seconds - (0 if peer.build else build), 0) * total / len(parts)
    return max(1, min(math.ceil(whole / options.cap), total // 4 or 1))


def measure(peer, points, options):
    # A peer that builds in every call shows its build in a call with one point.
    point = np.zeros((1, 3))
    build_once = peer.build or (lambda: peer.evaluate(None, point))
    build, built, growth = measure_build(build_once)
    builds, evaluations, values, stride = [build], [], None, 1
    if points is None:
        while len(builds) < 1 + REPEATS:
            builds.append(timed(build_once)[0])
        builds = builds[1:]
    else:
        stride = stride_for(peer, built, build, points, options)
        asked = np.concatenate([points[a:b] for a, b in chunks(len(points), options.chunk, stride)])
        convert = getattr(peer, "convert", lambda given: given)
        converted = convert(asked)
        start = time.perf_counter()
        while not evaluations or (len(evaluations) < REPEATS and time.perf_counter() - start < ENOUGH):
            build, built = timed(build_once)
            seconds, values = timed(lambda: peer.evaluate(built, converted))
            builds.append(build)
            evaluations.append(max(seconds - (0 if peer.build else build), 0) * len(points) / len(asked))
    build = statistics.median(builds)
    evaluation = statistics.median(evaluations) if evaluations else 0.0
    return values, {"build": build, "evaluation": evaluation, "total": build + evaluation, "stride": stride, **growth}


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("peer", choices=PEERS)
    arguments.add_argument("model", type=pathlib.Path)
    arguments.add_argument("--points")
    arguments.add_argument("--chunk", type=int, default=10_000)
    arguments.add_argument("--cap", type=float, default=math.inf)
    arguments.add_argument("--threads", type=int, default=1)
    arguments.add_argument("--output")
    options = arguments.parse_args()
    peer = PEERS[options.peer](read(options.model), options.threads)
    points = np.memmap(options.points, np.float64, "r").reshape(-1, 3) if options.points else None
    values, result = measure(peer, points, options)
    if options.output and values is not None:
        np.asarray(values, float).ravel().tofile(options.output)
    print(json.dumps(result))


if __name__ == "__main__":
    main()
