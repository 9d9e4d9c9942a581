"""Makes the reference of table.toml, or makes it better: each call adds rounds to out/peers/reference.npz.

Each round has its own seed and is independent of all others.
- The table: cutlab's photons counted straight into the camera's pixels with its tent filter, as a light
  tracer does; no radiance estimate, so no bias.
- The stone, and the light straight from the lamp: cutlab's camera rays, many a pixel, which see the table
  through the stone by a large map with few neighbours.
The reference is the mean of the table's rounds and the mean of the stone's. Its own error is the standard
error of a block, from the spread of the rounds, RMS over the region's blocks, over the region's mean.
"""

import argparse
import json
import os
import subprocess
import tempfile
import time

import numpy as np

import scene

STORE = os.path.join(scene.OUT, "reference.npz")
PHOTON = np.dtype([("point", "<f4", 3), ("power", "<f4"), ("tint", "u1", 8), ("surface", "<u2"),
                   ("front", "u1"), ("normal", "i1", 3)])


def landed_photons(path):
    """The caustic photons of a map file; src/photons/map_file.rs has the layout."""
    data = open(path, "rb").read()
    length = int.from_bytes(data[12:16], "little")
    header = json.loads(data[16 : 16 + length])
    return np.frombuffer(data, PHOTON, header["caustic_stored"], 16 + length)


def outline():
    """Edges of the stone's image as half-planes: inside is a·x + b·y + c > 0 for all."""
    vertices, _ = scene.mesh()
    x, y, _ = scene.project(vertices)
    points = sorted(zip(x, y))

    def turn(a, b, c):
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])

    def chain(points):
        hull = []
        for p in points:
            while len(hull) > 1 and turn(hull[-2], hull[-1], p) <= 0:
                hull.pop()
            hull.append(p)
        return hull[:-1]

    hull = np.array(chain(points) + chain(points[::-1]))
    step = np.roll(hull, -1, axis=0) - hull
    normal = np.stack([-step[:, 1], step[:, 0]], axis=1)
    return normal, -(normal * hull).sum(axis=1)


def light_trace(landed):
    """Luminance of the table from photons that landed on it: each is seen by the four pixels whose
    tents hold it, unless the stone stands before it."""
    x, y, pixels_per_area = scene.project(landed["point"].astype(float))
    seen = (x > -1) & (x < scene.WIDTH + 1) & (y > -1) & (y < scene.HEIGHT + 1)
    landed, x, y, pixels_per_area = landed[seen], x[seen], y[seen], pixels_per_area[seen]
    normal, offset = outline()
    hidden = np.ones(len(x), bool)
    for (a, b), c in zip(normal, offset):
        hidden &= a * x + b * y + c > 0
    light = landed["power"] * (landed["tint"] @ scene.band_luminance()) / 255
    light = np.where(hidden, 0, light * pixels_per_area * scene.ALBEDO / np.pi)
    sums = np.zeros((scene.HEIGHT + 4) * (scene.WIDTH + 4))
    left, top = np.floor(x - 0.5), np.floor(y - 0.5)
    for dx in (0, 1):
        for dy in (0, 1):
            share = (1 - abs(x - 0.5 - left - dx)) * (1 - abs(y - 0.5 - top - dy))
            at = (top + dy + 2) * (scene.WIDTH + 4) + left + dx + 2
            sums += np.bincount(at.astype(int), light * share, len(sums))
    whole = sums.reshape(scene.HEIGHT + 4, scene.WIDTH + 4)
    return whole[2 : 2 + scene.HEIGHT, 2 : 2 + scene.WIDTH]


def cutlab(folder, seed, photons, *options):
    """Runs cutlab; its photons and the layers of its picture."""
    picture, map_path = os.path.join(folder, "round.exr"), os.path.join(folder, "photons.map")
    command = [*scene.RENDER, "--force", "-o", picture, "--photon-map", map_path, "--seed", str(seed)]
    subprocess.run([*command, "--photons", str(photons), *options], check=True)
    landed = landed_photons(map_path)
    os.remove(map_path)
    return landed, scene.layers(picture)


