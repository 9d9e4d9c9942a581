"""Mitsuba 3 on table.toml; called by compare.py. Dispersion is emulated: one monochrome picture a
wavelength, each with its index and its weight in luminance. Prints its processor seconds of rendering
(without import, scene and first compilation) as JSON and writes luminance as .npy.

Needs an LLVM of 17 or later at run time: with 14 and 15 drjit 1.5 aborts on this machine (no code for
`fminimum`). DRJIT_LIBLLVM_PATH names another; apt-get install libllvm19.
"""

import argparse
import glob
import json
import os
import time

if "DRJIT_LIBLLVM_PATH" not in os.environ:
    found = sorted(glob.glob("/usr/lib/*/libLLVM*.so.1[7-9]*") + glob.glob("/usr/lib/*/libLLVM*.so.2*"))
    if found:
        os.environ["DRJIT_LIBLLVM_PATH"] = found[-1]

import mitsuba as mi
import numpy as np

import scene


def index(nm):
    """C/Peter of refractiveindex.info, as cutlab's diamond."""
    um2 = (nm / 1000) ** 2
    return np.sqrt(1 + 0.3306 * um2 / (um2 - 0.1750**2) + 4.3356 * um2 / (um2 - 0.1060**2))


def wavelengths(count, seed):
    """One of each of equal shares of luminance (where it is positive), nm: the middle for seed 0."""
    nm, weight, density = scene.colour()
    share = np.cumsum(np.maximum(weight * density, 0))
    place = (0.5 + seed * 0.618034) % 1
    return np.interp((np.arange(count) + place) / count * share[-1], share, nm)


def world(nm, depth, crop):
    t = mi.ScalarTransform4f
    film = {
        "type": "hdrfilm", "width": scene.WIDTH, "height": scene.HEIGHT, "pixel_format": "luminance",
        "rfilter": {"type": "tent"},
    }
    if crop:
        film |= dict(zip(("crop_offset_x", "crop_offset_y", "crop_width", "crop_height"), crop))
    facing_down = t().look_at(origin=scene.LIGHT_AT, target=scene.LIGHT_AT - [0, 0, 1], up=[0, 1, 0])
    return mi.load_dict({
        "type": "scene",
        "integrator": {"type": "path", "max_depth": depth, "rr_depth": 1000},
        "sensor": {
            "type": "perspective", "fov": scene.FIELD, "fov_axis": "x",
            "to_world": t().look_at(scene.AT.tolist(), scene.TO.tolist(), [0, 0, 1]), "film": film,
        },
        "stone": {
            "type": "obj", "filename": scene.placed_mesh(), "face_normals": True,
            "bsdf": {"type": "dielectric", "int_ior": float(index(nm)), "ext_ior": 1.0},
        },
        "table": {
            "type": "rectangle", "to_world": t().scale(scene.TABLE_HALF),
            "bsdf": {"type": "diffuse", "reflectance": {"type": "uniform", "value": scene.ALBEDO}},
        },
        "light": {
            "type": "rectangle", "to_world": facing_down @ t().scale(scene.LIGHT_SIDE / 2),
            "emitter": {"type": "area", "radiance": {"type": "uniform", "value": scene.RADIANCE}},
        },
    })


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("output")
    arguments.add_argument("--variant", default="llvm_ad_mono")
    arguments.add_argument("--wavelengths", type=int, default=16)
    arguments.add_argument("--spp", type=int, default=4, help="camera rays a pixel and wavelength")
    arguments.add_argument("--depth", type=int, default=24)
    arguments.add_argument("--seed", type=int, default=0)
    arguments.add_argument("--crop", type=int, nargs=4, help="left, top, width, height in pixels")
    options = arguments.parse_args()
    mi.set_variant(options.variant)
    left, top, width, height = options.crop or (0, 0, scene.WIDTH, scene.HEIGHT)
    total, seconds = np.zeros((height, width)), 0.0
    for k, nm in enumerate(wavelengths(options.wavelengths, options.seed)):
        picture = world(nm, options.depth, options.crop)
        if k == 0:
            mi.render(picture, spp=options.spp)  # compiles
        before = time.process_time()
        seed = options.seed * options.wavelengths + k
        image = np.array(mi.render(picture, spp=options.spp, seed=seed)).reshape(height, width)
        seconds += time.process_time() - before
        total += image / options.wavelengths
    whole = np.full((scene.HEIGHT, scene.WIDTH), np.nan)
    whole[top : top + height, left : left + width] = total
    np.save(options.output, whole)
    print(json.dumps({"version": f"Mitsuba {mi.__version__}", "render_s": seconds}))


if __name__ == "__main__":
    main()
