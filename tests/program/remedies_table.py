"""The remedies in Scarp's messages, each with a situation. remedies.py describes how rows are tried.

C: a command. The output of `run` contains it (at index `way`), `fill` replaces its words in capitals, and it is
executed. Then `run` is repeated with the new file instead of the old one, or `then` runs. O: an option. The output of
`run` contains `says`, and `then`, which follows the advice, succeeds.
"""

import json
import math

# Made once and copied into each row's folder.
BASE = """
gdal_translate -q -srcwin 100 100 40 36 whole.tif dem.tif
gdal_translate -q -srcwin 200 100 40 36 whole.tif east.tif
gdal_translate -q -a_srs EPSG:32616 -a_ullr 740000 4020000 743600 4016760 dem.tif utm.tif
gdal_translate -q -a_srs EPSG:32616 -a_ullr 743600 4020000 747200 4016760 dem.tif utm_east.tif
scarp generate fractal 40 36 none.tif -q
gdal_translate -q -a_nodata none -a_srs EPSG:32617 -a_ullr 740000 4020000 743600 4016760 dem.tif zone17.tif
gdal_translate -q -ot Byte -scale 0 1100 0 255 dem.tif byte.tif
gdal_translate -q -b 1 -b 1 -b 1 -colorinterp red,green,blue byte.tif rgb.tif
poly() { printf '{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"elev":500,"name":"a"},"geometry":%s}]}' "$1"; }
ring='[[-84.318,36.345],[-84.310,36.345],[-84.310,36.352],[-84.318,36.352],[-84.318,36.345]]'
poly '{"type":"Polygon","coordinates":['"$ring"']}' > lake.geojson
poly '{"type":"LineString","coordinates":'"$ring"'}' > closed.geojson
poly '{"type":"LineString","coordinates":[[-84.325,36.36],[-84.31,36.35],[-84.30,36.335]]}' > stream.geojson
printf 'x,y,z\\n0,0,1\\n90,0,2\\n0,90,3\\n90,90,5\\n40,50,4\\n' > plain.csv
printf 'lon,lat,h\\n8.1,46.1,500\\n8.2,46.1,600\\n8.1,46.2,700\\n8.2,46.2,650\\n8.15,46.16,640\\n' > degrees.csv
scarp simplify dem.tif mesh.glb -e 20 -q
scarp simplify dem.tif mesh.obj -e 20 -q --crs source
python3 - <<'END'
import random, struct
random.seed(1)
points = [(random.randrange(10**5), random.randrange(10**5), random.randrange(3000)) for _ in range(60)]
head = bytearray(227)
struct.pack_into("<4s", head, 0, b"LASF")
struct.pack_into("<BB", head, 24, 1, 2)
struct.pack_into("<HIIBHI", head, 94, 227, 227, 0, 0, 20, len(points))
struct.pack_into("<6d", head, 131, 0.01, 0.01, 0.01, 500000, 4000000, 0)
open("scan.las", "wb").write(bytes(head) + b"".join(struct.pack("<3iHBBbBH", *point, 0, 0, 2, 0, 0, 0) for point in points))
END
"""

ROWS = []


def C(name, run, make="", fill=None, way=0, then=None, says=None):
    row = {"name": name, "run": run, "make": make, "fill": fill or {}, "way": way, "then": then}
    if says:
        row["says"] = says
    ROWS.append(row)


def M(*arguments):
    C(*arguments)
    ROWS[-1]["may_go"] = True


def O(name, run, says, then, make="", code=0):
    ROWS.append({"name": name, "run": run, "says": says, "then": then, "make": make, "code": code})


def points(first, properties):
    """p.geojson: five points, whose attribute `up` is a height; the first has other coordinates and attributes."""
    features = [{"type": "Feature", "properties": {"up": k, **properties, **(first if k == 0 else {})},
                 "geometry": {"type": "Point", "coordinates": [9 * (k % 2), 5 * k, *first.get("z", [])][:3 if k == 0 else 2]}}
                for k in range(5)]
    for feature in features:
        feature["properties"].pop("z", None)
    return f"cat > p.geojson <<'END'\n{json.dumps({'type': 'FeatureCollection', 'features': features})}\nEND\n"


BOX = {"WEST NORTH EAST SOUTH": "-84.33 36.36 -84.30 36.33", "EPSG:CODE": "EPSG:4326"}
UTM_BOX = {"WEST NORTH EAST SOUTH": "740000 4020000 743600 4016760", "EPSG:CODE": "EPSG:32616"}
ASC = "gdal_translate -q -of AAIGrid dem.tif d.asc; rm -f d.prj d.asc.aux.xml"


def lut(name, table, options):
    """A raster whose heights are those of the table."""
    return (f"gdal_translate -q -of VRT {options} dem.tif '{name}'; sed -i 's/SimpleSource/ComplexSource/; "
            f"s#</ComplexSource>#<LUT>{table}</LUT>&#' '{name}'; ")


def unit(source, name, word):
    """The raster, with heights in that unit."""
    return f"gdal_translate -q -of VRT {source} '{name}'; sed -i 's#<VRTRasterBand[^>]*>#&<UnitType>{word}</UnitType>#' '{name}'; "


# The position of a raster.
C("asc in degrees", "scarp simplify d.asc o.glb -e 20", ASC)
C("png in degrees", "scarp simplify d.png o.glb -e 20", "gdal_translate -q -of PNG -co WORLDFILE=YES -ot UInt16 dem.tif d.png; rm d.png.aux.xml")
C("a name with blanks", "scarp simplify 'my dem.asc' o.glb -e 20", ASC + "; mv d.asc 'my dem.asc'")
C("no CRS, --crs", "scarp simplify d.asc o.glb -e 20 --crs EPSG:32616", ASC, BOX)
C("no place, --crs", "scarp simplify none.tif o.glb -e 0.1 --crs EPSG:32616", "", UTM_BOX)
C("no place, PGM", "scarp simplify n.pgm o.glb -e 1 --crs EPSG:32616", "scarp generate fractal 40 36 n.pgm -q", UTM_BOX)
C("a line as place", "scarp simplify line.vrt o.glb -e 20",
  "gdal_translate -q -of VRT dem.tif line.vrt; sed -i 's#<GeoTransform>.*</GeoTransform>#<GeoTransform>1, 0, 0, 1, 0, 0</GeoTransform>#' line.vrt", BOX)
C("ground control points", "scarp simplify gcp.tif o.glb -e 20",
  "gdal_translate -q -a_srs EPSG:4326 -gcp 0 0 -84.33 36.36 -gcp 40 0 -84.30 36.361 -gcp 0 36 -84.331 36.33 -gcp 40 36 -84.3 36.33 dem.tif gcp.tif")
