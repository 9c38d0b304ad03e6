"""Surfaces of clouds: ours beside Open3D's screened Poisson reconstruction, on the same points and normals.

    python3 tests/bench/peers/surfaces.py [--rounds 3] [--threads 2] [--noise S] [--smoothing D] [--points N,...]
        [--normals METHOD,...] [--models NAME,...] [--sharp A]

Clouds are sampled from closed models. Our time includes areas and the field. Distances are in percent of the model's diagonal, as
tests/bench/surfaces.rs has them: "excess" is the chamfer distance beyond that between two samplings of the truth, "off" the mean
distance from the truth's planes. `--noise` is a standard deviation, in thousandths of the diagonal. Goals: the excess no worse,
the time half. `--normals` are methods of tests/bench/surfaces.rs that estimate them, outside of the time; else they are the true ones.
"""
import argparse
import json
import os
import platform
import statistics
import subprocess
import sys
import tempfile
import time

import environment

MODELS = ["bumpy70k", "knot124k", "dragon202k"]
# Of no package: compared if it lies with the others.
FURTHER = "featuretype"
POINTS = [35_000, 100_000]
DEPTH = 8
HEADS = ["model", "points", "normals by", "whose", "time", "triangles", "excess", "off", "normals"]
# The floor is itself a sample: differences below this are none.
FLOOR_NOISE = 2e-4


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--rounds", type=int, default=3)
    arguments.add_argument("--threads", type=int, default=os.cpu_count())
    arguments.add_argument("--noise", type=float, default=0.0)
    arguments.add_argument("--smoothing", type=float, help="of ours, in distances between points")
    arguments.add_argument("--sharp", type=float, help="of ours, in degrees")
    arguments.add_argument("--models", help="names of files in target/bench-models")
    arguments.add_argument("--points", default=",".join(map(str, POINTS)))
    arguments.add_argument("--normals", default="truth")
    arguments.add_argument("--poisson", help="for one process: make a surface of this cloud", nargs=2)
    options = arguments.parse_args()
    environment.enter()
    if options.poisson:
        return poisson(*options.poisson, options.threads)
    program = environment.measuring_program("surfaces")
    models = options.models.split(",") if options.models else made()
    print(f"\n{options.threads} thread(s), medians of {options.rounds} round(s), {platform.processor() or platform.machine()}")
    print("| " + " | ".join(HEADS) + " |\n|" + "---|" * len(HEADS))
    for model in models:
        for count in map(int, options.points.split(",")):
            for normals in options.normals.split(","):
                compare(program, environment.MODELS / f"{model}.ply", count, normals, options)


def made():
    """Names of the models that lie there now."""
    maker = environment.ROOT / "tests" / "bench" / "models.mjs"
    subprocess.run(["node", maker, environment.MODELS, *MODELS], check=True, stdout=subprocess.DEVNULL)
    return MODELS + [FURTHER] * (environment.MODELS / f"{FURTHER}.ply").exists()


def compare(program, model, count, normals, options):
    cloud_options = ["--points", str(count), "--noise", str(options.noise)]
    cloud_options += [] if normals == "truth" else ["--normals", normals]
    smoothing = ["--smoothing", str(options.smoothing)] if options.smoothing else []
    sharp = ["--sharp", str(options.sharp)] if options.sharp else []
    with tempfile.TemporaryDirectory(dir=environment.MODELS.parent) as folder:
        cloud, surface = f"{folder}/cloud.f64", f"{folder}/surface.ply"
        subprocess.run([program, "cloud", model, "--output", cloud, *cloud_options], check=True)
        peer = [sys.executable, __file__, "--threads", str(options.threads), "--poisson", cloud, surface]
        times, own, ours = [], [], None
        for _ in range(options.rounds):
            times.append(environment.run_measured(peer, options.threads)["total"])
            ours = environment.run_measured([program, "ours", model, *cloud_options, *smoothing, *sharp], options.threads)
            own.append(ours["total"])
        theirs = environment.run_measured([program, "compare", model, surface], options.threads)
    ours["total"], theirs["total"] = statistics.median(own), statistics.median(times)
    for whose, row in (("ours", ours), ("Poisson", theirs)):
        cells = [model.stem, f"{count:,}", normals, whose, f"{row['total']:.2f} s", f"{row['triangles']:,}"]
        cells += [f"{row[name]:.4f}" for name in ("excess", "off", "normals")]
        print("| " + " | ".join(cells) + " |")
    is_met = ours["excess"] <= theirs["excess"] + FLOOR_NOISE and 2 * ours["total"] <= theirs["total"]
    print(f"goal {'met' if is_met else 'MISSED'}: {theirs['total'] / ours['total']:.1f} times as fast", file=sys.stderr)


def poisson(cloud, surface, threads):
    """Open3D's surface of a cloud, written to a file; prints the time without reading and writing."""
    import numpy as np
    import open3d

    records = np.fromfile(cloud).reshape(-1, 6)
    points = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(records[:, :3]))
    points.normals = open3d.utility.Vector3dVector(records[:, 3:])
    started = time.perf_counter()
    mesh, _ = open3d.geometry.TriangleMesh.create_from_point_cloud_poisson(points, depth=DEPTH, n_threads=threads)
    total = time.perf_counter() - started
    open3d.io.write_triangle_mesh(surface, mesh)
    print(json.dumps({"total": total}))


if __name__ == "__main__":
    main()
