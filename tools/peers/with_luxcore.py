"""LuxCore on table.toml with its caustic cache (PhotonGI); called by compare.py. Writes luminance as .npy
and prints processor seconds of the session (photons and rendering) as JSON.
"""

import argparse
import glob
import importlib.util
import json
import os
import sys
import time

# its own malloc has to come before Python's, else pyluxcore 2.11 dies of `free(): invalid pointer`
if "LD_PRELOAD" not in os.environ:
    package = importlib.util.find_spec("pyluxcore")
    if package is None:
        sys.exit("no pyluxcore here")
    libraries = os.path.join(os.path.dirname(package.origin), "..", "pyluxcore.libs")
    malloc = glob.glob(os.path.join(libraries, "libtbbmalloc_proxy*"))
    os.execve(sys.executable, [sys.executable, *sys.argv], os.environ | {"LD_PRELOAD": ":".join(malloc)})

import numpy as np
import pyluxcore

import scene

# Cauchy's law through diamond's n at C, D and F (physics: 2.40990, 2.41726, 2.43554); LuxCore holds
# `interiorior` at 589 nm
N_D, CAUCHY_B = 2.41726, (2.43554 - 2.40990) / (0.486134**-2 - 0.656281**-2)


def triangles(faces):
    return [(face[0], face[k], face[k + 1]) for face in faces for k in range(1, len(face) - 1)]


def rectangle(half, z, centre=(0.0, 0.0), down=False):
    x, y = centre
    corners = [(x - half, y - half, z), (x + half, y - half, z), (x + half, y + half, z), (x - half, y + half, z)]
    faces = [(0, 1, 2), (0, 2, 3)]
    return corners, [f[::-1] for f in faces] if down else faces


def world(depth):
    properties = pyluxcore.Properties()

    def put(name, *values):
        properties.Set(pyluxcore.Property(name, list(values)))

    put("scene.camera.type", "perspective")
    put("scene.camera.lookat.orig", *map(float, scene.AT))
    put("scene.camera.lookat.target", *map(float, scene.TO))
    put("scene.camera.up", 0.0, 0.0, 1.0)
    put("scene.camera.fieldofview", scene.FIELD)
    put("scene.camera.autovolume.enable", False)
    put("scene.materials.diamond.type", "glass")
    put("scene.materials.diamond.kr", 1.0, 1.0, 1.0)
    put("scene.materials.diamond.kt", 1.0, 1.0, 1.0)
    put("scene.materials.diamond.interiorior", N_D)
    put("scene.materials.diamond.exteriorior", 1.0)
    put("scene.materials.diamond.cauchyb", CAUCHY_B)
    put("scene.materials.grey.type", "matte")
    put("scene.materials.grey.kd", *[scene.ALBEDO] * 3)
    put("scene.materials.lamp.type", "matte")
    put("scene.materials.lamp.kd", 0.0, 0.0, 0.0)
    put("scene.materials.lamp.emission", *[scene.RADIANCE] * 3)
    put("scene.materials.lamp.emission.power", 0.0)
    put("scene.materials.lamp.emission.efficency", 0.0)
    put("scene.materials.lamp.emission.normalizebycolor", False)
    made = pyluxcore.Scene()
    vertices, faces = scene.mesh()
    shapes = {
        "diamond": ([tuple(map(float, v)) for v in vertices], triangles(faces)),
        "grey": rectangle(scene.TABLE_HALF, 0.0),
        "lamp": rectangle(scene.LIGHT_SIDE / 2, scene.LIGHT_AT[2], scene.LIGHT_AT[:2], down=True),
    }
    for name, (points, faces) in shapes.items():
        made.DefineMesh(f"{name}-mesh", points, faces, None, None, None, None)
        put(f"scene.objects.{name}.shape", f"{name}-mesh")
        put(f"scene.objects.{name}.material", name)
    made.Parse(properties)
    return made


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("output")
    arguments.add_argument("--photons", type=int, default=1_000_000, help="in the caustic cache; 0: none")
    arguments.add_argument("--spp", type=int, default=16)
    arguments.add_argument("--depth", type=int, default=24)
    options = arguments.parse_args()
    pyluxcore.Init(lambda message: None)
    settings = {
        "renderengine.type": "PATHCPU",
        "renderengine.seed": 1,
        "sampler.type": "SOBOL",
        "film.width": scene.WIDTH,
        "film.height": scene.HEIGHT,
        "film.filter.type": "BLACKMANHARRIS",
        "film.filter.width": 1.5,
        "film.imagepipelines.0.0.type": "NOP",
        "film.outputs.0.type": "RGB",
        "film.outputs.0.filename": "unused.exr",
        "batch.haltspp": options.spp,
        "path.pathdepth.total": options.depth,
        "path.pathdepth.diffuse": options.depth,
        "path.pathdepth.glossy": options.depth,
        "path.pathdepth.specular": options.depth,
        "path.clamping.variance.maxvalue": 0.0,
        "path.russianroulette.depth": 1000,
    }
    if options.photons:
        settings |= {
            "path.photongi.sampler.type": "METROPOLIS",
            "path.photongi.photon.maxcount": 100_000_000,
            "path.photongi.photon.maxdepth": options.depth,
            "path.photongi.caustic.enabled": True,
            "path.photongi.caustic.maxsize": options.photons,
            "path.photongi.caustic.lookup.radius": 0.008,
            "path.photongi.caustic.lookup.normalangle": 10.0,
            "path.photongi.debug.type": "none",
        }
    properties = pyluxcore.Properties()
    for name, value in settings.items():
        properties.Set(pyluxcore.Property(name, value))
    session = pyluxcore.RenderSession(pyluxcore.RenderConfig(properties, world(options.depth)))
    before = time.process_time()
    session.Start()
    while not session.HasDone():
        session.UpdateStats()
        time.sleep(0.05)
    session.Stop()
    seconds = time.process_time() - before
    rgb = np.zeros((scene.HEIGHT, scene.WIDTH, 3), np.float32)
    session.GetFilm().GetOutputFloat(pyluxcore.FilmOutputType.RGB, rgb, 0)
    np.save(options.output, rgb[::-1].astype(float) @ scene.LUMINANCE)
    print(json.dumps({"version": f"LuxCore {pyluxcore.Version()}", "render_s": seconds}), flush=True)
    os._exit(0)  # Python's own end trips over LuxCore's threads


if __name__ == "__main__":
    main()