C("heights in space", "scarp simplify dem.tif o.glb -e 20 --crs enu")
C("heights in space, UTM", "scarp simplify utm.tif o.glb -e 20 --crs EPSG:4978")
C("tiles of no place", "scarp tile none.tif g --grid geographic -e 1 --vertical ellipsoid", "", BOX)
O("tiles of no place, local", "scarp tile none.tif g --grid geographic -e 1", "take --grid local", "scarp tile none.tif g --grid local -e 1")
C("an image without place on the globe", "scarp tile dem.tif g --of 3dtiles --vertical egm96 --drape pic.tif", "gdal_translate -q -srcwin 0 0 20 20 rgb.tif a.tif; gdal_translate -q -of PNG a.tif b.png; rm -f b.png.aux.xml; gdal_translate -q b.png pic.tif", BOX)
C("an image without place", "scarp simplify dem.tif o.glb -e 20 --drape b.png", "gdal_translate -q -srcwin 0 0 20 20 -of PNG rgb.tif b.png; rm b.png.aux.xml", BOX)
C("a raster without place, an image with one", "scarp simplify none.tif o.glb -e 0.1 --drape rgb.tif", "gdal_translate -q -srcwin 0 0 30 30 rgb.tif a.tif; mv a.tif rgb.tif", BOX)
C("beyond 180 degrees", "scarp tile far.tif g -e 20 --zoom 9 --vertical ellipsoid", "gdal_translate -q -a_srs EPSG:3857 -a_ullr 19990000 40000 20110000 0 dem.tif far.tif")
C("longitudes of 720", "scarp tile far.tif g -e 20 --zoom 9 --vertical ellipsoid", "gdal_translate -q -a_srs EPSG:4326 -a_ullr 719.4 41 720.4 40 dem.tif far.tif", dict(BOX, FILE="far.tif"))
C("metres called degrees", "scarp tile far.tif g -e 20 --vertical ellipsoid", "gdal_translate -q -a_srs EPSG:4326 -a_ullr 700000 80 700160 -64 dem.tif far.tif", {"EPSG:CODE": "EPSG:3857"})
C("degrees called metres", "scarp simplify d32.tif o.glb -e 20", "gdal_translate -q -a_srs EPSG:32616 dem.tif d32.tif")
C("a local grid of degrees", "scarp tile dem.tif g --grid local -e 20")
O("a local grid of degrees, geographic", "scarp tile dem.tif g --grid local -e 20", "take --grid geographic", "scarp tile dem.tif g --grid geographic -e 20 --zoom 9 --vertical egm96")
C("a local grid of a turned raster", "scarp tile turned.tif g --grid local -e 20 --vertical ellipsoid", "gdal_translate -q -a_srs EPSG:32616 -a_ullr 743600 4020000 740000 4016760 dem.tif turned.tif")
C("a stack with another datum", "scarp tile east.tif sea.tif g -e 20 --zoom 9 --vertical ellipsoid", "gdal_translate -q -a_srs EPSG:4326+5773 dem.tif sea.tif",
  then="scarp tile NEW.tif sea.tif g -e 20 --zoom 9")
C("parts of a stack", "scarp tile dem.tif utm.tif g -e 20 --zoom 9 --vertical egm96 --te -84.33 36.34 -84.31 36.36", "", {"XMIN YMIN XMAX YMAX": "-84.33 36.34 -84.31 36.36", "WIDTH HEIGHT": "0.001 0.001"},
  then="scarp tile NEW.tif utm.tif g -e 20 --zoom 9 --vertical egm96")
C("a local grid of two", "scarp tile utm.tif fine.tif g --grid local -e 20 --vertical ellipsoid", "gdal_translate -q -outsize 200% 200% utm_east.tif fine.tif", then="scarp tile NEW.tif g --grid local -e 20 --vertical ellipsoid")

# Mosaics: differences are named, unless Scarp resolves them.
M("two zones", "scarp simplify utm.tif zone17.tif o.glb -e 20")
M("one without CRS", "scarp simplify utm.tif bare.tif o.glb -e 20", "gdal_translate -q -of AAIGrid utm_east.tif b.asc; rm -f b.prj b.asc.aux.xml; gdal_translate -q -ot Int16 b.asc bare.tif")
M("the first without CRS", "scarp simplify bare.tif utm.tif o.glb -e 20", "gdal_translate -q -of AAIGrid utm_east.tif b.asc; rm -f b.prj b.asc.aux.xml; gdal_translate -q -ot Int16 b.asc bare.tif")
M("other bands", "scarp simplify utm.tif two.tif o.glb -e 20", "gdal_translate -q -b 1 -b 1 utm_east.tif two.tif")
M("other types", "scarp simplify utm.tif float.tif o.glb -e 20", "gdal_translate -q -ot Float32 utm_east.tif float.tif")
M("other types, neither holds both", "scarp simplify utm.tif wide.tif o.glb -e 20", "gdal_translate -q -ot UInt16 utm_east.tif wide.tif")
M("one with nodata", "scarp simplify utm.tif nodata.tif o.glb -e 20", "gdal_translate -q -a_nodata -9999 utm_east.tif nodata.tif")
M("other nodata", "scarp simplify first.tif nodata.tif o.glb -e 20", "gdal_translate -q -a_nodata -1 utm.tif first.tif; gdal_translate -q -a_nodata -9999 utm_east.tif nodata.tif")
M("other scales", "scarp simplify utm.tif scaled.tif o.glb -e 20", "gdal_translate -q -a_scale 0.1 utm_east.tif scaled.tif")
M("the first scaled", "scarp simplify scaled.tif utm.tif o.glb -e 20", "gdal_translate -q -a_scale 0.1 utm_east.tif scaled.tif")
M("other cells", "scarp simplify utm.tif coarse.tif o.glb -e 20", "gdal_translate -q -outsize 50% 50% utm_east.tif coarse.tif")
M("beside the grid", "scarp simplify utm.tif beside.tif o.glb -e 20", "gdal_translate -q -a_ullr 743640 4020030 747240 4016790 utm_east.tif beside.tif")
M("a rotated one", "scarp simplify utm.tif turned.vrt o.glb -e 20", "gdal_translate -q -of VRT utm_east.tif turned.vrt; sed -i 's#<GeoTransform>.*</GeoTransform>#<GeoTransform>743600, 89, 9, 4020000, 9, -89</GeoTransform>#' turned.vrt")

C("the second without a unit", "scarp info 'feet west.vrt' 'no unit.tif'", unit("utm.tif", "feet west.vrt", "ft") + "mv utm_east.tif 'no unit.tif'", says="declare it first")
C("the first without a unit", "scarp info 'no unit.tif' 'feet east.vrt'", unit("utm_east.tif", "feet east.vrt", "US survey foot") + "mv utm.tif 'no unit.tif'", says="declare it first")
C("other units", "scarp info 'metres west.vrt' 'feet east.vrt'", unit("utm.tif", "metres west.vrt", "m") + unit("utm_east.tif", "feet east.vrt", "US survey foot"), says="bring it to one unit first")
EGM = "gdal_translate -q -a_srs EPSG:4326+5773 dem.tif 'sea west.tif'; "
C("one without a vertical datum", "scarp info 'sea west.tif' 'east.tif'", EGM, says="has the same, declare it first")
C("other vertical datums", "scarp info 'sea west.tif' 'space east.tif'", EGM + "gdal_translate -q -a_srs EPSG:4979 east.tif 'space east.tif'", says="bring it there first")
C("other vertical datums in another CRS", "scarp info 'space west.tif' 'sea east.tif'", "gdal_translate -q -a_srs EPSG:4979 dem.tif 'space west.tif'; gdal_translate -q -a_srs EPSG:32616+5773 utm_east.tif 'sea east.tif'", says="-t_srs EPSG:4979")
O("no grid between vertical datums", "scarp info 'sea west.tif' east.tif", "give rasters of one vertical datum|bring it there first", "scarp info 'sea west.tif' NEW.tif", EGM + "gdal_translate -q -a_srs EPSG:4326+5773 east.tif NEW.tif; gdal_translate -q -a_srs EPSG:4326+5701 east.tif b.tif; mv b.tif east.tif")
C("a type that makes no mosaic", "scarp info utm.tif 'complex east.tif'", "gdal_translate -q -ot CFloat32 utm_east.tif 'complex east.tif'", says="make no mosaic")
C("south up", "scarp info 'south up.vrt' utm_east.tif", "gdal_translate -q -of VRT utm.tif 'south up.vrt'; sed -i 's#<GeoTransform>.*</GeoTransform>#<GeoTransform>740000, 90, 0, 4016760, 0, 90</GeoTransform>#' 'south up.vrt'", says="begin at different sides")
C("once around, beside the grid", "scarp info 'one end.tif' 'other end.tif'", "gdal_translate -q -a_srs EPSG:4326 -a_ullr 152 40 180 33 dem.tif 'one end.tif'; gdal_translate -q -a_srs EPSG:4326 -a_ullr -179.8 40 -151.8 33 dem.tif 'other end.tif'", says="on the other side of the end of x")

