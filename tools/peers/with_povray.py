"""POV-Ray 3.7 on table.toml: photons through the stone, dispersion in seven samples; called by compare.py.
Writes luminance as .npy and prints its processor seconds as JSON.

POV-Ray has no light from table to stone to table, so its shadow is too dark. Its area light has no cosine
of its own; a spotlight of tightness 1 over the half-space gives it one.
"""

import argparse
import json
import os
import resource
import subprocess
import tempfile

import numpy as np
import OpenEXR

import scene

N_RED, N_VIOLET = 2.40728, 2.46205  # B and h


def vector(v):
    return "<{:.9f},{:.9f},{:.9f}>".format(*v)


def text(photons, depth):
    vertices, faces = scene.mesh()
    triangles = [(f[0], f[k], f[k + 1]) for f in faces for k in range(1, len(f) - 1)]
    forward = (scene.TO - scene.AT) / np.linalg.norm(scene.TO - scene.AT)
    right = np.cross(forward, [0, 0, 1])
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    width = 2 * np.tan(np.radians(scene.FIELD / 2))
    # a lambertian surface of POV-Ray shows pigment × light × cosine; irradiance/π under the lamp is
    # radiance × area / distance² / π there, and fade_distance d, power 2 means 2/(1 + (r/d)²)
    far = 0.01
    strength = scene.RADIANCE * scene.LIGHT_SIDE**2 / np.pi / (2 * far**2)
    mesh = "\n".join(f"triangle {{ {', '.join(vector(vertices[i]) for i in t)} }}" for t in triangles)
    half, lamp = scene.TABLE_HALF, scene.LIGHT_SIDE / 2
    return f"""#version 3.7;
global_settings {{ assumed_gamma 1 max_trace_level {depth}
  photons {{ count {photons} max_trace_level {depth} autostop 0 }} }}
camera {{ perspective location {vector(scene.AT)} direction {vector(forward)}
  right {vector(right * width)} up {vector(up * width * scene.HEIGHT / scene.WIDTH)} }}
light_source {{ {vector(scene.LIGHT_AT)} color rgb {strength:.3f}
  area_light x*{scene.LIGHT_SIDE}, y*{scene.LIGHT_SIDE}, 9, 9 jitter
  fade_distance {far} fade_power 2
  spotlight point_at {vector(scene.LIGHT_AT * [1, 1, 0])} radius 89.9 falloff 90 tightness 1
  looks_like {{ box {{ <{-lamp},{-lamp},0>, <{lamp},{lamp},0.001> pigment {{ rgb 1 }} finish {{ ambient 0 diffuse 0 emission {scene.RADIANCE} }} }} }}
  photons {{ reflection on refraction on area_light }} }}
polygon {{ 5, <{-half},{-half},0>, <{half},{-half},0>, <{half},{half},0>, <{-half},{half},0>, <{-half},{-half},0>
  pigment {{ rgb {scene.ALBEDO} }} finish {{ ambient 0 diffuse 1 }} photons {{ collect on }} }}
mesh {{ {mesh} inside_vector z
  pigment {{ rgbt 1 }} finish {{ ambient 0 diffuse 0 reflection {{ 0, 1 fresnel on }} conserve_energy }}
  interior {{ ior {(N_RED + N_VIOLET) / 2:.5f} dispersion {N_VIOLET / N_RED:.5f} dispersion_samples 7 }}
  photons {{ target reflection on refraction on collect off }} }}
"""


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("output")
    arguments.add_argument("--photons", type=int, default=100_000)
    arguments.add_argument("--depth", type=int, default=24)
    options = arguments.parse_args()
    with tempfile.TemporaryDirectory(dir=scene.OUT) as folder:
        source, picture = os.path.join(folder, "table.pov"), os.path.join(folder, "table.exr")
        open(source, "w").write(text(options.photons, options.depth))
        size = [f"+W{scene.WIDTH}", f"+H{scene.HEIGHT}"]
        quality = ["-A", "-D", "+FE", "+WT2", "-GA"]
        command = ["povray", f"+I{source}", f"+O{picture}", *size, *quality]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode:
            raise SystemExit(done.stderr[-2000:])
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        with OpenEXR.File(picture, separate_channels=True) as file:
            channels = {n: c.pixels.astype(float) for n, c in file.channels().items()}
    np.save(options.output, sum(w * channels[c] for w, c in zip(scene.LUMINANCE, "RGB")))
    print(json.dumps({"version": "POV-Ray 3.7", "render_s": used.ru_utime + used.ru_stime}))


if __name__ == "__main__":
    main()
