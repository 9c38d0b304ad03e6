"""The jobs: which models, which questions, who is asked, and what is to be reached.

A mode of ours is a subcommand of tests/bench/measure.rs with its options; a goal is a least ratio, theirs / ours.
"""
from dataclasses import dataclass, field

VOXELS = ("voxels",)
CONTAINS = ("contains",)
BUILD = ("build",)
PREPARE = ("prepare",)
EXACT_ERROR = 1e-12


def values(tolerance):
    return ("values", "--tolerance", str(tolerance))


@dataclass
class Job:
    name: str
    # Names of models; of a job for models of the user's own, the stems of their files.
    models: list
    modes: list
    peers: list
    # Least ratio for a (mode, peer).
    goals: dict = field(default_factory=dict)
    # Samples on each axis of the bounds, or None.
    counts: int | None = None
    # Scattered points, or None.
    scattered: int | None = None
    # Samples on each axis of a plane through the middle, or None.
    plane: int | None = None
    # The field is built already: only the evaluation counts.
    prepared: bool = False
    # Our RMS has to be no worse than the peer's where a goal is set.
    rms: bool = False
    # Largest error of ours that a goal allows, by mode.
    errors: dict = field(default_factory=dict)
    # Largest share of the peer's memory that a goal allows.
    memory: float | None = None
    own: bool = False


MESH_PEERS = ["gpytoolbox", "open3d", "libigl", "point-cloud-utils"]
CLOUD_PEERS = ["point-cloud-utils", "libigl-cloud"]
CLOSED = ["bumpy70k", "knot124k"]
THIN = ["featuretype", "cycloidal"]
LOOSE_TOLERANCES = [2e-2, 1e-2, 1e-3]
CLOUD_TOLERANCES = [3e-2, 1e-2, 1e-3]

JOBS = [
    Job(
        "voxels, closed", [*CLOSED, "dragon202k"], [VOXELS, values(0)], MESH_PEERS, counts=100,
        goals={(VOXELS, "gpytoolbox"): 50, (VOXELS, "open3d"): 10},
        errors={values(0): EXACT_ERROR},
    ),
    Job(
        "voxels, open", ["bunny"], [VOXELS, values(1e-5), values(0)], MESH_PEERS, counts=100,
        goals={(VOXELS, "gpytoolbox"): 40, (values(1e-5), "gpytoolbox"): 25, (values(0), "gpytoolbox"): 8},
        errors={values(1e-5): 1e-5, values(0): EXACT_ERROR},
    ),
    Job(
        "voxels, open, others", ["snowden", "teapot"], [VOXELS, values(1e-5), values(0)], ["gpytoolbox", "open3d"], counts=100,
        errors={values(1e-5): 1e-5, values(0): EXACT_ERROR},
    ),
    Job(
        "voxels, thin triangles", THIN, [VOXELS, values(0)], MESH_PEERS, counts=100, own=True,
        goals={(VOXELS, "gpytoolbox"): 400}, errors={values(0): EXACT_ERROR},
    ),
    Job(
        "voxels, open parts", ["truck"], [VOXELS, values(0)], MESH_PEERS, counts=100, own=True,
        goals={(VOXELS, "gpytoolbox"): 50}, errors={values(0): EXACT_ERROR},
    ),
    Job("voxels, own models", [], [VOXELS, values(0)], MESH_PEERS, counts=100, own=True),
    Job("voxels 256, closed", ["bumpy70k", "knot124k"], [VOXELS], ["gpytoolbox"], counts=256, goals={(VOXELS, "gpytoolbox"): 200}),
    Job(
        "contains, closed", CLOSED, [CONTAINS], ["gpytoolbox", "open3d"], scattered=1_000_000, prepared=True,
        goals={(CONTAINS, "gpytoolbox"): 20, (CONTAINS, "open3d"): 4},
    ),
    Job(
        "contains, open", ["bunny"], [CONTAINS], ["gpytoolbox", "open3d"], scattered=1_000_000, prepared=True,
        goals={(CONTAINS, "gpytoolbox"): 6},
    ),
    Job(
        "loose soup", ["loose-bunny"], [VOXELS, *map(values, LOOSE_TOLERANCES)], ["gpytoolbox", "libigl"], counts=100, rms=True,
        goals={(mode, "gpytoolbox"): 8 for mode in [VOXELS, *map(values, LOOSE_TOLERANCES)]},
    ),
    Job(
        "cloud", ["cloud-bunny35k", "cloud-knot134k"], [*map(values, CLOUD_TOLERANCES)], CLOUD_PEERS, counts=100, rms=True,
        goals={(mode, "point-cloud-utils"): 100 for mode in map(values, CLOUD_TOLERANCES)},
    ),
    Job("cloud, large", ["cloud-knot300k"], [*map(values, CLOUD_TOLERANCES)], CLOUD_PEERS[:1], counts=100, rms=True),
    # Barill et al. 2018, Fig. 16.
    Job(
        "slice of a cloud", ["cloud-knot300k"], [*map(values, CLOUD_TOLERANCES)], CLOUD_PEERS, plane=500, prepared=True, rms=True,
        goals={(mode, peer): 100 for mode in map(values, CLOUD_TOLERANCES) for peer in CLOUD_PEERS},
    ),
    Job(
        "preparation of a cloud", ["cloud-knot100k"], [PREPARE], ["libigl-areas"],
        goals={(PREPARE, "libigl-areas"): 20}, memory=0.1,
    ),
    Job(
        "build", ["bumpy70k"], [BUILD], ["gpytoolbox", "libigl", "open3d"],
        goals={(BUILD, "gpytoolbox"): 3}, memory=0.25,
    ),
    Job(
        "build, large", ["bumpy1m", "dragon871k"], [BUILD], ["gpytoolbox", "libigl", "open3d"],
        goals={(BUILD, "gpytoolbox"): 4}, memory=0.25,
    ),
]


# Modes that answer nothing.
BUILDS = ([BUILD], [PREPARE])


def mode_name(mode):
    return " ".join(mode).replace("--tolerance ", "≤ ")


def chosen(only, own):
    """The jobs named, with the models of the user's own shared out by the stems of their files."""
    expected = {stem for job in JOBS for stem in job.models if job.own}
    for job in JOBS:
        if job.own:
            job.models = [stem for stem in own if stem in job.models or (not job.models and stem not in expected)]
    slugs = {slug(job): job for job in JOBS}
    unknown = [name for name in only if name not in slugs]
    if unknown:
        raise SystemExit(f"unknown job {unknown[0]}: {', '.join(slugs)} are known")
    return [job for name, job in slugs.items() if job.models and (not only or name in only)]


def slug(job):
    return job.name.replace(",", "").replace(" ", "-")