# The contents of a raster.
C("complex numbers", "scarp simplify complex.tif o.glb -e 20", "gdal_translate -q -ot CFloat32 dem.tif complex.tif")
C("beyond float32", "scarp simplify beyond.tif o.glb -e 20%", "gdal_translate -q -ot Float64 -a_nodata none -scale 0 1 0 1e37 dem.tif beyond.tif")
O("beyond float32, nodata", "scarp simplify one.vrt o.glb -e 20", "give --nodata ", "scarp simplify one.vrt o.glb -e 20 --nodata $(scarp simplify one.vrt o.glb -e 20 2>&1 | grep -o 'nodata [^,]*' | cut -d' ' -f2)", lut("one.vrt", "0:0,934:934,935:1e39,936:936,2000:2000", "-ot Float64"))
C("too large for the memory", "scarp info huge.vrt", "echo '<VRTDataset rasterXSize=\"2000000\" rasterYSize=\"2000000\"><VRTRasterBand dataType=\"Float32\" band=\"1\"/></VRTDataset>' > huge.vrt", {"COLUMN ROW COLUMNS ROWS": "0 0 100 90"})
TWO = lut("two values.vrt", "0:-9999,459:-9999,460:460,920:920,921:-32768,2000:-32768", "-ot Float32 -a_nodata -32768")
C("two nodata values", "scarp simplify 'two values.vrt' o.glb -e 20", TWO)
C("two nodata values without a place", "scarp simplify 'two values.vrt' o.glb -e 20", TWO + "sed -i '/<SRS/d; /<GeoTransform/d' 'two values.vrt'", says="NO_GEOTRANSFORM")
O("undeclared nodata", "scarp simplify one.vrt o.glb -e 20", "give --nodata -9999", "scarp simplify one.vrt o.glb -e 20 --nodata -9999", lut("one.vrt", "0:-9999,459:-9999,460:460,2000:2000", "-ot Float32"))
C("a transparent texture", "scarp simplify dem.tif o.glb -t 500 --texture rgba.tif", "gdal_translate -q -b 1 -b 2 -b 3 -b 1 -colorinterp red,green,blue,alpha rgb.tif rgba.tif")
C("too many bands", "scarp simplify dem.tif o.ply -t 500 --texture many.tif", "gdal_translate -q $(printf -- '-b 1 %.0s' $(seq 300)) byte.tif many.tif")
C("a texture with a gap", "scarp simplify dem.tif o.glb -t 500 --texture gap.tif", "gdal_translate -q -a_nodata 120 byte.tif gap.tif")
C("an image of 16 bits", "scarp simplify dem.tif o.glb -e 20 --drape dem.tif")
C("a mask on another grid", "scarp simplify dem.tif o.glb -e 20 --mask m.tif", "gdal_translate -q -ot Float32 whole.tif m.tif")
C("a tolerance beside the raster", "scarp simplify dem.tif o.glb -e 20 --tolerance m.tif", "gdal_translate -q -srcwin 5 5 20 20 -ot Float32 dem.tif m.tif")
C("a tolerance in another CRS", "scarp simplify utm.tif o.glb -e 20 --tolerance m.tif", "gdalwarp -q -t_srs EPSG:4326 -ot Float32 -dstnodata -9999 utm.tif m.tif")
C("a tolerance of two bands", "scarp simplify dem.tif o.glb -e 20 --tolerance m.tif", "gdal_translate -q -ot Float32 -b 1 -b 1 dem.tif m.tif")
C("a tolerance of another size", "scarp simplify none.tif o.glb -e 1 --tolerance m.tif", "scarp generate smooth 20 18 m.tif -q --range 1")
C("lines in a bent grid", "scarp simplify dem.tif o.glb -e 20 --crs EPSG:32616 --breaklines stream.geojson")
C("a locked border in a bent grid", "scarp simplify dem.tif o.glb -e 20 --crs EPSG:32616 --lock-border", "", {"EPSG:CODE": "EPSG:32616", "FILE": "dem.tif"}, then="scarp simplify NEW.tif o.glb -e 20 --lock-border")
C("lakes on a local grid", "scarp tile utm.tif g --grid local -e 20 --vertical ellipsoid --water lake.geojson", "", {"RASTER": "utm.tif", "LAKES": "lake.geojson"}, then="scarp tile NEW.tif g --grid local -e 20 --vertical ellipsoid")
O("a level of a local grid", "scarp tile utm.tif g --grid local -e 20 --vertical ellipsoid --zoom 3", "leave --zoom out, or coarsen the raster with --resolution",
  "scarp tile utm.tif g --grid local -e 20 --vertical ellipsoid --resolution 180")

AXIS = '<Array name="%s"><DataType>Float64</DataType>%s<InlineValues>%s</InlineValues>%s</Array>'
UNIT = '<Attribute name="units"><DataType>String</DataType><Value>degrees_%s</Value></Attribute>'
ROWS_OF = [math.degrees(math.atan(math.sinh(k / 5))) for k in range(6)]
MERCATOR = (f'<VRTDataset><Group name="/"><Dimension name="lat" size="6" indexingVariable="lat"/><Dimension name="lon" size="6" indexingVariable="lon"/>'
            + AXIS % ("lat", '<DimensionRef ref="lat"/>', " ".join(map(repr, ROWS_OF)), UNIT % "north")
            + AXIS % ("lon", '<DimensionRef ref="lon"/>', " ".join(repr(math.degrees(k / 5)) for k in range(6)), UNIT % "east")
            + AXIS % ("z", '<DimensionRef ref="lat"/><DimensionRef ref="lon"/>', " ".join(str(100 + 37 * k % 50) for k in range(36)), "") + "</Group></VRTDataset>")
C("rows even in Mercator", "scarp simplify 'even rows.nc' o.glb -e 20", f"echo '{MERCATOR}' > m.vrt; gdalmdimtranslate -q -of netCDF m.vrt 'even rows.nc'", says="rows are even in Mercator")
# Colours of heights of -10000 + (65536 R + 256 G + B) / 10.
COLOURS = "scarp generate smooth 150 120 a.tif -q --range 90; gdal_translate -q -ot Int16 -a_nodata none -a_srs EPSG:32616 -a_ullr 740000 4020000 755000 4008000 a.tif b.tif; gdal_translate -q -of VRT -ot Byte -b 1 -b 1 -b 1 -colorinterp red,green,blue b.tif a.vrt; sed -e 's/SimpleSource/ComplexSource/'" + "".join(
    f" -e '/ band=.{band}./,/<.VRTRasterBand>/ s#</ComplexSource>#<LUT>{','.join(f'{z}:{(10 * z + 100000 >> shift) & 255}' for z in range(201))}</LUT>&#'"
    for band, shift in ((1, 16), (2, 8), (3, 0))) + " a.vrt > tile.vrt"
O("tiles of the other kind", "scarp simplify tile.vrt o.glb -e 20 --decode terrarium", "give --decode mapbox", "scarp simplify tile.vrt o.glb -e 20 --decode mapbox", COLOURS)
O("interpolated colours", "scarp simplify wide.tif o.glb -e 20 --decode mapbox", r"resample their heights, not their colours \(gdalwarp -r near\)", "gdalwarp -q -r near -te 740050 4008000 754950 4020000 -tr 100 100 tile.vrt n.tif; scarp simplify n.tif o.glb -e 20 --decode mapbox",
  COLOURS + "; gdalwarp -q -r bilinear -te 740050 4008000 754950 4020000 -tr 100 100 tile.vrt wide.tif")