def table_round(folder, seed, photons):
    landed, _ = cutlab(folder, seed, photons, "--width", "4", "--height", "3", "--spp", "1", "--nearest", "100000")
    return {"caustic": light_trace(landed)}


def stone_round(folder, seed, photons, nearest, spp):
    _, layer = cutlab(folder, seed, photons, "--nearest", str(nearest), "--spp", str(spp))
    return {name: scene.luminance(layer, f"{name}.") for name in ("direct", "stone")} | {
        "estimated": scene.luminance(layer, "caustic."),
        "facet": layer["facet.id"],
    }


def load():
    """The rounds so far: light-traced `caustic`; `direct`, `stone`, `estimated` caustic and `facet`.
    None if there are not two of each yet."""
    if not os.path.exists(STORE):
        return {}
    with np.load(STORE) as file:
        return dict(file)


def save(store, found):
    """Adds a round to the store and puts it on disk whole."""
    for name, image in found.items():
        new = image[None].astype(np.float32)
        store[name] = np.concatenate([store[name], new]) if name in store else new
    np.savez(STORE + ".new.npz", **store)
    os.replace(STORE + ".new.npz", STORE)


def regions(store):
    """The stone, and the shadow: the table where no direct light falls in any round."""
    stone = store["facet"][0] > 0
    return stone, ~stone & (store["direct"].max(axis=0) == 0)


def picture(store):
    """The reference."""
    return sum(store[name].mean(axis=0, dtype=float) for name in ("caustic", "direct", "stone"))


def own_error(store, mask):
    """RMS standard error of the blocks of a region, over its mean."""
    whole = scene.blocks(mask) == 1

    def variance(rounds):
        b = scene.blocks(rounds)[:, whole]
        return b.var(axis=0, ddof=1) / len(b)

    total = variance(store["caustic"]) + variance(store["direct"] + store["stone"])
    return np.sqrt(total.mean()) / scene.blocks(picture(store))[whole].mean()


def describe(store):
    """Two lines on the reference and its own error."""
    rounds = f"{len(store['caustic'])} rounds of the table, {len(store['stone'])} of the stone"
    return [
        f"{name}: {rounds}, {int((scene.blocks(mask) == 1).sum())} blocks, mean "
        f"{picture(store)[mask].mean():.5f}, own error {100 * own_error(store, mask):.2f} %"
        for name, mask in zip(("stone", "shadow"), regions(store))
    ]


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--table-rounds", type=int, default=4)
    arguments.add_argument("--stone-rounds", type=int, default=2)
    arguments.add_argument("--until", default="99", help="start no round after this time of day, HH:MM UTC")
    arguments.add_argument("--photons", type=int, default=4_000_000, help="in a round")
    arguments.add_argument("--nearest", type=int, default=50, help="for what the stone's rounds see")
    arguments.add_argument("--spp", type=int, default=64, help="of the stone's rounds")
    options = arguments.parse_args()
    os.makedirs(scene.OUT, exist_ok=True)
    store = load()

    def add(count, name, seed, make, *settings):
        for _ in range(count):
            if time.strftime("%H:%M", time.gmtime()) >= options.until:
                return
            with tempfile.TemporaryDirectory(dir=scene.OUT) as folder:
                save(store, make(folder, seed + len(store.get(name, ())), *settings))
            if min(len(store.get(n, ())) for n in ("caustic", "stone")) > 1:
                print(*describe(store), sep="\n", flush=True)

    add(options.table_rounds, "caustic", 1000, table_round, options.photons)
    add(options.stone_rounds, "stone", 2000, stone_round, options.photons, options.nearest, options.spp)


if __name__ == "__main__":
    main()
