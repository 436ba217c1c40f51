"""Writes four rasters and their companions into the working folder, in arithmetic that all machines round alike:
`fault` (the bundled DEM, 16 bits, degrees), `hills` (float32, no georeference), `coast` (float32 with nodata, UTM),
`town` (16 bits, walls and flats). The raster formats, raw bytes with a header (EHdr, PPM), need no library."""
import json
import pathlib
import shutil
import struct
import sys

COLS, ROWS = 224, 168
UTM = ('PROJCS["WGS 84 / UTM zone 11N",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],'
       'PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],'
       'PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",-117],PARAMETER["scale_factor",0.9996],'
       'PARAMETER["false_easting",500000],PARAMETER["false_northing",0],UNIT["metre",1]]')


def noise(col, row, period, seed):
    """Bilinear between pseudo-random integers -512 … 511 on a lattice, times period squared."""
    def corner(x, y):
        h = (x * 374761393 + y * 668265263 + seed * 974634777) & 0xFFFFFFFF
        h = ((h ^ (h >> 13)) * 1274126177) & 0xFFFFFFFF
        return ((h ^ (h >> 16)) & 1023) - 512
    x, fx = divmod(col, period)
    y, fy = divmod(row, period)
    top = corner(x, y) * (period - fx) + corner(x + 1, y) * fx
    low = corner(x, y + 1) * (period - fx) + corner(x + 1, y + 1) * fx
    return top * (period - fy) + low * fy


def hill(col, row, seed):
    """Four octaves; exact in a double."""
    return sum(noise(col, row, period, seed) / (period * 64) for period in (128, 64, 32, 8))


def town(col, row):
    x, y = col // 25, row // 20
    height = (x * 7 + y * 13 + x * y) % 11
    inside = 4 <= col % 25 < 21 and 3 <= row % 20 < 17
    return 100 + col // 16 + (9 + 3 * height if inside and height > 3 else 0)


def write_raw(name, values, kind, cols, rows, cell=None, corner=(0, 0), crs=None, nodata=None):
    letter, bits, pixel = {"float": ("f", 32, "FLOAT"), "short": ("h", 16, "SIGNEDINT")}[kind]
    pathlib.Path(name + ".bil").write_bytes(struct.pack(f"<{len(values)}{letter}", *values))
    header = [f"NROWS {rows}", f"NCOLS {cols}", "NBANDS 1", f"NBITS {bits}", f"PIXELTYPE {pixel}", "BYTEORDER I"]
    if cell:
        header += [f"XDIM {cell}", f"YDIM {cell}", f"ULXMAP {corner[0]}", f"ULYMAP {corner[1]}"]
    if nodata is not None:
        header.append(f"NODATA {nodata}")
    pathlib.Path(name + ".hdr").write_text("\n".join(header) + "\n")
    if crs:
        pathlib.Path(name + ".prj").write_text(crs + "\n")


def write_features(name, kind, parts, crs):
    features = [{"type": "Feature", "properties": {}, "geometry": {"type": kind, "coordinates": part}} for part in parts]
    named = {"crs": {"type": "name", "properties": {"name": crs}}} if crs else {}
    pathlib.Path(name).write_text(json.dumps({"type": "FeatureCollection", "features": features, **named}))