# Files of another kind.
RAW = "gdal_translate -q -of ENVI -ot %s -outsize 33 %d dem.tif h.%s; rm h.hdr h.*.aux.xml"
C("r16", "scarp simplify h.r16 o.glb -e 20", RAW % ("UInt16", 33, "r16"))
C("raw, not square", "scarp simplify h.raw o.glb -e 20", RAW % ("UInt16", 40, "raw"), {"COLUMNS": "33", "ROWS": "40"})
C("r32", "scarp simplify h.r32 o.glb -e 20", RAW % ("Float32", 33, "r32"))
C("HDF4", "scarp simplify x.hdf o.glb -e 20", "gdal_translate -q -of HDF4Image dem.tif x.hdf")
C("gzip", "scarp simplify dem2.tif.gz o.glb -e 20", "cp dem.tif dem2.tif; gzip dem2.tif")
C("tar", "scarp simplify a.tgz o.glb -e 20", "cp dem.tif dem2.tif; tar -czf a.tgz dem2.tif; rm dem2.tif", then="scarp simplify dem2.tif o.glb -e 20")
O("LAS by another name", "scarp simplify scan.bin o.glb -e 2", r"as points \(--points\)", "scarp simplify scan.bin o.glb -e 2 --points", "mv scan.las scan.bin")
O("text in parts", "scarp simplify parts.csv o.glb -e 9 --memory 90M", "leave --memory out", "scarp simplify parts.csv o.glb -e 9", "printf 'x,y,z\\n0,0,1\\n9,0,2\\n0,9,3\\n9,9,1\\n' > parts.csv")
O("a class that no point has", "scarp simplify scan.las o.glb -e 2 --class water", "none of its 60 points is left: .*its classes are 2", "scarp simplify scan.las o.glb -e 2 --class ground")
O("PLY of points", "scarp simplify cloud.ply o.glb -e 1", "PLY point cloud: .*pdal translate cloud.ply", "true", "printf 'ply\\nformat ascii 1.0\\nelement vertex 1\\nproperty float x\\nend_header\\n1\\n' > cloud.ply")
C("ASCII grid with a mark", "scarp simplify marked.asc o.glb -e 1", "printf '\\357\\273\\277ncols 3\\nnrows 3\\nxllcorner 0\\nyllcorner 0\\ncellsize 1\\n1 2 3\\n4 9 6\\n7 8 1\\n' > marked.asc", then="scarp simplify NEW.asc o.glb -e 1")
C("LandXML in UTF-16", "scarp simplify wide.xml o.glb -e 1", "printf '<?xml version=\"1.0\"?><LandXML><Units><Metric linearUnit=\"meter\"/></Units><CgPoints><CgPoint>1 2 3</CgPoint><CgPoint>1 9 4</CgPoint><CgPoint>8 2 5</CgPoint></CgPoints></LandXML>' | iconv -f UTF-8 -t UTF-16 > wide.xml", then="scarp simplify NEW.xml o.glb -e 1")
O("binary DXF", "scarp simplify b.dxf o.glb -e 1", r"a binary DXF: save it as a DXF in text \(ASCII\)", "true", "printf 'AutoCAD Binary DXF\\r\\n' > b.dxf")
O("a web page", "scarp simplify page.tif o.glb -e 1", "a web page in place of the file: fetch the file again", "true", "echo '<!DOCTYPE html><html></html>' > page.tif")
O("Git LFS", "scarp simplify lfs.tif o.glb -e 1", r"\(git lfs pull\)", "true", "printf 'version https://git-lfs.github.com/spec/v1\\noid sha256:1\\nsize 5\\n' > lfs.tif")
C("a mesh", "scarp simplify mesh.glb o.glb -e 20")
C("a mesh as OBJ, to tiles", "scarp tile mesh.obj g -e 20 --zoom 9")
C("a mesh as lines", "scarp simplify dem.tif o.glb -e 20 --breaklines mesh.glb")
C("points for a plan of tiles", "scarp tile plan p.xyz g.json -e 20 --zoom 9 --vertical ellipsoid", "printf 'lon lat height\\n8.1 46.1 500\\n8.2 46.1 600\\n8.1 46.2 700\\n8.2 46.25 650\\n8.15 46.16 640\\n' > p.xyz; echo EPSG:4326 > p.prj",
  {"ERROR": "1", "SIZE": "500", **BOX}, then="scarp tile NEW.tif g -e 20 --zoom 9 --vertical ellipsoid")
C("a lidar file for a plan of tiles", "scarp tile plan scan.las g.json -e 20 --grid local --vertical none", fill={"ERROR": "1"}, then="scarp tile plan NEW.tif g.json -e 20 --grid local --vertical none")
C("the mesh before the raster", "scarp measure mesh.obj dem.tif --crs source")
O("several rasters", "scarp simplify two.nc o.glb -e 20", "name one of them: .*:Band2", "scarp simplify 'NETCDF:\"two.nc\":Band2' o.glb -e 20",
  "gdalbuildvrt -q -separate two.vrt dem.tif dem.tif; gdal_translate -q -of netCDF two.vrt two.nc")

# Points and lines.
DRAWING = """python3 - <<'END'
out = "0 SECTION 2 HEADER 0 ENDSEC 0 SECTION 2 ENTITIES".split()
for layer in "AB":
    for k in range(9):
        out += ["0", "POINT", "8", layer, "10", str(9 * (k % 3)), "20", str(9 * (k // 3)), "30", str(k)]
open("s.dxf", "w").write("\\n".join(out + ["0", "ENDSEC", "0", "EOF"]) + "\\n")
END"""
LANDXML = """cat > s.xml <<'END'
<LandXML><CgPoints><CgPoint>0 0 1</CgPoint><CgPoint>9 0 2</CgPoint><CgPoint>0 9 3</CgPoint></CgPoints><Surfaces><Surface name="a"><SourceData><DataPoints>
<PntList3D>3 3 1 4 4 2 5 3 4</PntList3D></DataPoints>
<Boundaries><Boundary><PntList2D>0 0 9 0 0 9</PntList2D></Boundary></Boundaries></SourceData></Surface></Surfaces></LandXML>
END"""
TWO_CRS = "".join(f"printf 'x,y,z\\n0,0,1\\n9,0,2\\n0,9,3\\n' > {name}.csv; ogr2ogr -q -append -f GPKG two.gpkg {name}.csv -nln {name} -a_srs EPSG:{code} "
                  "-oo X_POSSIBLE_NAMES=x -oo Y_POSSIBLE_NAMES=y -oo Z_POSSIBLE_NAMES=z; " for name, code in (("a", 32633), ("b", 32632)))
O("a drawing of two layers", "scarp simplify s.dxf o.obj -e 1", "the layers A, B: name those of the terrain", "scarp simplify s.dxf o.obj -e 1 --layer A,B", DRAWING)
O("LandXML of two parts", "scarp simplify s.xml o.obj -e 1", "holds CgPoints, a: name those", "scarp simplify s.xml o.obj -e 1 --layer CgPoints,a", LANDXML)
O("LandXML with a boundary", "scarp simplify s.xml o.obj -e 1 --layer CgPoints,a", "--boundary s.xml:a ends the mesh there",
  "scarp simplify s.xml o.obj -e 1 --layer CgPoints,a --boundary s.xml:a -q", LANDXML)
O("LandXML with several boundaries", "scarp simplify s.xml o.obj -e 1 --layer CgPoints --boundary t.xml", "name one, as in t.xml:a",
  "scarp simplify s.xml o.obj -e 1 --layer CgPoints --boundary t.xml:a -q",
  LANDXML + "\nsed 's|</Surfaces>|<Surface name=\"b\"><Boundary><PntList2D>0 0 9 0 0 9</PntList2D></Boundary></Surface></Surfaces>|' s.xml > t.xml")
