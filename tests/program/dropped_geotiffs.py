"""GeoTIFFs written by GDAL: the viewer's page makes the program's mesh of each, or explains why not.

usage: dropped_geotiffs.py DEM SCARP NODE GEOTIFFS.MJS SOURCES NPM_PACKAGE
"""
import json
import math
import struct
import subprocess
import sys

dem, scarp, *reader = sys.argv[1:]
COLS, ROWS, ERROR = 61, 47, 4
same, refused = [], {}


def gdal(tool, *words):
    subprocess.run([tool, "-q", *words], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)


def grid(name, value_of):
    with open(name, "w", encoding="ascii") as file:
        file.write(f"ncols {COLS}\nnrows {ROWS}\nxllcorner 0\nyllcorner 0\ncellsize 1\n")
        file.writelines(" ".join(str(value_of(col, row)) for col in range(COLS)) + "\n" for row in range(ROWS))


def is_hole(col, row):
    return math.hypot(col - 40, row - 20) < 9 or col + row < 20


def read_glb(name):
    whole = open(name, "rb").read()
    return json.loads(whole[20:20 + struct.unpack_from("<I", whole, 12)[0]])


def make(name, *words, source="base.tif", says=None):
    """`says`: part of the message about a refused file."""
    gdal("gdal_translate", *words, source, f"{name}.tif")
    if says:
        refused[f"{name}.tif"] = says
    else:
        same.append(f"{name}.tif")


create = lambda *options: [word for option in options for word in ("-co", option)]
gdal("gdal_translate", "-srcwin", "100", "100", str(COLS), str(ROWS), *create("PROFILE=BASELINE"), "--config", "GDAL_PAM_ENABLED", "NO", dem, "unplaced.tif")
gdal("gdal_translate", "-a_ullr", "0", str(ROWS), str(COLS), "0", "unplaced.tif", "base.tif")
grid("shown.asc", lambda col, row: 0 if is_hole(col, row) else 255)
grid("holes.asc", lambda col, row: -9999 if is_hole(col, row) else 300 + col * row % 17 + 0.1)
grid("real.asc", lambda col, row: 300 + 80 * math.sin(col / 9) * math.cos(row / 7) + col * row % 7 / 3)
subprocess.run(["gdalbuildvrt", "-q", "-separate", "both.vrt", "base.tif", "shown.asc"], check=True)
subprocess.run(["gdalbuildvrt", "-q", "-separate", "many.vrt", "base.tif", "base.tif", "base.tif", "shown.asc"], check=True)

# Masks in the file, with one bit or eight, and alpha bands.
INSIDE = ("--config", "GDAL_TIFF_INTERNAL_MASK", "YES")
make("mask", "-b", "1", "-mask", "2", *INSIDE, source="both.vrt")
make("mask_deflate", "-b", "1", "-mask", "2", *INSIDE, *create("COMPRESS=DEFLATE", "TILED=YES", "BLOCKXSIZE=16", "BLOCKYSIZE=32"), source="both.vrt")
make("mask_8_bits", "-b", "1", "-mask", "2", *INSIDE, "--config", "GDAL_TIFF_DEFLATE_SUBFILE", "NO", *create("COMPRESS=LZW", "ENDIANNESS=BIG"), source="both.vrt")
make("mask_nodata", "-b", "1", "-mask", "2", "-a_nodata", "500", *INSIDE, source="both.vrt")
make("mask_cog", "-b", "1", "-mask", "2", "-of", "COG", *create("COMPRESS=DEFLATE"), source="both.vrt")
make("alpha", "-ot", "UInt16", *create("ALPHA=YES"), source="both.vrt")
make("alpha_by_band", "-ot", "UInt16", *create("ALPHA=PREMULTIPLIED", "INTERLEAVE=BAND"), source="both.vrt")
make("alpha_ignored", "-ot", "Int16", *create("ALPHA=YES"), source="both.vrt")
make("alpha_nodata", "-ot", "Float32", "-a_nodata", "500", *create("ALPHA=YES", "COMPRESS=DEFLATE", "PREDICTOR=3"), source="both.vrt")
make("alpha_fourth", "-ot", "UInt16", *create("ALPHA=YES"), source="many.vrt")
make("alpha_third", "-b", "1", "-b", "1", "-b", "2", "-ot", "UInt16", "-colorinterp_3", "alpha", source="both.vrt")
make("alpha_none", "-ot", "UInt16", *create("ALPHA=NO"), source="both.vrt")
make("alpha_lerc", "-ot", "Byte", *create("ALPHA=YES", "COMPRESS=LERC"), source="both.vrt")
make("bands", "-ot", "Int32", *create("COMPRESS=LZW", "PREDICTOR=2"), source="many.vrt")
for name in ("mask", "mask_deflate"):
    subprocess.run(["gdaladdo", "-q", f"{name}.tif", "2", "4"], check=True)

