"""Signed distances: ours beside Open3D's and pysdf's, on the same models and places.

    python3 tests/bench/peers/distance.py [--rounds 3] [--threads 1] [--points 200000] [--lattice 64] [--models NAME,...]

Places are spread at random over the bounds grown by a tenth of the diagonal ("box"), drawn from the surface with noise of a thousandth of
it ("near"), and the samples of a lattice over that box. Each contestant runs in a process of its own, on as many processors as threads;
medians of the rounds, in nanoseconds for each place, building excluded. pysdf keeps to all processors that it is given.

Then signs: models of which the truth is known, whole, with an opening, with some triangles flipped, and twice with an overlap; how many
places have the wrong sign, of those farther than a hundredth of the diagonal from the surface. pysdf needs Eigen where it is compiled
(Debian: libeigen3-dev, with CPLUS_INCLUDE_PATH=/usr/include/eigen3); without it its columns are left out.
"""
import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import environment

MODELS = ["bunny", "bumpy70k", "dragon202k", "dragon871k"]
PADDING = 0.1


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--rounds", type=int, default=3)
    arguments.add_argument("--threads", type=int, default=1)
    arguments.add_argument("--points", type=int, default=200_000)
    arguments.add_argument("--lattice", type=int, default=64)
    arguments.add_argument("--models", default=",".join(MODELS))
    arguments.add_argument("--peer", nargs=4, help="for one process: a peer's name, model, places, output")
    options = arguments.parse_args()
    environment.enter()
    environment.add_distance_peers()
    if options.peer:
        return measure_peer(*options.peer, options.threads)
    names = sorted({*options.models.split(","), "bumpy70k"})
    maker = environment.ROOT / "tests" / "bench" / "models.mjs"
    subprocess.run(["node", maker, environment.MODELS, *names], check=True, stdout=subprocess.DEVNULL)
    program = environment.measuring_program("distance")
    print(f"\n{options.threads} thread(s), medians of {options.rounds} round(s), ns for each place (theirs / ours)\n")
    print("| model | places | ours | Open3D | pysdf | largest difference of lengths |\n|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for name in options.models.split(","):
            model = environment.MODELS / f"{name}.ply"
            for kind, places in places_of(model, options).items():
                print(row(name, kind, model, places, program, options, folder), flush=True)
        print("\nWrong signs, per mille:\n\n| model | ours | Open3D | pysdf |\n|---|---|---|---|")
        signs(environment.MODELS / "bumpy70k.ply", program, options, folder)


def triangles_of(model):
    import numpy
    import open3d

    mesh = open3d.io.read_triangle_mesh(str(model))
    return numpy.asarray(mesh.vertices), numpy.asarray(mesh.triangles)


def places_of(model, options):
    import numpy

    random = numpy.random.default_rng(1)
    vertices, triangles = triangles_of(model)
    low, high = vertices.min(0), vertices.max(0)
    diagonal = numpy.linalg.norm(high - low)
    low, high = low - PADDING * diagonal, high + PADDING * diagonal
    box = random.uniform(low, high, (options.points, 3))
    corners = vertices[triangles[random.integers(len(triangles), size=options.points)]]
    weights = random.dirichlet([1, 1, 1], options.points)
    near = (corners * weights[:, :, None]).sum(1) + random.normal(0, 1e-3 * diagonal, (options.points, 3))
    n = options.lattice
    axes = [low[k] + (numpy.arange(n) + 0.5) / n * (high[k] - low[k]) for k in range(3)]
    z, y, x = numpy.meshgrid(axes[2], axes[1], axes[0], indexing="ij")
    lattice = numpy.stack([x, y, z], -1).reshape(-1, 3)
    return {"box": box, "near": near, f"lattice {n}³": lattice}


def row(name, kind, model, places, program, options, folder):
    import numpy

    found, times = {}, {"ours": [], "open3d": [], "pysdf": []}
    for _ in range(options.rounds):
        for who in times:
            each, values = ask(who, model, places, program, options, folder, kind)
            if each is not None:
                times[who].append(each)
                found[who] = values
    ours = statistics.median(times["ours"])
    cell = lambda who: f"{statistics.median(times[who]):.0f} ({statistics.median(times[who]) / ours:.1f} ×)" if times[who] else "—"
    off = lambda who: numpy.abs(numpy.abs(found[who]) - numpy.abs(found["ours"])).max() if who in found else float("nan")
    return f"| {name} | {kind} | {ours:.0f} | {cell('open3d')} | {cell('pysdf')} | {off('open3d'):.1e}, {off('pysdf'):.1e} |"


def ask(who, model, places, program, options, folder, kind="box"):
    """Nanoseconds for each place, and signed distances, negative inside; nothing if the peer is missing."""
    import numpy

    places.astype("<f8").tofile(folder / "places")
    if who == "ours":
        what = ["--lattice", options.lattice] if kind.startswith("lattice") else ["--points", folder / "places"]
        command = [program, model, *what, "--rounds", 1, "--output", folder / "found"]
    else:
        command = [sys.executable, __file__, "--threads", options.threads, "--peer", who, model, folder / "places", folder / "found"]
    try:
        each = environment.run_measured(command, options.threads)["each"]
    except environment.Failed as failure:
        if who == "ours":
            raise
        print(f"{who}: {failure}", file=sys.stderr)
        return None, None
    return each, numpy.fromfile(folder / "found", "<f8")


def measure_peer(who, model, places, output, threads):
    import numpy

    vertices, triangles = triangles_of(model)
    vertices, triangles = vertices.astype(numpy.float32), triangles.astype(numpy.uint32)
    places = numpy.fromfile(places, "<f8").reshape(-1, 3).astype(numpy.float32)
    if who == "open3d":
        import open3d

        scene = open3d.t.geometry.RaycastingScene(nthreads=threads)
        scene.add_triangles(vertices, triangles)
        ask = lambda some: scene.compute_signed_distance(some, nthreads=threads).numpy()
    else:
        import pysdf

        field = pysdf.SDF(vertices, triangles)
        ask = lambda some: -field(some)
    ask(places[:1])
    start = time.perf_counter()
    found = ask(places)
    seconds = time.perf_counter() - start
    found.astype("<f8").tofile(output)
    print(json.dumps({"each": 1e9 * seconds / len(places)}))


def signs(model, program, options, folder):
    import numpy
    import open3d

    vertices, triangles = triangles_of(model)
    random = numpy.random.default_rng(2)
    low, high = vertices.min(0), vertices.max(0)
    diagonal = numpy.linalg.norm(high - low)
    middles = vertices[triangles].mean(1)
    opening = numpy.linalg.norm(middles - middles[0], axis=1) < 0.15 * diagonal
    flipped = triangles.copy()
    some = random.random(len(triangles)) < 0.02
    flipped[some] = flipped[some][:, [0, 2, 1]]
    shift = numpy.array([0.15 * diagonal, 0, 0])
    twice = numpy.concatenate([vertices, vertices + shift]), numpy.concatenate([triangles, triangles + len(vertices)])
    cases = {
        "whole": (vertices, triangles),
        f"with an opening ({100 * opening.mean():.0f} % of the triangles gone)": (vertices, triangles[~opening]),
        "2 % flipped": (vertices, flipped),
        "two copies that overlap": twice,
    }
    places = random.uniform(low - 0.05 * diagonal, high + 0.05 * diagonal, (options.points // 4, 3))
    truth = lambda shifted: ask("ours", model, places - shifted, program, options, folder)[1]
    whole, moved = truth(0 * shift), truth(shift)
    for name, (v, t) in cases.items():
        mesh = open3d.geometry.TriangleMesh(open3d.utility.Vector3dVector(v), open3d.utility.Vector3iVector(t))
        path = folder / "variant.ply"
        open3d.io.write_triangle_mesh(str(path), mesh)
        right = numpy.minimum(whole, moved) if "overlap" in name else whole
        clear = numpy.abs(right) > 0.01 * diagonal
        cells = []
        for who in ["ours", "open3d", "pysdf"]:
            _, found = ask(who, path, places, program, options, folder)
            cells.append("—" if found is None else f"{1000 * ((found < 0) != (right < 0))[clear].mean():.2f}")
        print(f"| {name} | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
