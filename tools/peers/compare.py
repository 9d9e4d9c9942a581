"""Compares cutlab with Mitsuba on tools/peers/table.toml; run by tools/peers/run.

Errors are the RMS difference of 4x4-pixel blocks of luminance from a reference over the reference's
mean, in the stone and in the shadow with its caustic (no direct light). The reference is the mean of
two long cutlab renderings with different seeds; half the RMS of their difference is its own error.
"""

import argparse
import os
import resource
import subprocess

import mitsuba as mi
import numpy as np

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
OUT = os.path.join(ROOT, "out", "peers")
CUTLAB = os.path.join(ROOT, "target", "release", "cutlab")
SCENE = os.path.join(ROOT, "tools", "peers", "table.toml")
STONE = "round-brilliant:crown-angle=34,pavilion-angle=40.75,table=56,lower-half=77,girdle=3,size=1"
WIDTH, HEIGHT = 400, 300
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


def cpu(kind=resource.RUSAGE_SELF):
    use = resource.getrusage(kind)
    return use.ru_utime + use.ru_stime


def layers(path):
    bitmap = mi.Bitmap(path)
    names = [f.name for f in bitmap.struct_()]
    data = np.array(bitmap)
    return {n: data[..., i].astype(float) for i, n in enumerate(names)}


def rgb(layer, prefix=""):
    return np.stack([layer[prefix + c] for c in "RGB"], axis=-1)


def cutlab(name, *options):
    path = os.path.join(OUT, name + ".exr")
    before = cpu(resource.RUSAGE_CHILDREN)
    subprocess.run([CUTLAB, "render", "-q", "--scene", SCENE, "-o", path, *options], check=True)
    return layers(path), cpu(resource.RUSAGE_CHILDREN) - before


def diamond(um):
    """C/Peter of refractiveindex.info, as src/optics/materials/diamond.rs."""
    return np.sqrt(1 + 0.3306 * um**2 / (um**2 - 0.1750**2) + 4.3356 * um**2 / (um**2 - 0.1060**2))


def mitsuba(spp, wavelengths):
    mi.set_variant("llvm_ad_mono")
    obj = os.path.join(OUT, "stone.obj")
    subprocess.run([CUTLAB, "generate", "-q", STONE, "-o", obj], check=True)
    low = min(float(line.split()[3]) for line in open(obj) if line.startswith("v "))
    up = mi.ScalarTransform4f().translate([0, 0, 0.001 - low])
    down = mi.ScalarTransform4f().look_at(origin=[0.9, 0.5, 3], target=[0.9, 0.5, 0], up=[0, 1, 0])
    total = np.zeros((HEIGHT, WIDTH))
    seconds = 0.0
    # equal shares of luminance: the eye's weight is in the choice of wavelengths
    nm = np.linspace(380, 730, 351)
    eye = np.exp(-0.5 * ((nm - 558) / 46.0) ** 2)
    share = np.cumsum(eye) / eye.sum()
    for k in range(wavelengths):
        n = float(diamond(np.interp((k + 0.5) / wavelengths, share, nm) / 1000))
        scene = mi.load_dict({
            "type": "scene",
            "integrator": {"type": "path", "max_depth": 24, "rr_depth": 100},
            "sensor": {
                "type": "perspective", "fov": 28, "fov_axis": "x",
                "to_world": mi.ScalarTransform4f().look_at([0, -3.4, 2.6], [0, 0, 0.2], [0, 0, 1]),
                "film": {"type": "hdrfilm", "width": WIDTH, "height": HEIGHT, "pixel_format": "luminance",
                         "rfilter": {"type": "tent"}},
                "sampler": {"type": "independent", "sample_count": spp, "seed": k},
            },
            "stone": {"type": "obj", "filename": obj, "face_normals": True, "to_world": up,
                      "bsdf": {"type": "dielectric", "int_ior": n, "ext_ior": 1.0}},
            "table": {"type": "rectangle", "to_world": mi.ScalarTransform4f().scale(10),
                      "bsdf": {"type": "diffuse", "reflectance": {"type": "uniform", "value": 0.5}}},
            "light": {"type": "rectangle", "to_world": down @ mi.ScalarTransform4f().scale(0.5),
                      "emitter": {"type": "area", "radiance": {"type": "uniform", "value": 10.0}}},
        })
        if k == 0:
            mi.render(scene, spp=1)  # compiles
        before = cpu()
        total += np.array(mi.render(scene, spp=spp, seed=k)).reshape(HEIGHT, WIDTH) / wavelengths
        seconds += cpu() - before
    return total, seconds


def error(picture, reference, mask):
    def blocks(a):
        return a.reshape(HEIGHT // 4, 4, WIDTH // 4, 4).mean(axis=(1, 3))

    whole = blocks(mask.astype(float)) == 1
    difference = (blocks(picture) - blocks(reference))[whole]
    return np.sqrt((difference**2).mean()) / blocks(reference)[whole].mean()


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--reference-spp", default="196")
    arguments.add_argument("--reference-photons", default="4000000")
    arguments.add_argument("--spp", nargs="*", default=["4", "16"])
    arguments.add_argument("--photons", nargs="*", default=["100000", "400000"])
    options = arguments.parse_args()
    os.makedirs(OUT, exist_ok=True)
    mi.set_variant("scalar_rgb")
    long = ["--spp", options.reference_spp, "--photons", options.reference_photons, "--nearest", "300"]
    halves = [cutlab(f"reference-{seed}", *long, "--seed", str(seed))[0] for seed in (101, 102)]
    lit = [rgb(h) @ LUMINANCE for h in halves]
    reference = (lit[0] + lit[1]) / 2
    stone = halves[0]["facet.id"] > 0
    shadow = (halves[0]["facet.id"] == 0) & (halves[0]["direct.G"] == 0) & np.isfinite(halves[0]["Z"])
    row = "{:34} {:>9} {:>12} {:>14}".format
    print(row("", "CPU s", "err in stone", "err in caustic"))
    own = [error(lit[0], lit[1], m) / 2 for m in (stone, shadow)]
    print(row("reference, its own error", "", *(f"{100 * e:.1f} %" for e in own)))
    for spp in options.spp:
        for photons in options.photons:
            layer, seconds = cutlab("ours", "--spp", spp, "--photons", photons)
            errors = [error(rgb(layer) @ LUMINANCE, reference, m) for m in (stone, shadow)]
            name = f"cutlab, {spp} spp, {photons} photons"
            print(row(name, f"{seconds:.1f}", *(f"{100 * e:.1f} %" for e in errors)), flush=True)
    picture, seconds = mitsuba(4, 16)
    errors = [error(picture, reference, m) for m in (stone, shadow)]
    print(row("Mitsuba, 16 wavelengths x 4 spp", f"{seconds:.1f}", *(f"{100 * e:.1f} %" for e in errors)))
    for name, mask in (("stone", stone), ("shadow with caustic", shadow)):
        print(f"mean in the {name}: cutlab {reference[mask].mean():.4f}, Mitsuba {picture[mask].mean():.4f}")


if __name__ == "__main__":
    main()
