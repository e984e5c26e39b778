"""Writes small photos as other programs write them: `pip install pillow`, `python make-photos.py` in this folder."""
from PIL import Image

WIDTH, HEIGHT = 24, 16
RED, GREEN, BLUE, WHITE = (220, 30, 30), (30, 200, 40), (40, 50, 210), (250, 250, 250)

photo = Image.new("RGB", (WIDTH, HEIGHT), BLUE)
photo.paste(RED, (0, 0, 8, HEIGHT))
photo.paste(GREEN, (8, 0, 16, HEIGHT))
photo.paste(WHITE, (16, 0, WIDTH, 8))
photo.save("photo.bmp")
photo.quantize(8).save("photo.gif")
photo.save("photo-lzw.tif", compression="tiff_lzw")
photo.convert("CMYK").save("photo-cmyk.jpg", quality=95)
Image.new("1", (WIDTH, HEIGHT), 1).save("photo-bits.tif")

exif = Image.Exif()
exif[0x0112] = 6
exif.get_ifd(0x8769)[0xA405] = 26
photo.save("photo-exif6.png", exif=exif)
photo.save("photo-exif6.webp", exif=exif, lossless=True)

large = Image.new("1", (8192, 4096), 0)
large.paste(1, (4096, 0, 8192, 4096))
large.save("photo-33mp.png", optimize=True)