O("layers in two CRS", "scarp simplify two.gpkg o.obj -e 1 --layer a,b", "differ in their CRS: read one of them", "scarp simplify two.gpkg o.obj -e 1 --layer a", TWO_CRS)
C("degrees in CSV", "scarp simplify degrees.csv o.glb -e 5")
C("degrees in CSV with ;", "scarp simplify d.csv o.glb -e 5", "sed 's/,/;/g' degrees.csv > d.csv")
C("degrees in XYZ", "scarp simplify d.xyz o.glb -e 5 --columns enz", make="sed 1d degrees.csv | tr , ' ' > d.xyz")
C("degrees in TXT with blanks", "scarp simplify d.txt o.glb -e 5 --columns enz", make="sed 1d degrees.csv | sed 's/,/   /g' > d.txt")
C("degrees without header", "scarp simplify d.csv o.glb -e 5 --columns enz", make="sed 1d degrees.csv > d.csv")
C("heights in feet without a CRS", "scarp simplify p.csv o.glb -e 1", "sed 1s/z/elev_ft/ plain.csv > p.csv", {"EPSG:CODE": "EPSG:32632"},
  says="stay as they are, while heights become metres")
C("CSV and --crs", "scarp simplify plain.csv o.glb -e 1 --crs EPSG:32633", "", {"EPSG:CODE": "EPSG:32632"})
C("points without CRS", "scarp simplify p.gpkg o.glb -e 1 --crs EPSG:32633", "ogr2ogr -oo X_POSSIBLE_NAMES=x -oo Y_POSSIBLE_NAMES=y -oo Z_POSSIBLE_NAMES=z p.gpkg plain.csv", {"EPSG:CODE": "EPSG:32632"})
C("contours as polygons", "scarp simplify lake.geojson o.glb -e 1", then="scarp simplify NEW.gpkg o.glb -e 1 --z-field elev")
C("a polygon among points", "scarp simplify p.geojson o.glb -e 1", """printf '{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"elev":1},"geometry":{"type":"Point","coordinates":[0,0]}},{"type":"Feature","properties":{"elev":2},"geometry":{"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,0]]]}}]}' > p.geojson""",
  then="scarp simplify NEW.gpkg o.glb -e 1 --z-field elev")
C("entities", "scarp simplify dem.tif o.glb -e 20 --breaklines l.gml",
  "ogr2ogr -f GML l.gml stream.geojson; sed -i '1a <!DOCTYPE x [<!ENTITY a \"b\">]>' l.gml; rm -f l.xsd")
C("a closed line as lake", "scarp simplify dem.tif o.glb -e 20 --water closed.geojson", "", {"FILE": "closed.geojson"}, then="scarp simplify dem.tif o.glb -e 20 --water NEW.gpkg")
O("a stream as lake", "scarp simplify dem.tif o.glb -e 20 --water stream.geojson", "--rivers takes lines", "scarp simplify dem.tif o.glb -e 20 --rivers stream.geojson")
O("a stream as lake of tiles", "scarp tile dem.tif g -e 20 --zoom 9 --vertical egm96 --water stream.geojson", "--rivers takes lines", "scarp tile dem.tif g -e 20 --zoom 9 --vertical egm96 --rivers stream.geojson")

LEFT = " && scarp simplify p.geojson o.glb -e 1 --nodata nan --overwrite"
O("bays of points", "scarp simplify bay.csv o.glb -e 1", "--boundary concave:[0-9]+ ends the mesh at the points", "scarp simplify bay.csv o.glb -e 1 --boundary concave:$(scarp simplify bay.csv p.glb -e 1 2>&1 | grep -o 'concave:[0-9]*' | cut -d: -f2)",
  "awk 'BEGIN { srand(1); print \"x,y,z\"; for (i = 0; i < 1500; ++i) { x = rand() * 100; y = rand() * 100; if (x < 30 || y < 30 || y > 70) print x \",\" y \",\" x / 9 + 3 * sin(y / 9) } }' > bay.csv")
NEAR_LAKE = ("awk 'BEGIN { srand(1); print \"x,y,z\"; for (i = 0; i < 300; i++) printf \"%.5f,%.5f,%.1f\\n\", -84.33 + rand() * 0.03, 36.33 + rand() * 0.03, "
             "300 + 9 * rand() }' > p.csv; echo EPSG:4326 > p.prj; ")
C("a tolerance of points in another CRS", "scarp simplify p.csv o.glb -e 20 --tolerance utm.tif", NEAR_LAKE)
O("a region of points alone", "scarp simplify p.csv o.glb --roi lake.geojson=1", "needs --max-error, the error of all others",
  "scarp simplify p.csv o.glb -e 5 --roi lake.geojson=1", NEAR_LAKE)
O("no height attribute", "scarp simplify p.geojson o.glb -e 1", "name the one that holds heights with --z-field", "scarp simplify p.geojson o.glb -e 1 --z-field up", points({}, {}))
O("an empty height", "scarp simplify p.geojson o.glb -e 1", "name another with --z-field", "scarp simplify p.geojson o.glb -e 1 --z-field up" + LEFT, points({"h": None}, {"h": 1}))
O("a height in words", "scarp simplify p.geojson o.glb -e 1", "name another with --z-field", "scarp simplify p.geojson o.glb -e 1 --z-field up" + LEFT, points({"h": "a"}, {"h": "1"}))
O("some heights", "scarp simplify p.geojson o.glb -e 1", "name an attribute with --z-field", "scarp simplify p.geojson o.glb -e 1 --z-field up", points({"z": [7]}, {}))
O("zeros beside an attribute", "scarp simplify p.geojson o.glb -e 1", "is 0 everywhere, so the heights are those of the attribute h: --z-field names another", "scarp simplify p.geojson o.glb -e 1 --z-field up", points({"z": [0]}, {"h": 2}))
O("two attributes", "scarp simplify p.geojson o.glb -e 1", "of the attribute elev, not of h: --z-field names another", "scarp simplify p.geojson o.glb -e 1 --z-field h", points({}, {"h": 1, "elev": 4}))
O("zeros alone", "scarp info p.geojson", r"name it with --z-field \(up", "scarp simplify p.geojson o.glb -e 1 --z-field up", points({"z": [0]}, {"k": 2}) + "sed -i 's/\\(\"coordinates\": \\[[0-9]*, [0-9]*\\)\\]/\\1, 0]/g' p.geojson")
O("no number in space", "scarp info p.geojson", "leave out all points without a height with --nodata nan", "scarp info p.geojson --nodata nan", points({"z": [7]}, {"k": 2}) + "sed -i 's/\\(\"coordinates\": \\[[0-9]*, [0-9]*\\)\\]/\\1, 5]/g; s/, 7\\]/, 1e999]/' p.geojson")
O("columns of what is no text", "scarp info p.geojson --columns xyz", "--z-field names an attribute", "scarp info p.geojson --z-field up", points({}, {"h": 1}))
P = "scarp simplify p.csv o.glb -e 1"
XYZ = "%s,0,0,1\\n%s,90,10,2\\n%s,0,90,3\\n%s,90,90,5\\n" % tuple("1234")
for name, options, says, then, text in (
    ("a column twice", " --columns xxz", "names two columns x: name each once", " --columns xyz", "1,2,3\\n9,2,3\\n4,9,3\\n"),
    ("a column too few", " --columns xz", "name all three, such as easting,northing,height", " --columns easting,northing,height", "1,2,3\\n9,2,3\\n4,9,3\\n"),
    ("a height is missing", "", "--nodata nan leaves out all points", " --nodata nan", "x,y,z\\n0,0,1\\n90,0,2\\n0,90,\\n90,90,5\\n"),
    ("numbers of points", "", "give --columns penz or --columns pnez", " --columns penz && " + P + " --columns pnez --overwrite", XYZ),
    ("degrees in two orders", "", "give --columns enz or --columns nez", " --columns nez", "8.1,46.1,500\\n8.2,46.1,600\\n8.1,46.2,700\\n8.2,46.2,650\\n"),
    ("x to the north", "", "name the columns with --columns -nez", " --columns -nez", "id,x,y,h\\n1,4000000,500000,1\\n2,4000000,500090,2\\n3,4000090,500000,3\\n"),
    ("the northing before the easting", "", "--columns penz reads them the other way round", " --columns penz", "1,4000000,500000,1\\n2,4000000,500090,2\\n3,4000090,500000,3\\n"),
    ("no column of heights", "", "such as --columns number,easting,northing,height", " --columns code,height,easting,northing", "A,5,4000000,500000\\nB,6,4000000,500090\\nC,7,4000090,500000\\n"),
    ("no column z", "", "--z-field names another, and --columns names columns", " --z-field depth && " + P + " --columns easting,northing,height --overwrite", "x,y,depth\\n0,0,1\\n90,0,2\\n0,90,3\\n"),
    ("no names of columns", " --z-field h", "or name them with --columns", " --columns xyz", "0,0,1\\n90,0,2\\n0,90,3\\n"),
    ("two columns of heights", "", "--z-field 'Height m' reads the others", " --z-field 'Height m'", "x,y,z,Height m\\n0,0,1,7\\n90,0,2,8\\n0,90,3,9\\n"),
    ("a column of zeros", "", "so those of 'height' count: --z-field names another", " --z-field z", "x,y,z,height\\n0,0,0,7\\n90,0,0,8\\n0,90,0,9\\n"),
    ("heights of -9999", "", "--nodata -9999 leaves it out", " --nodata -9999", "x,y,z\\n0,0,400\\n90,0,402\\n0,90,403\\n90,90,-9999\\n40,50,401\\n"),
):
    O(name, P + options, says, P + then, f"printf '{text}' > p.csv")
