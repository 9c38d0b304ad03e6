"""Layers written by us, read by programs of the formats: nothing is to be lost.

    python3 tests/bench/peers/roundtrip.py [MODEL] [--layers 60]

lib3mf, the 3MF Consortium's own library, reads the package in strict mode: slices, tops, mesh. trimesh reads its mesh. ezdxf reads
and audits the drawing. svgpathtools reads each layer's paths; xml.etree reads the drawing of all layers as programs for projectors do,
and the package, to the last bit, which lib3mf rounds. Python's own json reads the plain polygons.
"""
import argparse
import json
import pathlib
import subprocess
import tempfile
import zipfile
from xml.etree import ElementTree

import environment

BUNNY = environment.ROOT / "www" / "node_modules" / "stl-models" / "objects" / "bunny.bin.stl"
SVG = "{http://www.w3.org/2000/svg}"
SLIC3R = "{http://slic3r.org/namespaces/slic3r}"
SLICE = "{http://schemas.microsoft.com/3dmanufacturing/slice/2015/07}"
# Drawings are rounded to a nanometre, places on them twice.
SVG_ERROR = 1.1e-6


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("model", nargs="?", default=BUNNY)
    arguments.add_argument("--layers", type=int, default=60)
    options = arguments.parse_args()
    environment.enter("readers", environment.READERS)
    program = environment.measuring_program("exports")
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, options.model, folder, "--layers", str(options.layers)], check=True)
        folder = pathlib.Path(folder)
        layers = read_truth(folder / "layers.f64")
        rings = [ring for layer in layers for polygon in layer.polygons for ring in polygon]
        print(f"{len(layers)} layers, {len(rings)} rings, {sum(map(len, rings))} points")
        for check in (check_json, check_dxf, check_svg, check_drawings, check_package, check_lib3mf, check_trimesh):
            print(f"{check.__name__}: {check(folder, layers)}")


class Layer:
    def __init__(self, bottom, top, sample, polygons):
        self.bottom, self.top, self.sample, self.polygons = bottom, top, sample, polygons

    def rings(self):
        return [ring for polygon in self.polygons for ring in polygon]


def read_truth(path):
    import numpy as np

    numbers = iter(np.fromfile(path, "<f8").tolist())

    def ring():
        return [(next(numbers), next(numbers)) for _ in range(int(next(numbers)))]

    layers = []
    for bottom in numbers:
        top, sample, count = next(numbers), next(numbers), int(next(numbers))
        layers.append(Layer(bottom, top, sample, [[ring() for _ in range(int(next(numbers)))] for _ in range(count)]))
    return layers


def equal(found, expected, what):
    assert found == expected, f"{what}: {found!r} instead of {expected!r}"


def check_json(folder, layers):
    found = json.loads((folder / "layers.json").read_text())
    equal(len(found), len(layers), "layers")
    for layer, other in zip(layers, found):
        equal([other["zBottom"], other["zTop"], other["zSample"]], [layer.bottom, layer.top, layer.sample], "heights")
        polygons = [[list(map(tuple, ring)) for ring in [p["outer"], *p["holes"]]] for p in other["polygons"]]
        equal(polygons, layer.polygons, "polygons")
    return "every bit, by Python's json"


def check_dxf(folder, layers):
    import ezdxf
    from ezdxf import recover

    document, auditor = recover.readfile(folder / "layers.dxf")
    equal([str(e) for e in auditor.errors], [], "errors")
    strict = ezdxf.readfile(folder / "layers.dxf")
    equal(strict.dxfversion, "AC1009", "version")
    equal(strict.header["$INSUNITS"], 4, "units, which are millimetres")
    found = {layer.dxf.name: [] for layer in strict.layers if layer.dxf.name.startswith("SLICE_")}
    equal(list(found), [f"SLICE_{k}" for k in range(len(layers))], "layers")
    for line in strict.modelspace():
        equal((line.dxftype(), line.is_closed), ("POLYLINE", True), "entity")
        places = [vertex.dxf.location for vertex in line.vertices]
        z = layers[int(line.dxf.layer.removeprefix("SLICE_"))].sample
        assert line.dxf.elevation.z == z and all(place.z == z for place in places)
        found[line.dxf.layer].append([(place.x, place.y) for place in places])
    equal(list(found.values()), [layer.rings() for layer in layers], "rings")
    return f"every bit, no errors and {len(auditor.fixes)} repairs in its audit, by ezdxf {ezdxf.__version__}"


def near(found, expected):
    """Rings of complex numbers beside those of pairs, in any order of the rings."""
    assert len(found) == len(expected), f"{len(found)} rings instead of {len(expected)}"
    worst, left = 0.0, list(found)
    for ring in expected:
        points = [complex(*point) for point in ring]
        alike = [other for other in left if len(other) == len(points)]
        gaps = [max(abs(a - b) for a, b in zip(other, points)) for other in alike]
        assert gaps and min(gaps) < SVG_ERROR, f"a ring of {len(ring)} points is off by {min(gaps, default='all')}"
        worst = max(worst, min(gaps))
        del left[next(k for k, other in enumerate(left) if other is alike[gaps.index(min(gaps))])]
    return worst


