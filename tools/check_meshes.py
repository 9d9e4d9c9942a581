#!/usr/bin/env python3
"""Opens every mesh that cutlab writes in an independent reader (trimesh) and compares it with `cutlab show`.

    python3 -m venv /tmp/venv && /tmp/venv/bin/pip install trimesh networkx numpy
    cargo build --release && /tmp/venv/bin/python tools/check_meshes.py

Each cut of the library, or each STONE that is given, is written in every mesh format that trimesh
reads. Every file must open without a warning, be watertight, consistently wound and outward, have no
triangle without area, and enclose the volume that `show` tells. Ends with 1 if one does not.
"""

import json
import logging
import subprocess
import sys
import tempfile
import warnings
from pathlib import Path

import trimesh

CUTLAB = Path(__file__).resolve().parent.parent / "target/release/cutlab"
FORMATS = {"obj": "obj", "stl": "stl", "stl-text": "stl", "ply": "ply", "ply-text": "ply", "glb": "glb", "gltf": "gltf"}
# volumes: formats in f32, and in f64
ALLOWED = 1e-6


class Complaints(logging.Handler):
    """Everything that trimesh logs as a warning or worse."""

    def __init__(self):
        super().__init__(logging.WARNING)
        self.said = []

    def emit(self, record):
        self.said.append(record.getMessage())


def run(*arguments):
    done = subprocess.run([CUTLAB, *arguments], capture_output=True, check=True)
    return done.stdout


def problems(path, volume, complaints):
    """What is wrong with the mesh at `path`."""
    complaints.said.clear()
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        # facets share their corners in the file; only STL repeats them, and glTF nodes are merged
        mesh = trimesh.load(path, force="mesh", process=False)
        mesh.merge_vertices(merge_norm=True, merge_tex=True)
    found = [str(w.message) for w in caught] + complaints.said
    if not mesh.is_watertight:
        found.append("not watertight")
    if not mesh.is_winding_consistent:
        found.append("winding inconsistent")
    if not (mesh.area_faces > 0).all():
        found.append(f"{(mesh.area_faces <= 0).sum()} triangles without area")
    off = mesh.volume / volume - 1
    if not abs(off) < ALLOWED:
        found.append(f"volume {mesh.volume}, shown {volume}")
    return found, abs(off)


def main():
    stones = sys.argv[1:] or [cut["name"] for cut in json.loads(run("list", "cuts", "--json"))]
    complaints = Complaints()
    logging.getLogger("trimesh").addHandler(complaints)
    bad, worst = 0, dict.fromkeys(FORMATS, 0.0)
    with tempfile.TemporaryDirectory() as folder:
        for stone in stones:
            volume = json.loads(run("show", "--json", stone))[0]["volume"]
            for name, ending in FORMATS.items():
                path = Path(folder) / f"stone.{ending}"
                path.write_bytes(run("generate", stone, "-o", "-", "--to", name, "--quiet"))
                found, off = problems(path, volume, complaints)
                worst[name] = max(worst[name], off)
                bad += bool(found)
                for problem in found:
                    print(f"{stone} as {name}: {problem}")
    largest = ", ".join(f"{name} {off:.1e}" for name, off in worst.items())
    print(f"{len(stones)} stones in {len(FORMATS)} formats: {bad} files with problems; volumes off by at most {largest}")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
