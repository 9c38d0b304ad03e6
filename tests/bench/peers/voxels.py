"""Voxels written by us, read by programs of the formats: nothing is to be lost.

    python3 tests/bench/peers/voxels.py [MODEL] [--resolution 300]

pynrrd reads NRRD, packed and raw, with the places of its axes. SimpleITK reads it as medical programs do. py-vox-io reads the models of
VOX; it refuses the scene graph, which is read here, and by the crate dot_vox in tests/voxel_files.rs.
"""
import argparse
import json
import pathlib
import struct
import subprocess
import tempfile

import environment

BUNNY = environment.MODELS / "bunny.ply"
READERS = ["numpy==2.4.6", "pynrrd==1.1.3", "py-vox-io==0.1", "SimpleITK==2.5.7"]


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("model", nargs="?", default=BUNNY)
    arguments.add_argument("--resolution", type=int, default=300)
    options = arguments.parse_args()
    environment.enter("voxel-readers", READERS)
    program = environment.measuring_program("voxels")
    import numpy as np

    with tempfile.TemporaryDirectory() as folder:
        command = [program, "files", options.model, folder, "--resolution", str(options.resolution)]
        subprocess.run(command, check=True)
        folder = pathlib.Path(folder)
        for name in ("small", "large"):
            lattice = json.loads((folder / f"{name}.json").read_text())
            nx, ny, nz = lattice["counts"]
            voxels = np.fromfile(folder / f"{name}.u8", np.uint8).reshape(nz, ny, nx).transpose(2, 1, 0)
            print(f"{name}: {nx} × {ny} × {nz} voxels, {int(voxels.sum())} inside")
            for check in (check_pynrrd, check_itk, check_vox):
                print(f"  {check.__name__}: {check(folder / name, lattice, voxels)}")


def equal(found, expected, what):
    assert found == expected, f"{what}: {found!r} instead of {expected!r}"


def check_pynrrd(path, lattice, voxels):
    import nrrd
    import numpy as np

    for suffix in ("", "-raw"):
        data, header = nrrd.read(f"{path}{suffix}.nrrd")
        assert data.dtype == np.uint8 and np.array_equal(data, voxels), "voxels"
        equal(header["space origin"].tolist(), lattice["origin"], "origin")
        equal(np.diag(header["space directions"]).tolist(), lattice["spacing"], "spacing")
        equal(header["space"], "3D-right-handed", "space")
        equal(header["space units"], ["mm"] * 3, "units")
    return f"every voxel and place, packed and raw, by pynrrd {nrrd.__version__}"


def check_itk(path, lattice, voxels):
    import numpy as np
    import SimpleITK

    for suffix in ("", "-raw"):
        image = SimpleITK.ReadImage(f"{path}{suffix}.nrrd")
        assert np.array_equal(SimpleITK.GetArrayFromImage(image), voxels.transpose(2, 1, 0)), "voxels"
        # It takes axes as left, posterior, superior, whatever the file says they are.
        assert np.allclose(np.abs(image.GetOrigin()), np.abs(lattice["origin"]), rtol=1e-12), "origin"
        assert np.allclose(image.GetSpacing(), lattice["spacing"], rtol=1e-12), "spacing"
    return f"every voxel, spacing and origin, by SimpleITK {SimpleITK.Version_VersionString()}"


def seen(voxels):
    """Voxels inside that have a neighbour outside."""
    import numpy as np

    padded = np.pad(voxels, 1)
    hidden = np.ones_like(voxels)
    for axis in range(3):
        for step in (-1, 1):
            hidden &= np.roll(padded, step, axis)[1:-1, 1:-1, 1:-1]
    return voxels & (1 - hidden)


def check_vox(path, lattice, voxels):
    import numpy as np
    from pyvox.parser import VoxParser

    counts = lattice["counts"]
    models = 0
    for suffix, expected in (("", voxels), ("-shell", seen(voxels))):
        places, rest = scene(pathlib.Path(f"{path}{suffix}.vox").read_bytes())
        plain = pathlib.Path(f"{path}{suffix}-plain.vox")
        plain.write_bytes(rest)
        file = VoxParser(plain).parse()
        found = np.zeros(counts, np.uint8)
        for number, model in enumerate(file.models):
            size = [model.size.x, model.size.y, model.size.z]
            own = np.array([(v.x, v.y, v.z) for v in model.voxels])
            if places:
                middle = [counts[0] // 2, counts[1] // 2, 0]
                own = own + [places[number][k] - size[k] // 2 + middle[k] for k in range(3)]
            found[own[:, 0], own[:, 1], own[:, 2]] += 1
        assert np.array_equal(found, expected), "voxels"
        models = len(file.models)
    return f"every voxel, solid and as a shell, in {models} models, by py-vox-io"


def scene(data):
    """Where each model is: translations of the nTRN above its nSHP; and the file without its scene graph, which py-vox-io refuses."""
    places, at, kept = {}, 20, b""
    transforms = {}
    while at < len(data):
        name, content, children = data[at : at + 4], *struct.unpack_from("<2i", data, at + 4)
        if name == b"nTRN":
            node, empty, child, _, _, _, pairs = struct.unpack_from("<7i", data, at + 12)
            assert empty == 0
            if pairs:
                _, key, length = struct.unpack_from("<i2si", data, at + 40)
                equal((pairs, key), (1, b"_t"), "attributes of a place")
                transforms[child] = [int(n) for n in data[at + 50 : at + 50 + length].split()]
        elif name == b"nSHP":
            node, empty, count, model, _ = struct.unpack_from("<5i", data, at + 12)
            places[model] = transforms[node]
        if name in (b"SIZE", b"XYZI", b"RGBA"):
            kept += data[at : at + 12 + content]
        at += 12 + content + children
    # It counts models by the chunk that came before scene graphs.
    kept = b"PACK" + struct.pack("<3i", 4, 0, max(len(places), 1)) + kept
    return places, data[:16] + struct.pack("<i", len(kept)) + kept


if __name__ == "__main__":
    main()
