#!/usr/bin/env python3
"""Makes a raster of any size, a few MB on disk: a VRT that repeats a 16-bit raster, mirrored so that borders match.

    make_vrt.py RASTER SIDE OUTPUT.vrt      make_vrt.py moon_gld100_caucasus_4096.tif 60000 moon60000.vrt

RASTER's band 1 must be Int16. Next to OUTPUT it writes four tiled, compressed GeoTIFFs (RASTER and its mirrors), shared
by all VRTs in the folder. Needs gdal_translate and gdalinfo.
"""
import array
import json
import os
import subprocess
import sys

SOURCE = """<SimpleSource><SourceFilename relativeToVRT="1">{name}</SourceFilename><SourceBand>1</SourceBand>\
<SourceProperties RasterXSize="{cols}" RasterYSize="{rows}" DataType="Int16" BlockXSize="256" BlockYSize="256"/>\
<SrcRect xOff="0" yOff="0" xSize="{width}" ySize="{height}"/>\
<DstRect xOff="{x}" yOff="{y}" xSize="{width}" ySize="{height}"/></SimpleSource>
"""


def run(*command):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout


def write_mirrors(raster, folder, cols, rows):
    """Returns names[mirrored up-down][mirrored left-right]."""
    stem = os.path.splitext(os.path.basename(raster))[0]
    names = [[f"{stem}_{v}{h}.tif" for h in (0, 1)] for v in (0, 1)]
    raw = os.path.join(folder, stem + ".raw")
    if all(os.path.exists(os.path.join(folder, name)) for row in names for name in row):
        return names
    run("gdal_translate", "-q", "-of", "ENVI", "-ot", "Int16", "-b", "1", raster, raw)
    with open(raw, "rb") as source:
        lines = [array.array("h", source.read(2 * cols)) for _ in range(rows)]
    for v in (0, 1):
        for h in (0, 1):
            with open(raw, "wb") as mirror:
                for line in reversed(lines) if v else lines:
                    (line[::-1] if h else line).tofile(mirror)
            run("gdal_translate", "-q", "-co", "TILED=YES", "-co", "COMPRESS=DEFLATE", "-co", "PREDICTOR=2", raw,
                os.path.join(folder, names[v][h]))
    for rest in (raw, raw[:-4] + ".hdr", raw + ".aux.xml"):
        if os.path.exists(rest):
            os.remove(rest)
    return names


def main(raster, side, output):
    side = int(side)
    cols, rows = json.loads(run("gdalinfo", "-json", raster))["size"]
    names = write_mirrors(raster, os.path.dirname(os.path.abspath(output)), cols, rows)
    with open(output, "w") as out:
        out.write(f'<VRTDataset rasterXSize="{side}" rasterYSize="{side}"><VRTRasterBand dataType="Int16" band="1">\n')
        for i, y in enumerate(range(0, side, rows)):
            for j, x in enumerate(range(0, side, cols)):
                out.write(SOURCE.format(name=names[i % 2][j % 2], cols=cols, rows=rows, x=x, y=y,
                                        width=min(cols, side - x), height=min(rows, side - y)))
        out.write("</VRTRasterBand></VRTDataset>\n")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