def check_svg(folder, layers):
    root = ElementTree.parse(folder / "layers.svg").getroot()
    width, height = (float(root.get(name).removesuffix("mm")) for name in ("width", "height"))
    equal([float(v) for v in root.get("viewBox").split()], [0, 0, width, height], "viewBox")
    corner = complex(float(root.get("data-left")), float(root.get("data-top")))
    groups = root.findall(f"{SVG}g")
    equal([group.get("id") for group in groups], [f"layer{k}" for k in range(len(layers))], "groups")
    worst = 0.0
    for group, layer in zip(groups, layers):
        assert abs(float(group.get(f"{SLIC3R}z")) - layer.top) < SVG_ERROR
        found = []
        for polygon in group.findall(f"{SVG}polygon"):
            points = [tuple(map(float, pair.split(","))) for pair in polygon.get("points").split()]
            assert all(0 <= x <= width and 0 <= y <= height for x, y in points)
            found.append([corner + complex(x, -y) for x, y in points])
        kinds = [polygon.get(f"{SLIC3R}type") for polygon in group.findall(f"{SVG}polygon")]
        equal(kinds.count("contour"), len(layer.polygons), "contours")
        worst = max(worst, near(found, layer.rings()))
    return f"all rings, at most {worst:.1e} mm off, by xml.etree"


def check_drawings(folder, layers):
    import svgpathtools

    worst = 0.0
    for number, layer in enumerate(layers):
        _, attributes = svgpathtools.svg2paths(str(folder / f"layer{number}.svg"))
        assert all(a["fill-rule"] == "evenodd" for a in attributes)
        found = []
        # One ring after the other: a hole that begins where its outline does would be taken for its continuation.
        for part in (f"M{part}" for a in attributes for part in a["d"].split("M")[1:]):
            path = svgpathtools.parse_path(part)
            assert path.isclosed()
            found.append([line.start.conjugate() for line in path])
        worst = max(worst, near(found, layer.rings()))
    return f"all rings, at most {worst:.1e} mm off, by svgpathtools"


def check_package(folder, layers):
    with zipfile.ZipFile(folder / "layers.3mf") as archive:
        equal(archive.testzip(), None, "the first bad file")
        root = ElementTree.fromstring(archive.read("3D/3dmodel.model"))
    stack = root.find(f".//{SLICE}slicestack")
    slices = stack.findall(f"{SLICE}slice")
    equal(float(stack.get("zbottom")), layers[0].bottom, "zbottom")
    equal([float(s.get("ztop")) for s in slices], [layer.top for layer in layers], "tops")
    for part, layer in zip(slices, layers):
        vertices = [(float(v.get("x")), float(v.get("y"))) for v in part.iter(f"{SLICE}vertex")]
        equal(len(set(vertices)), len(vertices), "vertices that differ")
        rings = []
        for polygon in part.iter(f"{SLICE}polygon"):
            indices = [int(polygon.get("startv")), *(int(s.get("v2")) for s in polygon)]
            equal(indices[0], indices[-1], "the end of a polygon")
            rings.append([vertices[k] for k in indices[:-1]])
        equal(rings, layer.rings(), "rings")
    return "every bit, by zipfile and xml.etree"


def check_lib3mf(folder, layers):
    import lib3mf

    wrapper = lib3mf.get_wrapper()
    model = wrapper.CreateModel()
    reader = model.QueryReader("3mf")
    reader.SetStrictModeActive(True)
    reader.ReadFromFile(str(folder / "layers.3mf"))
    equal([reader.GetWarning(k) for k in range(reader.GetWarningCount())], [], "warnings")
    objects = model.GetMeshObjects()
    assert objects.MoveNext()
    mesh = objects.GetCurrentMeshObject()
    assert mesh.HasSlices(False) and mesh.GetSlicesMeshResolution() == lib3mf.SlicesMeshResolution.Fullres
    stack = mesh.GetSliceStack()
    equal(stack.GetSliceCount(), len(layers), "slices")
    near_enough = lambda a, b: abs(a - b) <= 1e-6 * max(1.0, abs(b))
    assert near_enough(stack.GetBottomZ(), layers[0].bottom)
    for number, layer in enumerate(layers):
        part = stack.GetSlice(number)
        assert near_enough(part.GetZTop(), layer.top)
        vertices = [tuple(v.Coordinates) for v in part.GetVertices()]
        equal(part.GetPolygonCount(), len(layer.rings()), "polygons")
        for k, ring in enumerate(layer.rings()):
            indices = list(part.GetPolygonIndices(k))
            equal(indices[0], indices[-1], "the end of a polygon")
            equal(len(indices) - 1, len(ring), "points of a ring")
            assert all(near_enough(a, b) for i, p in zip(indices, ring) for a, b in zip(vertices[i], p))
    version = ".".join(map(str, wrapper.GetLibraryVersion()[:3]))
    return f"all slices to its single precision, strict and without warnings, {mesh.GetTriangleCount()} triangles, by lib3mf {version}"


def check_trimesh(folder, layers):
    import trimesh

    mesh = trimesh.load(folder / "layers.3mf", force="mesh")
    section = trimesh.load(folder / "layers.dxf", process=False)
    equal(len(section.entities), sum(len(layer.rings()) for layer in layers), "closed paths of the drawing")
    return f"{len(mesh.faces)} triangles of the package, all closed paths of the drawing, by trimesh {trimesh.__version__}"


if __name__ == "__main__":
    main()
