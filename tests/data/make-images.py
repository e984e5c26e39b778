"""Writes the height and depth images in this folder: TIFF, EXR, PFM, NPZ, JPEG and WebP (see README.md).

    python make-images.py
"""

import subprocess
from pathlib import Path

import numpy as np
import OpenEXR
import rasterio
from rasterio.transform import from_origin
import tifffile
from PIL import Image, ImageOps
from PIL.Image import Transpose

here = Path(__file__).parent

# As in make.py: 3 rows of 4, no two values alike, and no symmetry.
ramp = np.arange(12).reshape(3, 4) * 7 + 3
holes = ramp.astype(float) / 8 - 2
holes[1, 2] = np.nan
grey8 = (ramp * 2).astype(np.uint8)


def tiff(name, values, **options):
    tifffile.imwrite(here / f"{name}.tif", values, **{"software": False, "metadata": None, **options})


for name in ["u1", "i1", "u2", "i2", "u4", "i4", "u8", "i8", "f2", "f4", "f8"]:
    signed = ramp - 50 if name[0] == "i" else ramp
    values = holes if name[0] == "f" else signed
    tiff(name, values.astype(f"<{name}"))
tiff("f4-be", holes.astype(">f4"), byteorder=">")
tiff("big", holes.astype("f4"), bigtiff=True)
tiff("strips", holes.astype("f4"), rowsperstrip=1)
tiff("tiles", holes.astype("f4"), tile=(16, 16), compression="zlib")
tiff("deflate", holes.astype("f4"), compression="zlib", predictor=True)


def zstd(values):
    return subprocess.run(["zstd", "-qc", "-19"], input=values.tobytes(), stdout=subprocess.PIPE, check=True).stdout


# Strips of two rows and of one, as zstd itself compresses them.
signed = (ramp - 50).astype("<i2")
steps = np.diff(signed, axis=1, prepend=np.zeros((3, 1), "<i2"))
tiff("zstd", (zstd(rows) for rows in (steps[:2], steps[2:])), shape=(3, 4), dtype="<i2", rowsperstrip=2,
     compression="zstd", predictor=2)
tiff("zstd-be", (zstd(rows.astype(">f4")) for rows in (holes[:2], holes[2:])), shape=(3, 4), dtype=">f4", rowsperstrip=2,
     compression="zstd", byteorder=">", bigtiff=True)
tiff("lzw", (ramp * 700).astype("u2"), compression="lzw", predictor=True)
tiff("packbits", grey8, compression="packbits")
tiff("rgb-grey", np.stack([grey8] * 3, axis=2), photometric="rgb")
colour = np.stack([grey8] * 3, axis=2)
colour[2, 1] = [200, 10, 10]
tiff("rgb-colour", colour, photometric="rgb")
alpha = np.full_like(grey8, 255)
alpha[0, 1], alpha[2, 3] = 0, 90
tiff("rgba-grey", np.stack([grey8] * 3 + [alpha], axis=2), photometric="rgb", extrasamples=["unassalpha"])
tiff("grey-alpha", np.stack([grey8, alpha], axis=2), photometric="minisblack", extrasamples=["unassalpha"])
tiff("pages", np.stack([ramp, ramp + 1]).astype("f4"), photometric="minisblack")
tiff("complex", ramp.astype("c8"))
tiff("white-is-zero", grey8, photometric="miniswhite")

inch, cm = 2, 3
tiff("dpi", holes.astype("f4"), resolution=(254, 254), resolutionunit=inch)
tiff("per-cm", holes.astype("f4"), resolution=(50, 50), resolutionunit=cm)
tiff("imagej", holes.astype("f4"), imagej=True, resolution=(4, 4), metadata={"unit": "mm"})
tiff("unequal", holes.astype("f4"), resolution=(100, 200), resolutionunit=inch)

ascii_, double, short = 2, 12, 3
no_data = (42113, ascii_, 0, "-9999", True)
scale = (33550, double, 3, (0.5, 0.5, 0.0), True)
missing = np.where(np.isnan(holes), -9999, holes).astype("f4")
# Projected, linear unit metre; geographic, in degrees.
metres = (34735, short, 12, (1, 1, 0, 2, 1024, 0, 1, 1, 3076, 0, 1, 9001), True)
degrees = (34735, short, 8, (1, 1, 0, 1, 1024, 0, 1, 2), True)
tiff("no-data", missing, extratags=[no_data])
tiff("geo-metres", missing, extratags=[scale, metres, no_data])
tiff("geo", holes.astype("f4"), extratags=[scale])
tiff("geo-degrees", holes.astype("f4"), extratags=[scale, degrees])
tiff("geo-unequal", holes.astype("f4"), extratags=[(33550, double, 3, (0.5, 0.25, 0.0), True)])

# Each is stored turned so that the tag turns it back.
turned = {
    2: ramp[:, ::-1],
    3: ramp[::-1, ::-1],
    4: ramp[::-1],
    5: ramp.T,
    6: np.rot90(ramp),
    7: ramp[::-1, ::-1].T,
    8: np.rot90(ramp, -1),
}
for code, stored in turned.items():
    tiff(f"orientation{code}", np.ascontiguousarray(stored).astype("f4"), extratags=[(274, short, 1, code, True)])