O("a column of heights", "scarp simplify c.csv o.glb -e 1", "--z-field names another", "scarp simplify c.csv o.glb -e 1 --z-field up", "sed 1s/z/up/ plain.csv > c.csv")
O("an option of points", "scarp simplify dem.tif o.glb -e 20 --layer a", "--points reads it as points", "scarp simplify p.gpkg o.glb -e 20 --points --layer a", "ogr2ogr -nln a -oo X_POSSIBLE_NAMES=x -oo Y_POSSIBLE_NAMES=y -oo Z_POSSIBLE_NAMES=z p.gpkg plain.csv")
O("an option of points, info", "scarp info dem.tif --layer a", "omit it, or give --points", "scarp info dem.tif")
O("a raster by pipe", "scarp simplify - o.glb -e 1 < plain.csv", "with --points as points", "scarp simplify - o.glb -e 1 --points < plain.csv")
O("vector data", "scarp info l.json", "--points reads it", "scarp info l.json --points", """printf '{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"h":5},"geometry":{"type":"Point","coordinates":[0,0]}},{"type":"Feature","properties":{"h":5},"geometry":{"type":"Point","coordinates":[0,9]}},{"type":"Feature","properties":{"h":5},"geometry":{"type":"Point","coordinates":[9,9]}}]}' > l.json""")

# Units.
FEET_ACROSS = "gdal_translate -q -a_srs EPSG:2264 -a_ullr 2000000 700000 2012000 690000 dem.tif ft.tif"
O("heights far too large", "scarp tile utm.tif g --grid local -e 20 --vertical ellipsoid --z-scale 1e6", "Else give --z-scale", "scarp tile utm.tif g --grid local -e 20 --vertical ellipsoid --z-scale 1")

SIMPLIFY = "scarp simplify dem.tif "
ACROSS = "gdal_translate -q -a_srs EPSG:2264 -a_ullr 1500000 701380 1501800 700000 dem.tif plane.tif"
O("GLB in feet", "scarp simplify plane.tif o.glb -e 20 --crs source", "leave --crs out, for metres around the raster's centre, or choose a CRS in metres",
  "scarp simplify plane.tif o.glb -e 20 && scarp simplify plane.tif o.glb -e 20 --crs EPSG:32617 --overwrite", ACROSS)
O("a goal in feet", SIMPLIFY + "o.obj -e 20ft", "--z-unit names another", SIMPLIFY + "o.obj -e 20ft --z-unit m")
C("feet without a CRS", "scarp simplify 'no crs.vrt' o.glb -e 20", "gdal_translate -q -a_ullr 740000 4020000 743600 4016760 none.tif a.tif; " + unit("a.tif", "no crs.vrt", "ft"), {"EPSG:CODE": "EPSG:32616"}, says="x and y have no CRS and stay")

# Options that require or exclude another.
for name, given, says, then in (
    ("lods in one", "o.glb -e 20 --lods-in-one", "needs --lods", "o.glb -e 20 --lods 2 --lods-in-one"),
    ("soft breaklines", "o.glb -e 20 --soft-breaklines", "needs --breaklines", "o.glb -e 20 --soft-breaklines --breaklines stream.geojson"),
    ("percentile", "o.glb -e 20 --water-percentile 5", "needs --water", "o.glb -e 20 --water-percentile 5 --water lake.geojson"),
    ("inset", "o.glb -e 20 --inset 1", "needs --cutline", "o.glb -e 20 --inset 1 --cutline lake.geojson"),
    ("normal map", "o.glb -e 20 --drape-size 64", "needs --drape", "o.glb -e 20 --drape-size 64 --drape rgb.tif"),
    ("fill distance", "o.glb -e 20 --fill-distance 5", "needs --nodata-policy fill", "o.glb -e 20 --fill-distance 5 --nodata-policy fill"),
    ("background", "o.glb -e 20 --background 5", "needs --nodata-policy background", "o.glb -e 20 --background 5 --nodata-policy background"),
    ("background value", "o.glb -e 20 --nodata-policy background", "needs --background", "o.glb -e 20 --nodata-policy background --background 5"),
    ("kept ridges", "o.glb -e 20 --keep-ridges", "needs --ridges", "o.glb -e 20 --keep-ridges --ridges 20"),
    ("material field", "o.2dm -e 20 --material-field elev", "needs --materials", "o.2dm -e 20 --material-field elev --materials lake.geojson"),
    ("falloff", "o.glb -e 20 --falloff 5", "needs --roi", "o.glb -e 20 --falloff 500 --roi lake.geojson=5"),
    ("texture weight", "o.glb -e 20 --texture-weight 0.5", "needs --texture", "o.glb -t 500 --texture-weight 0.5 --texture byte.tif"),
    ("channel weights", "o.glb -t 500 --channel-weights 1", "needs --texture or --image", "o.glb -t 500 --channel-weights 1 --texture byte.tif"),
    ("edge score", "o.glb -e 20 --shape-threshold 0.5", "needs --edges data", "o.glb -e 20 --shape-threshold 0.5 --edges data --edge-score abn"),
    ("walls of a budget", "o.glb --tolerance byte.tif --cliff 50", "needs --max-error", "o.glb -e 20 --cliff 50"),
    ("a split", "o.stl -e 20 --split 2x2", "--solid size=120mm", "o.stl -e 20 --split 2x2 --solid size=120mm"),
    ("an error on a print", "o.stl -e 0.1mm", "--solid size=120mm", "o.stl -e 0.1mm --solid size=120mm"),
    ("thickness on a print", "o.stl -e 20 --solid thickness=3mm", "--solid size=120mm", "o.stl -e 20 --solid thickness=3mm,size=120mm"),
    ("a size alone", "o.stl -e 20 --solid 120mm", "give size=120mm", "o.stl -e 20 --solid size=120mm"),
    ("a size without unit", "o.stl -e 20 --solid size=120", "size=120mm says so", "o.stl -e 20 --solid size=120mm"),
    ("no closed solid", "o.3mf -e 20", "--solid size=120mm", "o.3mf -e 20 --solid size=120mm"),
    ("a print as GLB", "o.glb -e 20 --solid size=120mm", "or --base for a solid", "o.glb -e 20 --base 0"),
    ("standard output", "- -e 20", "give --of FORMAT, one of glb", "- --of glb -e 20 > o.glb"),
    ("no format", "o.abc -e 20", "or --of FORMAT", "o.abc -e 20 --of ply"),
    ("an existing file", "mesh.glb -e 20", "--overwrite replaces it", "mesh.glb -e 20 --overwrite"),
    ("many lods", "o.glb -t 500 --lods 2", "--lods", "o.glb -e 20 --lods 2"),
    ("an unknown option", "o.glb --max-eror 20", "did you mean --max-error", "o.glb --max-error 20"),
    ("an output by -o", "-e 20 -o o.glb", "scarp simplify INPUT OUTPUT", "o.glb -e 20"),
    ("a CRS of the input", "o.glb -e 20 -a_srs EPSG:4326", "gdal_translate -a_srs EPSG:CODE FILE NEW.tif gives it another", "o.glb -e 20"),
    ("verbose", "o.glb -e 20 -v", "--timing tells", "o.glb -e 20 --timing"),
    ("a frame of a raster", "o.tif -e 20 --crs EPSG:32616", "lies on the raster's own grid, whatever --crs is", "o.tif -e 20"),
    ("a stream across hills", "o.glb -e 20 --rivers stream.geojson", "to --breaklines, with --breaklines soft, which cuts nothing", "o.glb -e 20 --breaklines stream.geojson,soft"),
    ("lines in the air", "o.glb -e 20 --breaklines stream.geojson --breakline-z elev", "--breaklines soft gives lines the heights", "o.glb -e 20 --breaklines stream.geojson,soft"),
    ("short edges", "o.glb -e 2 --min-edge 400", "a larger max error leave fewer", "o.glb -e 1000 --min-edge 1"),
    ("small angles", "o.glb -e 2 --min-angle 30 --breaklines closed.geojson", "a larger max error leave fewer", "o.glb -e 1000 --min-angle 1"),
    ("contours wanted", "o.glb -e 20 --contours 5", "contour lines are an input", "o.glb -e 20"),
):
    O(name, SIMPLIFY + given, says, SIMPLIFY + then)