def write_companions(name, cols, rows, to_map, low, high, crs=None):
    """Lines, polygons, masks, tolerances, a photograph and points; heights between low and high."""
    def line(*points, z=None):
        return [to_map(x * cols, y * rows) + ([] if z is None else [z]) for x, y in points]
    middle = (low + high) / 2
    zigzag = [(0.1, 0.9), (0.3, 0.62), (0.32, 0.3), (0.55, 0.41), (0.71, 0.07)]
    write_features(name + ".lines.geojson", "LineString", [line(*zigzag), line((0.05, 0.2), (0.95, 0.83))], crs)
    write_features(name + ".river.geojson", "LineString", [line(*zigzag)], crs)
    write_features(name + ".hard.geojson", "LineString",
                   [line(*zigzag, z=middle), line((0.6, 0.6), (0.9, 0.6), (0.9, 0.3), z=low)], crs)
    ring = [(0.2, 0.25), (0.8, 0.15), (0.93, 0.7), (0.5, 0.9), (0.15, 0.75), (0.2, 0.25)]
    write_features(name + ".cut.geojson", "Polygon", [[line(*ring)]], crs)
    pond = [(0.4, 0.5), (0.52, 0.47), (0.55, 0.58), (0.45, 0.63), (0.4, 0.5)]
    write_features(name + ".pond.geojson", "Polygon", [[line(*pond)]], crs)
    site = [(0.7, 0.3), (0.8, 0.3), (0.78, 0.45), (0.69, 0.4), (0.7, 0.3)]
    write_features(name + ".site.geojson", "Polygon", [[line(*site)]], crs)
    cells = [(col, row) for row in range(rows) for col in range(cols)]
    write_raw(name + ".mask", [(1 + (col // 50 + row // 40) % 4) / 4 for col, row in cells], "float", cols, rows)
    write_raw(name + ".near", [(high - low) * (1 + (col * 3 + row * 2) // 200 % 4) / 128 for col, row in cells], "float",
              cols, rows)
    photo = bytes(v for col, row in cells for v in ((col * 255) // cols, (row * 255) // rows, 255 * ((col // 40 + row // 40) % 2)))
    pathlib.Path(name + ".photo.ppm").write_bytes(b"P6 %d %d 255\n" % (cols, rows) + photo)
    pathlib.Path(name + ".steps.txt").write_text(
        "".join(f"s {cols * i // 9} {rows * (8 - i) // 9}\n" for i in range(1, 9)) + "i 5 5\nu 17 30\n")


def write_points(name, height, cols, rows):
    lines = []
    for i in range(4000):
        x, y = (i * 7919) % (cols * 4), (i * 104729) % (rows * 4)
        z = height(x // 4, y // 4)
        if z is not None:
            lines.append(f"{x / 4},{y / 4},{z!r}\n")
    pathlib.Path(name + ".points.csv").write_text("x,y,z\n" + "".join(lines))


def main(dem):
    shutil.copy(dem, "fault.tif")
    west, north, cell = -84.41375, 36.44625, 1 / 1200
    write_companions("fault", 403, 344, lambda x, y: [west + (x + 0.5) * cell, north - (y + 0.5) * cell], 236, 1076)
    write_points("fault", lambda x, y: hill(x, y, 9) + x / 2, 403, 344)

    grid = lambda x, y: [x, ROWS - 1 - y]
    cells = [(col, row) for row in range(ROWS) for col in range(COLS)]
    write_raw("hills", [hill(col, row, 1) + col / 8 for col, row in cells], "float", COLS, ROWS)
    write_companions("hills", COLS, ROWS, grid, -500, 500)
    write_points("hills", lambda x, y: hill(x, y, 1), COLS, ROWS)

    def coast(col, row):
        z = hill(col, row, 5) + (col + row) / 4
        wet = noise(col, row, 64, 7) / 4096 + (col - 150) * 2 < -120 or (col - 260) ** 2 + (row - 60) ** 2 < 400
        return None if wet else z
    heights = [coast(col, row) for col, row in cells]
    write_raw("coast", [-9999 if z is None else z for z in heights], "float", COLS, ROWS, 10, (500000, 4000000), UTM, -9999)
    write_companions("coast", COLS, ROWS, lambda x, y: [500000 + 10 * x, 4000000 - 10 * y], -400, 600, "EPSG:32611")
    write_points("coast", coast, COLS, ROWS)

    write_raw("town", [town(col, row) for col, row in cells], "short", COLS, ROWS, 2, (500000, 4000000), UTM)
    write_companions("town", COLS, ROWS, lambda x, y: [500000 + 2 * x, 4000000 - 2 * y], 100, 160, "EPSG:32611")
    write_points("town", town, COLS, ROWS)


if __name__ == "__main__":
    main(sys.argv[1])
