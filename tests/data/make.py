"""Writes the files in this folder with NumPy and Pillow (see README.md).

    python make.py
"""

from pathlib import Path

import numpy as np
from PIL import Image, PngImagePlugin

here = Path(__file__).parent

# 3 rows of 4: no two values alike, and no symmetry.
ramp = np.arange(12).reshape(3, 4) * 7 + 3
holes = ramp.astype(float) / 8 - 2
holes[1, 2] = np.nan

for name in ["u1", "i1", "u2", "i2", "u4", "i4", "u8", "i8", "f2", "f4", "f8"]:
    signed = ramp - 50 if name[0] == "i" else ramp
    values = holes if name[0] == "f" else signed
    for order in "<>":
        if name[1] == "1" and order == ">":
            continue
        suffix = "be" if order == ">" else "le"
        np.save(here / f"{name}-{suffix}.npy", values.astype(order + name))
np.save(here / "bool.npy", ramp % 3 == 0)
np.save(here / "fortran.npy", np.asfortranarray(holes))
np.save(here / "third-axis.npy", holes[:, :, None])
np.save(here / "infinite.npy", np.array([[1.0, np.inf], [2.0, 3.0]]))
np.save(here / "vector.npy", np.arange(12.0))
np.save(here / "cube.npy", np.zeros((2, 3, 4)))
np.save(here / "empty.npy", np.zeros((0, 4)))
np.save(here / "complex.npy", np.zeros((2, 2), dtype="<c16"))
np.save(here / "text.npy", np.array([["a", "bc"], ["d", "e"]]))
np.save(here / "record.npy", np.zeros((2, 2), dtype=[("x", "<f8"), ("y", "<i4", (2, 3))]))
np.save(here / "object.npy", np.array([[None, 1], [2, 3]], dtype=object), allow_pickle=True)
with open(here / "version2.npy", "wb") as f:
    np.lib.format.write_array(f, holes, version=(2, 0))

grey8 = (ramp * 2).astype(np.uint8)
grey16 = (ramp * 700).astype(np.uint16)
Image.fromarray(grey8).save(here / "grey8.png")
Image.fromarray(grey16).save(here / "grey16.png")
Image.fromarray(grey8).save(here / "transparent-level.png", transparency=int(grey8[1, 2]))
Image.fromarray(ramp % 3 == 0).save(here / "grey1.png", bits=1)
alpha = np.full_like(grey8, 255)
alpha[0, 1], alpha[2, 3] = 0, 90
Image.merge("LA", [Image.fromarray(grey8), Image.fromarray(alpha)]).save(here / "grey8-alpha.png")
rgb = Image.merge("RGB", [Image.fromarray(grey8)] * 3)
rgb.save(here / "rgb-grey.png")
rgb.convert("P", palette=Image.Palette.ADAPTIVE).save(here / "palette-grey.png")
rgba = rgb.copy()
rgba.putalpha(Image.fromarray(alpha))
rgba.save(here / "rgba-grey.png")
colour = np.stack([grey8, grey8, grey8], axis=2)
colour[2, 1] = [200, 10, 10]
Image.fromarray(colour).save(here / "rgb-colour.png")

# Text as in our own files, but written by another program, in another order, after the pixels.
text = PngImagePlugin.PngInfo()
for key, value in [
    ("pixelSize", "0.25"),
    ("noData", "2100"),
    ("heightOffset", "-1e2"),
    ("heightScale", "0.5"),
]:
    text.add(b"tEXt", f"developable:{key}\0{value}".encode("latin-1"), after_idat=True)
Image.fromarray(grey16).save(here / "recorded.png", pnginfo=text)
bad = PngImagePlugin.PngInfo()
bad.add_text("developable:heightScale", "nan")
Image.fromarray(grey16).save(here / "recorded-badly.png", pnginfo=bad)