O("lines at 0", SIMPLIFY + "o.glb -e 20 --breaklines flat.geojson", "--breaklines z names an attribute", SIMPLIFY + "o.glb -e 300 --breaklines flat.geojson,z=elev", "sed 's/\\(36[.][0-9]*\\)]/\\1,0]/g' stream.geojson > flat.geojson")
O("a file made meanwhile", SIMPLIFY.replace("dem.tif", "pipe") + "o.glb -e 1 & { echo mine > o.glb; cat land.pgm; } > pipe; wait $!", "o.glb exists; use --overwrite", "echo mine > o.glb; scarp simplify land.pgm o.glb -e 1 --overwrite",
  "mkfifo pipe; scarp generate fractal 40 36 land.pgm -q")
C("a file without a command", "scarp dem.tif", "", {"OUTPUT": "o.glb"})
C("no goal", "scarp simplify dem.tif o.glb")
O("the format of a synthetic raster", "scarp generate smooth 9 9 o.abc", "or give --of", "scarp generate smooth 9 9 o.abc --of tif")

# Tiles.
O("no datum", "scarp tile dem.tif g -e 20 --zoom 9", "give --vertical egm96", "scarp tile dem.tif g -e 20 --zoom 9 --vertical egm96")
O("no datum of another planet", "scarp tile dem.tif g -e 20 --zoom 9 --ellipsoid 3396190,3376200", "give --vertical ellipsoid", "scarp tile dem.tif g -e 20 --zoom 9 --ellipsoid 3396190,3376200 --vertical ellipsoid")
O("an ellipsoid of no place", "scarp tile none.tif g -e 1 --ellipsoid 3396190,3376200", "leave --ellipsoid out", "scarp tile none.tif g -e 1")
O("a datum of no place", "scarp tile none.tif g -e 1 --vertical egm96", "leave --vertical and --geoid out", "scarp tile none.tif g -e 1")
WET = "scarp tile dem.tif g -e 20 --zoom 9 --vertical egm96 --watermask --water lake.geojson --water-percentile 5"
O("a mask of water", "scarp tile dem.tif g -e 20 --zoom 9 --vertical egm96 --watermask", "needs --water", WET)
O("a percentile of tiles", "scarp tile dem.tif g -e 20 --zoom 9 --vertical egm96 --water-percentile 5", "needs --water", WET)
FLAT = "scarp tile utm.tif g --grid local -e 20 --vertical ellipsoid"
O("a format of images", "scarp tile dem.tif g --of 3dtiles -e 20 --zoom 9 --vertical egm96 --drape-format png", "needs --drape", "scarp tile dem.tif g --of 3dtiles -e 20 --zoom 9 --vertical egm96 --drape-format png --drape rgb.tif")
O("a set that is there", FLAT, "or --overwrite", FLAT + " --overwrite", FLAT + " -q")
O("planets", "scarp tile dem.tif mars.tif g -e 20 --zoom 9 --vertical ellipsoid", "or --ellipsoid", "scarp tile dem.tif g -e 20 --zoom 9 --vertical ellipsoid", "gdal_translate -q -a_srs '+proj=longlat +a=3396190 +b=3376200' east.tif mars.tif")

# The rest of the tiles' commands.
PLAN = "scarp tile plan utm.tif plan.json --grid local -e 20 --cells 16 --vertical ellipsoid"
O("the next commands of a plan", PLAN, "next: scarp tile run plan.json --shard 1/1.* then scarp tile finish plan.json OUTPUT", PLAN + " -q && scarp tile run plan.json --shard 1/1 -q && scarp tile finish plan.json g")
O("a damaged part", "scarp tile finish plan.json g", r"is damaged: delete it, and make its blocks again \(scarp tile run PLAN\)", "rm plan.parts/*.part; scarp tile run plan.json -q; scarp tile finish plan.json g",
  PLAN + " -q; scarp tile run plan.json -q; for part in plan.parts/*.part; do printf damage | dd of=$part bs=1 seek=$(($(stat -c %s $part) / 2)) conv=notrunc 2> /dev/null; done")
O("what a plan has decided", "scarp tile plan utm.tif later.json --changed-since plan.json -e 10", "--max-error does not go with --changed-since", "scarp tile plan utm.tif later.json --changed-since plan.json", PLAN + " -q")
C("missing parts", "scarp tile finish plan.json g", PLAN + " -q; mkdir -p plan.parts", {"PLAN": "plan.json"})
C("no plan", "scarp tile run mesh.obj", "", {"RASTER": "dem.tif --vertical egm96"})
O("3D Tiles as they are asked for", "scarp serve plan.json --port 0", "scarp tile RASTER OUTPUT --of 3dtiles", "scarp tile utm.tif g --of 3dtiles --grid local --vertical ellipsoid -e 20", PLAN + " -q")
O("quantized-mesh on a plane", "scarp tile utm.tif g --grid local --of qm -e 20 --vertical ellipsoid", "--of 3dtiles holds a plane", "scarp tile utm.tif g --grid local --of 3dtiles -e 20 --vertical ellipsoid")
O("a plane too large", "scarp tile large.tif g --grid local -e 200 --vertical ellipsoid", "take --grid geographic", "scarp tile large.tif g2 --grid geographic -e 200 --vertical ellipsoid", "gdal_translate -q -a_srs EPSG:32616 -a_ullr 240000 5020000 1240000 4020000 dem.tif large.tif")
O("heights on small cells", "scarp tile none.tif g -e 1 --cell-size 1e-7", "are no land: .* Else give --z-scale", "scarp tile none.tif g -e 1e-7 --cell-size 1e-7 --z-scale 1e-6")
O("feet across", "scarp tile ft.tif g -e 20 --zoom 9 --vertical egm96", "--z-unit m says that they are metres", "scarp tile ft.tif g -e 20 --zoom 9 --vertical egm96 --z-unit m", FEET_ACROSS)
O("feet across, in space", "scarp simplify ft.tif o.glb -e 20 --crs enu", "--z-unit m says that they are metres", "scarp simplify ft.tif o.glb -e 20 --crs enu --z-unit m", FEET_ACROSS)
O("feet up", "scarp simplify feet.vrt o.obj -e 20 --crs EPSG:32616", "--z-scale 0.3048 makes them one unit", "scarp simplify feet.vrt o.obj -e 20 --crs EPSG:32616 --z-scale 0.3048", unit("dem.tif", "feet.vrt", "ft"))
O("a port in use", "scarp serve plan.json --port $(cat port)", "by --port, or 0 for any", "timeout 2 scarp serve plan.json --port 0; [ $? = 124 ]",
  "scarp tile plan dem.tif plan.json -e 20 --zoom 9 --cells 16 --vertical egm96 -q; python3 -c \"import socket,time; s=socket.socket(); s.bind(('127.0.0.1',0)); s.listen(); print(s.getsockname()[1],flush=True); time.sleep(20)\" > port 2> /dev/null & until [ -s port ]; do sleep 0.05; done")