# Ways to pack, orders of bytes, types.
for packing in ("NONE", "LZW", "DEFLATE", "PACKBITS", "ZSTD", "LERC", "LERC_DEFLATE", "LERC_ZSTD"):
    for kind in ("Int16", "Float32", "Float64"):
        for order in ("LITTLE", "BIG"):
            tiled = ("TILED=YES", "BLOCKXSIZE=16", "BLOCKYSIZE=16") if (kind == "Int16") == (order == "BIG") else ("BLOCKYSIZE=7",)
            predictor = () if packing not in ("LZW", "DEFLATE", "ZSTD") else ("PREDICTOR=2",) if kind == "Int16" else ("PREDICTOR=3",)
            if order == "BIG" and kind == "Float64":
                predictor = ()  # GDAL 3.6 itself reads back other numbers
            says = "big-endian numbers packed by LERC" if order == "BIG" and "LERC" in packing else None
            make(f"{packing}_{kind}_{order}", "-ot", kind, *create(f"COMPRESS={packing}", f"ENDIANNESS={order}", *tiled, *predictor), source="real.asc", says=says)
for order in ("LITTLE", "BIG"):
    for kind, bits in (("Byte", 7), ("Byte", 1), ("UInt16", 12), ("UInt32", 24), ("UInt32", 20), ("Float32", 16)):
        make(f"bits_{bits}_{order}", "-ot", kind, "-scale", "0", "1100", "0", "100" if bits == 7 else "1" if bits == 1 else "1100", *create(f"NBITS={bits}", f"ENDIANNESS={order}"))
    for kind in ("Byte", "UInt16", "Int32", "UInt32"):
        make(f"{kind}_{order}", "-ot", kind, *create(f"ENDIANNESS={order}", "COMPRESS=DEFLATE", "PREDICTOR=2"))
make("half_predicted", "-ot", "Float32", *create("NBITS=16", "COMPRESS=DEFLATE", "PREDICTOR=3"))
make("float_differences", "-ot", "Float32", *create("COMPRESS=DEFLATE", "PREDICTOR=2"))
make("int8", "-ot", "Byte", "-scale", "200", "1100", "0", "255", "-a_nodata", "-128", *create("PIXELTYPE=SIGNEDBYTE"))
make("int64", "-ot", "Int64", "-a_nodata", "500")
make("uint64", "-ot", "UInt64", *create("ENDIANNESS=BIG", "COMPRESS=LZW"))
make("big", *create("BIGTIFF=YES", "COMPRESS=ZSTD"))
make("big_big", *create("BIGTIFF=YES", "ENDIANNESS=BIG"))
gdal("gdal_translate", "-outsize", "300", "280", "base.tif", "wide.tif")
make("cog", "-of", "COG", *create("BLOCKSIZE=128"), source="wide.tif")
make("cog_zstd", "-of", "COG", "-ot", "Float32", *create("BLOCKSIZE=128", "COMPRESS=ZSTD", "PREDICTOR=YES"), source="wide.tif")

# Nodata, scale and offset; blocks never written.
make("nodata", "-a_nodata", "-9999", source="holes.asc")
make("nan", "-ot", "Float32", "-a_nodata", "nan", source="real.asc")
make("nodata_as_nan", "-ot", "Float32", "-a_nodata", "300.1", source="holes.asc")
make("nodata_of_byte", "-ot", "Byte", "-a_nodata", "-9999")
make("nodata_scaled", "-ot", "Float32", "-a_nodata", "300.1", "-a_scale", "3", "-a_offset", "-5", source="holes.asc")
gdal("gdalwarp", "-srcnodata", "-9999", "-dstnodata", "nan", "holes.asc", "nan_holes.tif")
same.append("nan_holes.tif")
make("lerc_nan", "-ot", "Float32", *create("COMPRESS=LERC"), source="nan_holes.tif")
for least in ("-inf", "-3.4028234663852886e+38", "-3.40282e+38", "-1.7976931348623157e+308"):
    for kind in ("Float32", "Float64"):
        if kind == "Float64" or "308" not in least:
            grid("least.asc", lambda col, row: least if is_hole(col, row) else 300 + col * row % 17 + 0.1)
            make(f"least_{kind}_{least}", "-ot", kind, "-a_nodata", least, source="least.asc")
