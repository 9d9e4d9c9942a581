"""Compares cutlab with other renderers on table.toml; called by tools/peers/run.

Prints a row for each: processor seconds of both cores (whole process; of the peers also the rendering
alone, without imports, scenes and compilation), errors, means. The error is the RMS difference of blocks
of 4 x 4 pixels of luminance from the reference (reference.py), over the reference's mean, in the stone and
in its shadow, where no light falls straight from the lamp. `open` is the table that the whole lamp lights,
over the analytic direct light with the reference's caustic.

    compare.py --cutlab "quick: --spp 4 --photons 50000" --cutlab "long: --spp 64" --peers mitsuba
"""

import argparse
import json
import os
import resource
import shlex
import subprocess
import sys

import numpy as np

import reference
import scene

SETTINGS = [
    f"spp {spp}, {photons} photons, nearest {nearest}: --spp {spp} --photons {photons} --nearest {nearest}"
    for spp, photons, nearest in [
        (4, 20_000, 50),
        (4, 200_000, 50),
        (4, 200_000, 200),
        (9, 1_000_000, 100),
        (9, 1_000_000, 200),
        (9, 1_000_000, 500),
        (36, 4_000_000, 500),
    ]
]
PEERS = {
    "mitsuba": ("with_mitsuba.py", "16 wavelengths x 4 spp"),
    "luxcore": ("with_luxcore.py", "caustic cache of 1 M photons, 16 spp"),
    "povray": ("with_povray.py", "100 k photons, 7 samples of dispersion"),
}


def measured(command):
    """Runs it; processor seconds of all its threads, and its last line."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        raise RuntimeError((done.stderr.strip().splitlines() or [f"it ended with {done.returncode}"])[-1])
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return seconds, (done.stdout.strip().splitlines() or [""])[-1]


def cutlab(options):
    path = os.path.join(scene.OUT, "ours.exr")
    seconds, _ = measured([*scene.RENDER, "--force", "-o", path, *shlex.split(options)])
    return scene.luminance(scene.layers(path)), seconds


def peer(name, again):
    """Version, picture, seconds of the process and of its rendering; what an earlier run kept, if any."""
    program, _ = PEERS[name]
    picture, notes = (os.path.join(scene.OUT, name + end) for end in (".npy", ".json"))
    if again or not os.path.exists(notes):
        seconds, line = measured([sys.executable, os.path.join(scene.HERE, program), picture])
        with open(notes, "w") as file:
            json.dump(json.loads(line) | {"process_s": seconds}, file)
    with open(notes) as file:
        kept = json.load(file)
    return kept["version"], np.load(picture), kept["process_s"], kept["render_s"]


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    arguments.add_argument("--cutlab", action="append", metavar="NAME: OPTIONS", help="instead of the list here")
    arguments.add_argument("--peers", nargs="*", default=list(PEERS), choices=list(PEERS))
    arguments.add_argument("--kept", action="store_true", help="the peers' pictures and times of the last run")
    options = arguments.parse_args()
    store = reference.load()
    right = reference.picture(store)
    stone, shadow = reference.regions(store)
    direct, analytic = store["direct"].mean(axis=0), scene.analytic_table()
    bare = (store["facet"][0] == 0) & (direct > 0.99 * analytic)
    expected = analytic + store["caustic"].mean(axis=0)
    row = "| {:44} | {:>7} | {:>7} | {:>9} | {:>10} | {:>10} | {:>11} | {:>6} |".format
    head = ["", "CPU s", "render", "err stone", "err shadow", "mean stone", "mean shadow", "open"]
    print(row(*head), row("---", *["--:"] * 7), sep="\n", flush=True)

    def show(name, picture, process, render):
        numbers = [f"{process:.1f}", f"{render:.1f}"] if process else ["", ""]
        numbers += [f"{100 * scene.error(picture, right, mask):.1f} %" for mask in (stone, shadow)]
        numbers += [f"{picture[stone].mean():.4f}", f"{picture[shadow].mean():.5f}"]
        print(row(name, *numbers, f"{(picture / expected)[bare].mean():.4f}"), flush=True)

    for name in options.peers:
        try:
            version, picture, process, render = peer(name, not options.kept)
            show(f"{version}, {PEERS[name][1]}", picture, process, render)
        except (RuntimeError, OSError, ValueError) as problem:
            print(f"{name} did not run: {problem}")
    for entry in options.cutlab or SETTINGS:
        name, _, settings = entry.rpartition(": ")
        picture, seconds = cutlab(settings)
        show(f"cutlab, {name or settings}", picture, seconds, seconds)
    show("the reference", right, None, None)
    print(*(f"reference, {line}" for line in reference.describe(store)), sep="\n")


if __name__ == "__main__":
    main()