# Space, prints, messages of measure and view.
O("a pole in space", "scarp simplify pole.tif o.glb -e 20 --crs enu", "with --te", "scarp simplify pole.tif o.glb -e 20 --crs enu --te 1 80 30 85", "gdal_translate -q -a_srs EPSG:4326 -a_ullr 0 100 40 80 dem.tif pole.tif")
O("half the earth in space", "scarp simplify wide.tif o.glb -e 20 --crs EPSG:4978", "cut that off with --te", "scarp simplify wide.tif o.glb -e 20 --crs EPSG:4978 --te 0 65 40 80", "gdal_translate -q -a_srs EPSG:4326 -a_ullr -170 89 170 62 dem.tif wide.tif")
O("far from the middle in space", "scarp simplify wide.tif o.glb -e 20 --crs enu", "take it in parts with --te", "scarp simplify wide.tif o.glb -e 20 --crs enu --te 0 -10 40 10", "gdal_translate -q -a_srs EPSG:4326 -a_ullr -80 30 80 -30 dem.tif wide.tif")
O("a flat print", "scarp simplify dem.tif o.stl -e 20 --solid size=120mm", "--solid exaggerate=", "scarp simplify dem.tif o.stl -e 20 --solid size=120mm,exaggerate=$(scarp simplify dem.tif p.stl -e 20 --solid size=120mm | grep -o 'exaggerate=[0-9.]*' | cut -d= -f2)", "gdal_translate -q -scale 0 1000 0 100 dem.tif a.tif; mv a.tif dem.tif")
O("a split print in a bent grid", "scarp simplify dem.tif o.stl -e 20 --solid size=120mm --split 2x2 --crs EPSG:32616", "omit it, or choose local", "scarp simplify dem.tif o.stl -e 20 --solid size=120mm --split 2x2 --crs local")
O("a base of what is no mesh", "scarp simplify dem.tif o.svg -e 20 --base 0", "choose a mesh format", "scarp simplify dem.tif o.ply -e 20 --base 0")
O("a mesh in another frame", "scarp measure dem.tif mesh.obj --crs EPSG:32616", "--crs overrides it|give the CRS it was made in \\(--crs\\)", "scarp measure dem.tif mesh.obj --crs source")
O("a mesh that names its CRS", "scarp measure d.asc far.obj", "--crs overrides it", "scarp measure d.asc far.obj --crs source || [ $? = 3 ]", ASC + "; scarp simplify dem.tif far.obj -e 20 -q --crs EPSG:32616")
O("a mesh of another CRS over points", "scarp measure plain.csv far.obj --points", "--crs overrides it|or give --crs source", "scarp measure plain.csv far.obj --points --crs source || [ $? = 3 ]", "scarp simplify dem.tif far.obj -e 20 -q --crs EPSG:32616")
O("a mesh of a grid over points", "scarp measure plain.csv grid.obj --points", "or give --crs source", "scarp measure plain.csv grid.obj --points --crs source || [ $? = 3 ]", "scarp simplify none.tif grid.obj -e 1 -q --crs grid")
C("a raster in place of a surface", "scarp measure dem.tif mesh.glb --volume", then="scarp measure dem.tif.glb mesh.glb --volume")
O("a surface in degrees", "scarp measure mesh.obj level=400 --volume", "make it with --crs local", "scarp simplify dem.tif l.obj -e 20 --crs local && scarp measure l.obj level=400 --volume")
O("a surface in space", "scarp measure level=400 enu.glb --volume", "make it with --crs local", "scarp simplify dem.tif l.glb -e 20 --crs local && scarp measure level=400 l.glb --volume", "scarp simplify dem.tif enu.glb -e 20 -q --crs enu")
O("surfaces in two CRSs", "scarp measure mesh.glb far.obj --volume", "make both with one --crs", "scarp simplify dem.tif l.obj -e 20 --crs EPSG:32616 && scarp measure l.obj far.obj --volume", "scarp simplify dem.tif far.obj -e 20 -q --crs EPSG:32616")
O("a cutline by cells", "scarp simplify dem.tif o.glb -e 20 --cutline small.geojson --mask-outside", "omit --cutline whole-cells", "scarp simplify dem.tif o.glb -e 20 --cutline small.geojson", "sed 's/-84.318/-84.3178/g; s/-84.310/-84.3172/g' lake.geojson > small.geojson")
O("a cutline with streaming", "scarp simplify dem.tif o.glb -e 20 --cutline lake.geojson --crs EPSG:32616", "--cutline whole-cells cuts at cells", "scarp simplify dem.tif o.glb -e 20 --cutline lake.geojson,whole-cells --crs EPSG:32616")
O("ridges without a bound", "scarp simplify dem.tif o.glb --tolerance m.tif --ridges 30", "needs --max-error", "scarp simplify dem.tif o.glb -e 20 --ridges 30", "gdal_translate -q -ot Float32 dem.tif m.tif")
O("too little memory", "scarp simplify big.vrt o.glb -e 300 --nodata-policy fill --memory 100M", "leave --nodata-policy out|leave --memory out", "scarp simplify big.vrt o.glb -e 300 --memory 100M", "gdal_translate -q -of VRT -outsize 4000 3000 dem.tif big.vrt")
HUGE = "scarp simplify huge.asc o.glb -e 1e37"
O("a raster that becomes too large", HUGE + " --memory 72M", "leave --memory out, or allow", HUGE,
  "{ printf 'ncols 40\\nnrows 40\\nxllcorner 0\\nyllcorner 0\\ncellsize 1\\n'; for ((k = 0; k < 800; ++k)); do echo 3e38 1e-$((k % 30)); done; } > huge.asc")
O("the size of a synthetic raster", "scarp generate smooth 9 9 a.tif -tr 1", "change the raster first", "scarp generate smooth 9 9 a.tif && gdal_translate -q -r average -outsize 5 0 a.tif b.tif")
O("the extent of a synthetic raster", "scarp generate smooth 9 9 a.tif --te 1 2 3 4", "gdal_translate -projwin|unknown", "scarp generate smooth 9 9 a.tif")

# Parts of messages from other tests, or without a remedy.
NOT_RUN = [
    "with --memory, x and y cannot become metres around the middle of all points",  # a unit test reads such a LAS file
    "filling its nodata needs all samples in memory",  # message of the library that the program's refusal of
                                                       # --nodata-policy precedes
    # Messages of view, whose page is built by npm: test_view.sh.
    "is too large for a page", "the finest level of the page is", "is not whole:", "and a page judges by a raster alone",
    "an option of a raster is given", "is a set of tiles, which is shown without a raster",
]
