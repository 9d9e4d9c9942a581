"""Checks the reference against pictures by Mitsuba's path tracer, which shares nothing with cutlab and has
no bias: several seeds of a crop around the stone and its shadow. Prints the means of both with their
standard errors, and the RMS difference of blocks beside what the two noises explain.
"""

import argparse
import os
import subprocess
import sys

import numpy as np

import reference
import scene


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--seeds", type=int, default=4)
    arguments.add_argument("--spp", type=int, default=16, help="of each of 16 wavelengths and seed")
    options = arguments.parse_args()
    store = reference.load()
    regions = reference.regions(store)
    rows, columns = np.nonzero(regions[0] | regions[1])
    left, top = columns.min() // 4 * 4, rows.min() // 4 * 4
    crop = [str(n) for n in (left, top, columns.max() // 4 * 4 + 4 - left, rows.max() // 4 * 4 + 4 - top)]
    pictures = []
    for seed in range(1, options.seeds + 1):
        path = os.path.join(scene.OUT, "check.npy")
        program = [sys.executable, os.path.join(scene.HERE, "with_mitsuba.py"), path]
        asked = ["--seed", str(seed), "--spp", str(options.spp), "--crop", *crop]
        subprocess.run([*program, *asked], check=True, stdout=subprocess.DEVNULL)
        pictures.append(np.load(path))
    pictures = np.array(pictures)
    np.save(os.path.join(scene.OUT, "check-all.npy"), pictures)
    ours = reference.picture(store)
    for name, mask in zip(("stone", "shadow"), regions):
        whole = scene.blocks(mask) == 1
        theirs = scene.blocks(pictures)[:, whole]
        right = scene.blocks(ours)[whole]
        means = theirs.mean(axis=1)
        noise = np.sqrt((theirs.var(axis=0, ddof=1) / len(theirs)).mean()) / right.mean()
        own = reference.own_error(store, mask)
        difference = np.sqrt(((theirs.mean(axis=0) - right) ** 2).mean()) / right.mean()
        print(
            f"{name}: mean of blocks {right.mean():.5f}, Mitsuba {means.mean():.5f} ± "
            f"{means.std(ddof=1) / np.sqrt(len(means)):.5f}; blocks differ by {100 * difference:.1f} %, "
            f"Mitsuba's noise {100 * noise:.1f} % and the reference's {100 * own:.1f} % explain "
            f"{100 * np.hypot(noise, own):.1f} %"
        )


if __name__ == "__main__":
    main()