make("scale", "-a_scale", "0.31", "-a_offset", "-100")
make("scale_0", "-a_scale", "0", "-a_offset", "-100")
make("scale_nodata", "-a_scale", "0.5", "-a_nodata", "500", "-ot", "UInt16")
make("metadata", "-mo", "SCALE=7", "-mo", "OFFSET=7")
gdal("gdal_translate", "-a_nodata", "-9999", "holes.asc", "holes.tif")
for order in ("LITTLE", "BIG"):
    make(f"sparse_{order}", "-ot", "Float32", *create("SPARSE_OK=TRUE", "TILED=YES", "BLOCKXSIZE=16", "BLOCKYSIZE=16", f"ENDIANNESS={order}"), source="holes.tif")
make("sparse_zeros", *create("SPARSE_OK=TRUE", "TILED=YES", "BLOCKXSIZE=16", "BLOCKYSIZE=16", "COMPRESS=DEFLATE"), source="shown.asc")

# Their positions.
make("point", "-mo", "AREA_OR_POINT=Point")
make("degrees", "-a_srs", "EPSG:4979", "-a_ullr", "9.9", "10.2", "9.951", "10.15")
make("feet", "-a_srs", "EPSG:2264", "-a_ullr", "1000", "9000", "1610", "8530")
gdal("gdal_translate", "-of", "VRT", "-a_srs", "EPSG:32616", "-a_ullr", "0", "1", "1", "0", "base.tif", "turned.vrt")
text = open("turned.vrt", encoding="utf-8").read()
first, last = text.index("<GeoTransform>"), text.index("</GeoTransform>")
open("turned.vrt", "w", encoding="utf-8").write(text[:first] + "<GeoTransform>500000, 30, 4, 4000000, 5, -28" + text[last:])
make("turned", source="turned.vrt")
make("turned_point", "-mo", "AREA_OR_POINT=Point", source="turned.vrt")

# Files that the page does not read.
make("jpeg", "-ot", "Byte", *create("COMPRESS=JPEG"), says="compression 7")
make("lzma", *create("COMPRESS=LZMA"), says="compression 34925")
make("complex", "-ot", "CFloat32", says="complex")
make("ycbcr", "-ot", "Byte", "-b", "1", "-b", "2", "-b", "3", *create("COMPRESS=JPEG", "PHOTOMETRIC=YCBCR"), source="many.vrt", says="compression 7")
make("beyond", "-ot", "Float64", "-a_scale", "1e39", says="3.4028235e38")
whole = open("DEFLATE_Float32_BIG.tif", "rb").read()
open("cut_off.tif", "wb").write(whole[:len(whole) * 2 // 3])
refused["cut_off.tif"] = "damaged or cut off"
whole = open("NONE_Float32_LITTLE.tif", "rb").read()
sample_format = struct.pack("<HHI", 339, 3, 1)  # contains text instead
assert whole.count(sample_format) == 1
open("odd_tag.tif", "wb").write(whole.replace(sample_format, struct.pack("<HHI", 339, 2, 1)))
refused["odd_tag.tif"] = "damaged or cut off"

files = [*same, *refused]
output = subprocess.run([*reader, str(ERROR), *files], check=True, stdout=subprocess.PIPE, text=True).stdout
pages = [json.loads(line) for line in output.splitlines()]
faults = []
for name, page in zip(files, pages, strict=True):
    if name in refused:
        if not page.get("is_told") or refused[name] not in page["sentence"]:
            faults.append((name, page))
        continue
    run = subprocess.run([scarp, "simplify", name, "mesh.glb", "-e", str(ERROR), "--effort", "fast", "--overwrite", "-q"], capture_output=True, text=True)
    if run.returncode:
        faults.append((name, run.stderr, page))
        continue
    document = read_glb("mesh.glb")
    told, (points, indices) = document["asset"]["extras"], [document["accessors"][k]["count"] for k in (0, 1)]
    expected = {"vertices": points, "triangles": indices // 3, "crs_option": told["crs_option"]}
    if told.get("origin_crs", "").startswith("EPSG:"):
        expected["origin_crs"] = told["origin_crs"]
    found = {key: page.get(key) for key in expected}
    places = [(told[key], page.get(key, [])) for key in ("origin", "to_source") if key in told]
    off = abs(told["error"]["max_error"] - page.get("max_error", math.inf))
    if found != expected or off > 1e-4 or any(len(a) != len(b) or any(abs(x - y) > 1e-12 * max(1, abs(x)) for x, y in zip(a, b)) for a, b in places):
        faults.append((name, expected, page, places))
for fault in faults:
    print(*fault, sep="\n    ")
assert not faults, f"{len(faults)} of {len(files)} files"
print(len(same), "GeoTIFFs as the program reads them,", len(refused), "refused")
