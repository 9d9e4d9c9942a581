"""What all tools here know of table.toml: its camera, light, stone, colour and regions."""

import os
import re
import subprocess

import numpy as np
import OpenEXR

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.join(HERE, "..", "..")
OUT = os.path.join(ROOT, "out", "peers")
CUTLAB = os.environ.get("CUTLAB", os.path.join(ROOT, "target", "release", "cutlab"))
TOML = os.path.join(HERE, "table.toml")
STONE = "round-brilliant:crown-angle=34,pavilion-angle=40.75,table=56,lower-half=77,girdle=3,size=1"
CULET = 0.001  # above the table
WIDTH, HEIGHT = 400, 300
AT, TO, FIELD = np.array([0, -3.4, 2.6]), np.array([0, 0, 0.2]), 28.0  # across the width, degrees
LIGHT_AT, LIGHT_SIDE, RADIANCE = np.array([0.9, 0.5, 3.0]), 1.0, 10.0  # faces down
TABLE_HALF, ALBEDO = 10.0, 0.5
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])  # of linear sRGB
BLOCK = 4  # pixels a side
RENDER = [CUTLAB, "render", "-q", "--scene", TOML]


def project(points):
    """Pixel coordinates of points on the table, and pixels per unit of its area there."""
    forward = (TO - AT) / np.linalg.norm(TO - AT)
    right = np.cross(forward, [0, 0, 1])
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    scale = WIDTH / 2 / np.tan(np.radians(FIELD / 2))
    ray = points - AT
    depth = ray @ forward
    x = WIDTH / 2 + scale * (ray @ right) / depth
    y = HEIGHT / 2 - scale * (ray @ up) / depth
    return x, y, scale**2 * -ray[:, 2] / depth**3


def mesh():
    """Vertices and faces (lists of vertex numbers) of the stone as it stands on the table."""
    path = os.path.join(OUT, "stone.obj")
    if not os.path.exists(path):
        subprocess.run([CUTLAB, "generate", "-q", "--force", STONE, "-o", path], check=True)
    lines = [line.split() for line in open(path)]
    vertices = np.array([[float(x) for x in line[1:4]] for line in lines if line[:1] == ["v"]])
    vertices[:, 2] += CULET - vertices[:, 2].min()
    faces = [[int(x.split("/")[0]) - 1 for x in line[1:]] for line in lines if line[:1] == ["f"]]
    return vertices, faces


def placed_mesh():
    """An OBJ of [`mesh`], for renderers that load one; its path."""
    path = os.path.join(OUT, "stone-placed.obj")
    vertices, faces = mesh()
    with open(path, "w") as file:
        file.writelines("v {:.9f} {:.9f} {:.9f}\n".format(*v) for v in vertices)
        file.writelines("f " + " ".join(str(i + 1) for i in face) + "\n" for face in faces)
    return path


def colour():
    """Wavelengths (nm), their luminance in linear sRGB under equal-energy white (mean weight, so that
    its mean over draws from `density` is 1), and `density`, the observer's sum by which cutlab draws
    them. The observer is read from cutlab's source: one table, CIE 018:2019."""
    source = open(os.path.join(ROOT, "src", "color", "cie.rs")).read()
    rows = re.findall(r"\[([-\d.e]+), ([-\d.e]+), ([-\d.e]+)\], // \d+", source)
    xyz = np.array(rows, float)
    nm = np.linspace(380, 730, len(xyz))
    fine = np.linspace(380, 730, 7001)
    xyz = np.stack([np.interp(fine, nm, xyz[:, i]) for i in range(3)], axis=1)
    density = xyz.sum(axis=1) / xyz.sum()
    white = xyz.sum(axis=0) / xyz[:, 1].sum()
    # Bradford to D65, as cutlab: of linear sRGB the luminance is the adapted Y
    bradford = np.array([[0.8951, -0.7502, 0.0389], [0.2664, 1.7135, -0.0685], [-0.1614, 0.0367, 1.0296]])
    d65 = np.array([0.3127, 0.3290, 0.3583]) / 0.3290
    adapt = np.linalg.inv(bradford) @ np.diag((bradford @ d65) / (bradford @ white)) @ bradford
    weight = (xyz @ adapt[1]) / xyz[:, 1].sum() / density
    return fine, weight, density


def band_luminance(bands=8):
    """Luminance of light constant over one of cutlab's bands, which share the density equally."""
    _, weight, density = colour()
    which = np.minimum((np.cumsum(density) - density / 2) * bands, bands - 1).astype(int)
    share = np.bincount(which, density)
    return np.bincount(which, weight * density) / share / bands


def layers(path):
    """All channels of an EXR by name."""
    with OpenEXR.File(path, separate_channels=True) as file:
        return {name: channel.pixels.astype(float) for name, channel in file.channels().items()}


def luminance(layer, prefix=""):
    return sum(w * layer[prefix + c] for w, c in zip(LUMINANCE, "RGB"))


def blocks(a):
    """Means of blocks of pixels; of masks, which blocks are whole."""
    a = np.asarray(a, float)
    shape = a.shape[:-2] + (HEIGHT // BLOCK, BLOCK, WIDTH // BLOCK, BLOCK)
    return a.reshape(shape).mean(axis=(-1, -3))


def error(picture, reference, mask):
    """RMS difference of the blocks that lie in a region, over the reference's mean there."""
    whole = blocks(mask) == 1
    right = blocks(reference)[whole]
    return np.sqrt(((blocks(picture)[whole] - right) ** 2).mean()) / right.mean()


def analytic_table():
    """Direct light of the table where nothing shades it, by Gauss quadrature over the light, without
    what the stone sends; in the middle of each pixel, for pixels that see the table."""
    x, y = np.meshgrid(np.arange(WIDTH) + 0.5, np.arange(HEIGHT) + 0.5)
    forward = (TO - AT) / np.linalg.norm(TO - AT)
    right = np.cross(forward, [0, 0, 1])
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    scale = WIDTH / 2 / np.tan(np.radians(FIELD / 2))
    ray = forward + ((x - WIDTH / 2)[..., None] * right - (y - HEIGHT / 2)[..., None] * up) / scale
    point = AT - ray * (AT[2] / ray[..., 2:])
    node, weight = np.polynomial.legendre.leggauss(8)
    sum_ = np.zeros((HEIGHT, WIDTH))
    for u, wu in zip(node, weight):
        for v, wv in zip(node, weight):
            to = LIGHT_AT + LIGHT_SIDE / 2 * np.array([u, v, 0]) - point
            sum_ += wu * wv / 4 * LIGHT_AT[2] ** 2 / (to**2).sum(axis=-1) ** 2
    return sum_ * LIGHT_SIDE**2 * RADIANCE * ALBEDO / np.pi