def exr(name, channels, compression=OpenEXR.ZIP_COMPRESSION, **header):
    header = {"compression": compression, "type": OpenEXR.scanlineimage, **header}
    with OpenEXR.File(header, {k: np.ascontiguousarray(v) for k, v in channels.items()}) as file:
        file.write(str(here / f"{name}.exr"))


f4, f2, u4 = holes.astype("f4"), holes.astype("f2"), ramp.astype("u4")
for name, method in [
    ("none", OpenEXR.NO_COMPRESSION),
    ("rle", OpenEXR.RLE_COMPRESSION),
    ("zips", OpenEXR.ZIPS_COMPRESSION),
    ("zip", OpenEXR.ZIP_COMPRESSION),
    ("piz", OpenEXR.PIZ_COMPRESSION),
]:
    exr(name, {"Z": f4}, method)
exr("half", {"Z": f2})
exr("uint", {"Z": u4})
exr("luminance", {"Y": f4})
exr("only", {"height": f4})
exr("among", {"R": f2, "G": f2 * 2, "B": f2, "Z": f4})
exr("rgb-grey", {"R": f4, "G": f4, "B": f4})
exr("rgb-colour", {"R": f4, "G": f4 * 2, "B": f4})
exr("neither", {"u": f4, "v": f4})
exr("alpha", {"Z": ramp.astype("f4"), "A": (alpha / 255).astype("f4")})


def pfm(name, values, order, colour=False):
    # The format's rows go from the bottom to the top.
    head = f"{'PF' if colour else 'Pf'}\n4 3\n{-1.0 if order == '<' else 1.0}\n"
    (here / name).write_bytes(head.encode() + values[::-1].astype(f"{order}f4").tobytes())


pfm("le.pfm", holes, "<")
pfm("be.pfm", holes, ">")
pfm("grey.pfm", np.stack([holes] * 3, axis=2), "<", colour=True)
pfm("colour.pfm", np.stack([ramp, ramp, ramp + 1], axis=2), "<", colour=True)

np.savez(here / "one.npz", depth=f4)
np.savez_compressed(here / "deflated.npz", depth=holes)
np.savez(here / "several.npz", depth=holes, confidence=ramp.astype("u1"), name=np.array(["a"]))
np.savez(here / "none.npz")

steps = np.kron(ramp[:2, :2] * 4, np.ones((8, 8), int)).astype(np.uint8)
Image.fromarray(steps).save(here / "grey.jpg", quality=100)
Image.fromarray(steps).save(here / "progressive.jpg", quality=100, progressive=True)
Image.merge("RGB", [Image.fromarray(steps)] * 3).save(here / "rgb-grey.jpg", quality=100, subsampling=0)
Image.merge("RGB", [Image.fromarray(255 - steps)] + [Image.fromarray(steps)] * 2).save(here / "colour.jpg")

# Each is seen the same way, as Pillow does, too.
blocks = Image.fromarray(np.kron(ramp[:2, :3] * 4, np.ones((8, 8), int)).astype(np.uint8))
turns = [Transpose.FLIP_LEFT_RIGHT, Transpose.ROTATE_180, Transpose.FLIP_TOP_BOTTOM, Transpose.TRANSPOSE,
         Transpose.ROTATE_90, Transpose.TRANSVERSE, Transpose.ROTATE_270]
for orientation, turn in enumerate(turns, 2):
    exif = Image.Exif()
    exif[0x112] = orientation
    blocks.transpose(turn).save(here / f"exif{orientation}.jpg", quality=100, exif=exif)
    seen = ImageOps.exif_transpose(Image.open(here / f"exif{orientation}.jpg"))
    assert np.abs(np.asarray(seen, int) - np.asarray(blocks, int)).max() <= 1

rgb = Image.merge("RGB", [Image.fromarray(grey8)] * 3)
rgb.save(here / "grey.webp", lossless=True)
rgba = rgb.copy()
rgba.putalpha(Image.fromarray(alpha))
rgba.save(here / "alpha.webp", lossless=True, exact=True)
Image.fromarray(colour).save(here / "colour.webp", lossless=True)
Image.merge("RGB", [Image.fromarray(steps)] * 3).save(here / "lossy.webp", quality=100)

# As GDAL writes them: tiles of LZW with prediction, and a mask of no data.
place = dict(driver="GTiff", count=1, crs="EPSG:32632", transform=from_origin(4e5, 5e6, 0.5, 0.5))
tiles = dict(width=20, height=20, tiled=True, blockxsize=16, blockysize=16, compress="lzw", predictor=2)
with rasterio.open(here / "gdal-lzw.tif", "w", dtype="uint8", **place, **tiles) as file:
    file.write(((np.arange(400) * 7 + 3) % 251).astype("u1").reshape(20, 20), 1)
masked = dict(width=4, height=3, dtype="float32")
with rasterio.Env(GDAL_TIFF_INTERNAL_MASK=True), rasterio.open(here / "gdal-mask.tif", "w", **place, **masked) as file:
    file.write(ramp.astype("f4"), 1)
    file.write_mask(np.arange(12).reshape(3, 4) != 1)
