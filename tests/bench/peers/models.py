"""Models and queries as arrays. tests/bench/models.mjs makes the models; here they are read."""
import pathlib
import re
import subprocess
from dataclasses import dataclass

import numpy as np

from environment import MODELS, ROOT

FACE = np.dtype([("corners", "u1"), ("indices", "<i4", 3)])
SCATTER_SEED = 7


@dataclass
class Mesh:
    vertices: np.ndarray
    faces: np.ndarray

    def __len__(self):
        return len(self.faces)

    def bounds(self):
        used = self.vertices[np.unique(self.faces)]
        return used.min(axis=0), used.max(axis=0)


@dataclass
class Cloud:
    points: np.ndarray
    normals: np.ndarray
    areas: np.ndarray

    def __len__(self):
        return len(self.points)

    def bounds(self):
        return self.points.min(axis=0), self.points.max(axis=0)


def make(names):
    """Paths of the models of those names, by name."""
    if not (ROOT / "www" / "node_modules" / "snowden").exists():
        raise SystemExit("models are missing: run `npm --prefix www ci --ignore-scripts` first")
    command = ["node", ROOT / "tests" / "bench" / "models.mjs", MODELS, *names]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return {name: next(MODELS.glob(f"{name}.*[!t]")) for name in names}


def adopt(path):
    """Name and path of a model of the user's own, in the form that every contestant reads alike."""
    import igl

    path = pathlib.Path(path)
    vertices, faces = igl.read_triangle_mesh(str(path))
    target = MODELS / f"{path.stem}.ply"
    write_ply(target, Mesh(np.asarray(vertices, float), np.asarray(faces)))
    return path.stem, target


def read(path):
    return read_cloud(path) if path.suffix == ".f64" else read_ply(path)


def read_cloud(path):
    records = np.fromfile(path).reshape(-1, 7)
    return Cloud(*(np.ascontiguousarray(part) for part in (records[:, :3], records[:, 3:6], records[:, 6])))


def read_ply(path):
    """A mesh as written by models.mjs and `write_ply`: doubles and triangles, binary."""
    data = path.read_bytes()
    start = data.index(b"end_header\n") + len(b"end_header\n")
    head = data[:start].decode()
    vertices, faces = (int(re.search(rf"element {element} (\d+)", head)[1]) for element in ("vertex", "face"))
    positions = np.frombuffer(data, "<f8", 3 * vertices, start).reshape(-1, 3).copy()
    records = np.frombuffer(data, FACE, faces, start + 24 * vertices)
    return Mesh(positions, records["indices"].astype(np.int64))


def write_ply(path, mesh):
    path.parent.mkdir(parents=True, exist_ok=True)
    records = np.empty(len(mesh.faces), FACE)
    records["corners"], records["indices"] = 3, mesh.faces
    head = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(mesh.vertices)}\n"
        "property double x\nproperty double y\nproperty double z\n"
        f"element face {len(mesh.faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    path.write_bytes(head.encode() + mesh.vertices.astype("<f8").tobytes() + records.tobytes())


@dataclass
class Queries:
    """Points to ask, in chunks: planes of a lattice, or hundredths of scattered points."""

    points: np.ndarray
    chunk: int
    name: str

    def __len__(self):
        return len(self.points)

    def asked(self, stride):
        """Places of the points of every `stride`-th chunk: the same choice as the peers make."""
        return np.concatenate([np.arange(first, last) for first, last in chunks(len(self), self.chunk, stride)])


def chunks(count, chunk, stride):
    """First and last place (exclusive) of every `stride`-th chunk, beginning in the middle of the first stride."""
    return [(at, min(at + chunk, count)) for at in range(chunk * (stride // 2), count, chunk * stride)]


def lattice(model, count):
    """`count` samples on each axis of the bounds, at cell centres, x fastest: as `Lattice::with_counts`."""
    low, high = model.bounds()
    spacing = (high - low) / count
    axes = [low[axis] + 0.5 * spacing[axis] + spacing[axis] * np.arange(count) for axis in range(3)]
    z, y, x = np.meshgrid(axes[2], axes[1], axes[0], indexing="ij")
    return Queries(np.stack([x, y, z], axis=-1).reshape(-1, 3), count * count, f"{count}³")


def plane(model, count):
    """`count` samples on both axes of the plane through the middle of the bounds across z, at cell centres, x fastest."""
    low, high = model.bounds()
    x, y = (low[axis] + (high[axis] - low[axis]) * (np.arange(count) + 0.5) / count for axis in range(2))
    points = np.empty((count, count, 3))
    points[..., 0], points[..., 1], points[..., 2] = x[None, :], y[:, None], 0.5 * (low[2] + high[2])
    return Queries(points.reshape(-1, 3), count, f"{count}²")


def scattered(model, count):
    """Points spread evenly over the bounds, from a seed."""
    low, high = model.bounds()
    points = low + (high - low) * np.random.default_rng(SCATTER_SEED).random((count, 3))
    return Queries(points, max(count // 100, 1), f"{count:,} scattered")
