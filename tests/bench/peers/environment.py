"""Where things lie, the throw-away environment that has the peers, and our measuring program."""
import json
import os
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[3]
CACHE = pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache") / "fast-winding"
MODELS = pathlib.Path(os.environ.get("CARGO_TARGET_DIR") or ROOT / "target") / "bench-models"
PEERS = [
    "numpy==2.4.6",
    "gpytoolbox==0.3.8",
    "libigl==2.6.3",
    "point-cloud-utils==0.34.0",
    "open3d==0.20.0",
]
# Signed distances; made from its sources, which need Eigen.
DISTANCE_PEERS = ["pysdf==0.1.9"]
# Readers of the formats that layers are written in.
READERS = ["numpy==2.4.6", "ezdxf==1.4.5", "lib3mf==2.5.0", "lxml==6.1.3", "networkx==3.6.1", "svgpathtools==1.8.0", "trimesh==5.2.0"]
# Open3D's wheel loads these libraries of the system.
DEBIAN_PACKAGES = ["libusb-1.0-0", "libgl1", "libgomp1", "libx11-6"]


def enter(name="peers", packages=PEERS):
    """Restarts this program inside the environment that has the packages; makes it first where it is missing."""
    environment = CACHE / name
    python = environment / "bin" / "python"
    if pathlib.Path(sys.prefix) == environment:
        return
    if not (environment / "ready").exists():
        print("installing", *packages, "into", environment, file=sys.stderr)
        subprocess.run([sys.executable, "-m", "venv", environment], check=True)
        subprocess.run([python, "-m", "pip", "install", "--quiet", *packages], check=True)
        (environment / "ready").touch()
    if packages is PEERS:
        install_libraries(python)
    os.execv(python, [str(python), *sys.argv])


def install_libraries(python):
    """The system's libraries for Open3D; without them the rows beside Open3D are left out."""
    if subprocess.run([python, "-c", "import open3d"], capture_output=True).returncode == 0:
        return
    if shutil.which("apt-get"):
        print("installing Debian packages:", *DEBIAN_PACKAGES, file=sys.stderr)
        sudo = [] if os.getuid() == 0 else ["sudo", "-n"]
        for words in (["update"], ["install", "-y", "--no-install-recommends", *DEBIAN_PACKAGES]):
            subprocess.run([*sudo, "apt-get", *words], stdout=subprocess.DEVNULL, check=False)


def add_distance_peers():
    """Puts the peers of distances, which have no wheels, into the environment that this program runs in."""
    if subprocess.run([sys.executable, "-c", "import pysdf"], capture_output=True).returncode == 0:
        return
    if shutil.which("apt-get"):
        print("installing the Debian package libeigen3-dev", file=sys.stderr)
        sudo = [] if os.getuid() == 0 else ["sudo", "-n"]
        words = ["install", "-y", "--no-install-recommends", "libeigen3-dev"]
        subprocess.run([*sudo, "apt-get", *words], stdout=subprocess.DEVNULL, check=False)
    includes = {**os.environ, "CPLUS_INCLUDE_PATH": "/usr/include/eigen3"}
    subprocess.run([sys.executable, "-m", "pip", "install", "--quiet", *DISTANCE_PEERS], env=includes, check=True)


def measuring_program(name="measure"):
    """Path of a program of tests/bench/, built for release."""
    command = ["cargo", "build", "--release", "--quiet", "--example", name, "--message-format=json"]
    output = subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True).stdout
    messages = (json.loads(line) for line in output.splitlines())
    return next(m["executable"] for m in messages if m.get("executable"))


class Failed(Exception):
    """A measured process ended badly; the message says how."""


def run_measured(command, threads, seconds=None):
    """Runs a process on `threads` processors and returns the JSON that it prints last, if any."""
    processors = set(sorted(os.sched_getaffinity(0))[:threads])
    names = ["RAYON_NUM_THREADS", "IGL_NUM_THREADS", "OMP_NUM_THREADS"]
    variables = {**os.environ, **{name: str(threads) for name in names}}
    try:
        done = subprocess.run(
            [str(word) for word in command], capture_output=True, text=True, timeout=seconds,
            env=variables, preexec_fn=lambda: os.sched_setaffinity(0, processors),
        )
    except subprocess.TimeoutExpired:
        raise Failed(f"over {seconds} s") from None
    if done.returncode < 0:
        raise Failed(f"crashed (signal {-done.returncode})")
    if done.returncode:
        raise Failed(done.stderr.strip().splitlines()[-1] if done.stderr.strip() else f"exit code {done.returncode}")
    return json.loads((done.stdout.strip() or "{}").splitlines()[-1])
