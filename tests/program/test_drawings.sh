#!/bin/bash
# Points, breaklines and contours of drawings (DXF), of LandXML and of several layers.
source "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
need python3 ogr2ogr

python3 - <<'PY'
import math
height = lambda x, y: 100 + 3 * math.sin(x / 15) + 2 * math.cos(y / 20)
grid = [(5 * i + (j % 3) / 3, 5 * j + (i % 2) / 2) for i in range(20) for j in range(20)]
ridge = [(3 + 10 * k, 41 + (k % 2), height(3 + 10 * k, 41 + (k % 2)) + 1) for k in range(9)]
out = "0 SECTION 2 HEADER 9 $ACADVER 1 AC1027 9 $DWGCODEPAGE 3 ANSI_1252 0 ENDSEC 0 SECTION 2 BLOCKS 0 BLOCK 8 0 2 SPOT 70 0 10 0 20 0 30 0 3 SPOT 0 LINE 8 0 10 -1 20 0 30 0 11 1 21 0 31 0 0 ENDBLK 8 0 0 ENDSEC".split()
out += "0 SECTION 2 ENTITIES".split()
def add(*pairs): out.extend(str(value) for value in pairs)
for x, y in grid:
    add(0, "POINT", 8, "SURVEY", 10, 500000 + x, 20, 5000000 + y, 30, "%.3f" % height(x, y))
    add(0, "TEXT", 8, "SURVEY", 10, 500000 + x, 20, 5000000 + y, 30, 0, 40, 1, 1, "%.1f" % height(x, y))
add(0, "INSERT", 8, "SPOTS", 2, "SPOT", 10, 500022, 20, 5000022, 30, 109.5)
add(0, "LWPOLYLINE", 100, "AcDbEntity", 8, "CONTOURS", 100, "AcDbPolyline", 90, 3, 70, 0, 38, 102.5)
for x, y in (3, 3), (13, 7), (23, 4): add(10, 500000 + x, 20, 5000000 + y)
add(0, "POLYLINE", 8, "RIDGE", 66, 1, 70, 8, 10, 0, 20, 0, 30, 0)
for x, y, z in ridge: add(0, "VERTEX", 8, "RIDGE", 70, 32, 10, 500000 + x, 20, 5000000 + y, 30, "%.3f" % z)
add(0, "SEQEND", 8, "RIDGE", 0, "CIRCLE", 8, "BÄUME", 10, 500070, 20, 5000072, 30, 0, 40, 2)
add(0, "TEXT", 8, "TITLE", 10, 500000, 20, 5000000, 30, 0, 40, 1, 1, "Site plan", 0, "ENDSEC", 0, "EOF")
open("site.dxf", "w").write("\n".join(out) + "\n")
open("points.csv", "w").write("x,y,z\n" + "".join("%s,%s,%.3f\n" % (500000 + x, 5000000 + y, height(x, y)) for x, y in grid))

three = lambda points: " ".join("%s %s %.3f" % (5000000 + y, 500000 + x, z) for x, y, z in points)
xml = lambda units, body: '<?xml version="1.0"?>\n<LandXML xmlns="http://www.landxml.org/schema/LandXML-1.2">%s\n%s</LandXML>\n' % (units, body)
metres = '<Units><Metric linearUnit="meter"/></Units><CoordinateSystem epsgCode="32633"/>'
feet = '<Units><Imperial linearUnit="USSurveyFoot"/></Units>'
survey = "<CgPoints>" + "".join('<CgPoint name="%d" code="GND">%s</CgPoint>\n' % (k, three([(x, y, height(x, y))])) for k, (x, y) in enumerate(grid))
survey += '<CgPoint name="flat">5000000 500000</CgPoint><CgPoint name="again" pntRef="1"/></CgPoints>'
surface = '<Surfaces><Surface name="EG"><SourceData><DataPoints><PntList3D>%s</PntList3D></DataPoints>' % three([(x, y, height(x, y)) for x, y in grid])
surface += '<Breaklines><Breakline brkType="standard"><PntList3D>%s</PntList3D></Breakline></Breaklines>' % three(ridge)
surface += '<Contours><Contour elev="102.5"><PntList2D>5000003 500003 5000007 500013 5000004 500023</PntList2D></Contour></Contours>%s</SourceData></Surface></Surfaces>'
open("survey.xml", "w").write(xml(metres, survey))
open("feet.xml", "w").write(xml(feet, survey))
open("surface.xml", "w").write(xml(metres, surface % ""))
bounded = '<Boundaries><Boundary bndType="outer"><PntList2D>5000000 500000 5000090 500000 5000090 500090</PntList2D></Boundary></Boundaries>'
open("both.xml", "w").write(xml(metres, survey + surface % bounded))
open("doctype.xml", "w").write(xml(metres, survey).replace("<LandXML", "<!DOCTYPE LandXML><LandXML", 1))
open("deep.xml", "w").write(xml(metres.replace("/>", ' elevationUnit="feet"/>', 1), survey))
open("mixed.xml", "w").write(xml(metres.replace("meter", "foot"), survey))
watershed = '<Surfaces><Surface name="EG"><SourceData><DataPoints><PntList3D>%s</PntList3D></DataPoints></SourceData><Watersheds><Watershed name="w"><PntList3D>0 0 9 1 1 9 2 2 9</PntList3D></Watershed></Watersheds></Surface></Surfaces>'
open("basin.xml", "w").write(xml(metres, watershed % three([(x, y, height(x, y)) for x, y in grid])))
open("torn.xml", "w").write(xml(metres, surface % "")[:2000])
open("odd.xml", "w").write(xml(metres, surface % "").replace("</PntList3D></Breakline>", " 7</PntList3D></Breakline>"))

# Boundaries: northing first. A void of two outer boundaries crosses one of them, an island lies in it; a fence is named by its points.
ring = lambda west, south, east, north: [(west, south), (east, south), (east, north), (west, north)]
two = lambda places: " ".join("%s %s" % (5000000 + y, 500000 + x) for x, y in places)
boundary = lambda kind, places: '<Boundary bndType="%s"><PntList2D>%s</PntList2D></Boundary>' % (kind, two(places))
deep = lambda kind, places: '<Boundary bndType="%s"><PntList3D>%s</PntList3D></Boundary>' % (kind, three([(x, y, 7) for x, y in places]))
bounds = lambda name, *b: '<Surface name="%s"><SourceData><Boundaries>%s</Boundaries></SourceData></Surface>' % (name, "".join(b))
outer, void, island = ring(10, 10, 60, 85), ring(30, 30, 70, 60), ring(40, 40, 50, 50)
surfaces = lambda *parts: "<Surfaces>%s</Surfaces>" % "".join(parts)
places = lambda name, *b: open(name, "w").write(xml(metres, surfaces(*b)))
places("void.xml", bounds("site", boundary("island", island), boundary("void", void), deep("outer", outer + outer[:1])))
places("sites.xml", bounds("A", boundary("outer", outer)), bounds("B", boundary("outer", island)))
places("hollow.xml", bounds("A", boundary("void", void)))
places("strange.xml", bounds("A", boundary("moat", outer)))
places("empty.xml", bounds("A", '<Boundary bndType="outer"/>'))
open("zone.xml", "w").write(xml(metres.replace("32633", "32632"), surfaces(bounds("A", boundary("outer", outer)))))
open("yards.xml", "w").write(xml(feet, surfaces(bounds("A", boundary("outer", outer)))))
named = "".join('<CgPoint pntRef="%s"/>' % name for name in "a234")
fence = '<CgPoints><CgPoint name="a">%s</CgPoint></CgPoints>' % two(outer[:1]) + surfaces(
    '<Surface name="site"><Boundary bndType="outer">%s</Boundary><Pnts>%s</Pnts></Surface>'
    % (named, "".join('<P id="%d">%s 0</P>' % (k + 1, two([p])) for k, p in enumerate(outer))))
open("fence.xml", "w").write(xml(metres, fence))
open("lost.xml", "w").write(xml(metres, fence.replace('pntRef="4"', 'pntRef="5"')))
bitten = [(10, 10), (60, 10), (60, 30), (30, 30), (30, 60), (60, 60), (60, 85), (10, 85)]
polygon = lambda places: '{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[%s]}}' % (
    [[500000 + x, 5000000 + y] for x, y in places + places[:1]])
for name, parts in ("bitten", [bitten, island]), ("outer", [outer]):
    open(name + ".geojson", "w").write('{"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::32633"}},"features":[%s]}'
        % ",".join(map(polygon, parts)))
PY

# A drawing: the layers that are the terrain have to be named. Texts are no points, and a symbol is one.
refuses 2 "site.dxf: a drawing with the layers BÄUME, CONTOURS, RIDGE, SPOTS, SURVEY: name those of the terrain with --layer A,B" \
  "$scarp" simplify site.dxf x.obj -e 0.1
refuses 2 "holds no layer 'TITLE', only BÄUME, CONTOURS, RIDGE, SPOTS, SURVEY" "$scarp" simplify site.dxf x.obj -e 0.1 --layer SURVEY,TITLE
succeeds "$scarp" simplify site.dxf points.obj -e 0.1 --layer SURVEY --crs source
succeeds "$scarp" simplify points.csv same.obj -e 0.1 --crs source
cmp <(grep '^[vf]' points.obj) <(grep '^[vf]' same.obj) || fail "the points of a drawing are others than those of a text"
succeeds "$scarp" simplify site.dxf site.obj -e 0.1 --layer SURVEY,RIDGE,CONTOURS,SPOTS --report site.json
[ ! -s "$logs/err" ] || fail "a drawing warns: $(cat "$logs/err")"
[ "$(json site.json input points)" = $((400 + 9 + 3 + 1)) ] || fail "points of four layers"
grep -Eq '^v .* 109.5( |$)' site.obj || fail "the symbol is no vertex"
succeeds "$scarp" measure site.dxf site.obj --layer SURVEY,RIDGE,CONTOURS,SPOTS --fail-above 0.1 -q
succeeds "$scarp" simplify site.dxf site.glb -e 0.1 --layer SURVEY,SPOTS
succeeds "$scarp" measure site.dxf site.glb --fail-above 0.1
grep -q 'points judged  *401' "$logs/out" || fail "a mesh forgets the layers of its points"
python3 - <<'PY'
lines = open("site.dxf").read().split("\n")
points = [lines[k + 4:k + 9:2] for k in range(len(lines)) if lines[k] == "POINT" and lines[k + 2] == "SURVEY"]
open("other.csv", "w").write("x,y,z\n" + "".join(",".join(point) + "\n" for point in points))
PY
succeeds "$scarp" measure other.csv site.glb --fail-above 0.1  # a file without layers
grep -q 'points judged  *400' "$logs/out" || fail "points of another file"
succeeds "$scarp" simplify site.dxf ridge.obj -e 0.1 --layer SURVEY --breaklines site.dxf:RIDGE
grep -q 'lines  *1, each a chain of edges' "$logs/out" || fail "a layer of breaklines"

# Contours with attributes and spot heights with third coordinates.
ogr2ogr -q -f GPKG map.gpkg points.csv -nln spots -oo X_POSSIBLE_NAMES=x -oo Y_POSSIBLE_NAMES=y -oo Z_POSSIBLE_NAMES=z -a_srs EPSG:32633
printf 'WKT,ELEV\n"LINESTRING (500003 5000003,500013 5000007,500023 5000004)",102.5\n' >lines.csv
ogr2ogr -q -f GPKG -append map.gpkg lines.csv -nln contours -oo GEOM_POSSIBLE_NAMES=WKT -oo AUTODETECT_TYPE=YES -oo KEEP_GEOM_COLUMNS=NO -a_srs EPSG:32633
succeeds "$scarp" simplify map.gpkg map.obj -e 0.1 --layer spots,contours
grep -q 'points  *403' "$logs/out" || fail "points of two layers"
grep -q 'read as  *spots: height: third coordinate; contours: height: attribute ELEV' "$logs/out" || fail "heights of two layers"
ogr2ogr -q -f GPKG -append map.gpkg lines.csv -nln elsewhere -oo GEOM_POSSIBLE_NAMES=WKT -oo AUTODETECT_TYPE=YES -a_srs EPSG:32632
refuses 2 "the layers spots, elsewhere differ in their CRS: read one of them with --layer" "$scarp" simplify map.gpkg x.obj -e 0.1 --layer spots,elsewhere

# LandXML: survey points, what a surface was made of, else the vertices of a TIN.
succeeds "$scarp" simplify survey.xml survey.obj -e 0.1 --crs source
grep -q 'survey.xml: points and lines that have no elevation and were left out: 1' "$logs/err" || fail "a point without elevation"
cmp <(grep '^[vf]' survey.obj) <(grep '^[vf]' same.obj) || fail "survey points are others than those of a text"
succeeds "$scarp" info feet.xml --json
grep -q "\"unit\": \"US survey foot\"" "$logs/out" || fail "feet: $(cat "$logs/out")"
succeeds "$scarp" simplify surface.xml surface.xml.obj -e 0.1
grep -q 'points  *412' "$logs/out" && grep -q 'lines  *2, each a chain' "$logs/out" || fail "source data: $(cat "$logs/out")"
refuses 2 "both.xml: holds CgPoints, EG: name those of the terrain with --layer A,B" "$scarp" simplify both.xml x.obj -e 0.1
succeeds "$scarp" simplify both.xml both.obj -e 0.1 --layer CgPoints,EG
grep -q 'points  *812' "$logs/out" && grep -q 'duplicates  *400,' "$logs/out" || fail "two parts: $(cat "$logs/out")"
refuses 2 "both.xml: holds no 'FG', only CgPoints, EG" "$scarp" simplify both.xml x.obj -e 0.1 --layer FG
succeeds "$scarp" simplify both.xml tin.xml -e 0.1 --layer EG
grep -q 'both.xml:EG is a boundary that is not applied: --boundary both.xml:EG ends the mesh there' "$logs/err" || fail "a boundary"
succeeds "$scarp" info both.xml --layer EG
cat "$logs/out" "$logs/err" | grep -q -e '--boundary both.xml:EG' || fail "a boundary in info"
succeeds "$scarp" simplify both.xml bounded.ply -e 0.1 --layer EG --boundary both.xml --report bounded.json
[ ! -s "$logs/err" ] || fail "a boundary that is applied warns: $(cat "$logs/err")"
[ "$(json bounded.json input boundary_cut points_outside)" -gt 150 ] || fail "a boundary of the surface itself"
succeeds "$scarp" measure both.xml bounded.ply --layer EG --fail-above 0.1 -q
succeeds "$scarp" measure both.xml tin.xml --layer EG --fail-above 0.1 -q
refuses 2 "tin.xml: a mesh (LandXML): give the raster or the points that it was made from" "$scarp" simplify tin.xml x.obj -e 0.1
succeeds "$scarp" simplify tin.xml again.obj -e 0.1 --points
grep -q "of the surface 'terrain' the vertices are read, not its triangles" "$logs/err" || fail "triangles are omitted without a word"
refuses 2 "odd.xml: line 3: a list of points has 28 numbers, which 3 does not divide" "$scarp" simplify odd.xml x.obj -e 0.1
refuses 2 "torn.xml: " "$scarp" simplify torn.xml x.obj -e 0.1
refuses 2 "doctype.xml: line 2: document types are not read" "$scarp" simplify doctype.xml x.obj -e 0.1
refuses 2 "mixed.xml: its unit is foot, and that of its CRS, WGS 84 / UTM zone 33N, is 1 m" "$scarp" simplify mixed.xml x.obj -e 0.1
succeeds "$scarp" info deep.xml --json
grep -q '"unit": "feet"' "$logs/out" || fail "the unit of elevations"
succeeds "$scarp" info basin.xml
grep -q 'points  *400' "$logs/out" || fail "a watershed is no terrain"
refuses 1 "--columns is for text and vector layers, and survey.xml is LandXML" "$scarp" simplify survey.xml x.obj -e 0.1 --columns xyz

# Boundaries of LandXML are polygons: the meshes are those of the same polygons in GeoJSON.
for option in --boundary --cutline; do
  for pair in fence.xml=outer sites.xml:A=outer; do
    succeeds "$scarp" simplify survey.xml one.obj -e 0.1 "$option" "${pair%=*}" --overwrite -q
    succeeds "$scarp" simplify survey.xml other.obj -e 0.1 "$option" "${pair#*=}.geojson" --overwrite -q
    cmp <(grep '^[vf]' one.obj) <(grep '^[vf]' other.obj) || fail "$pair: two meshes"
  done
done
# Voids are cut out, also where they cross an outer boundary, and islands are whole.
succeeds "$scarp" simplify survey.xml void.stl -e 0.1 --boundary void.xml --report void.json -q
succeeds "$scarp" simplify survey.xml bitten.stl -e 0.1 --boundary bitten.geojson --report bitten.json -q
for key in boundary_cut points; do [ "$(json void.json input $key)" = "$(json bitten.json input $key)" ] || fail "voids: $key"; done
holds "$(json void.json triangles) == $(json bitten.json triangles)" || fail "triangles around a void"
succeeds "$scarp" measure survey.xml void.stl --boundary void.xml --fail-above 0.1 -q
succeeds "$scarp" measure survey.xml void.stl --boundary bitten.geojson --fail-above 0.1 -q
refuses 2 "sites.xml: holds boundaries of several surfaces; name one, as in sites.xml:A: A, B" "$scarp" simplify survey.xml x.obj -e 0.1 --boundary sites.xml
refuses 2 "sites.xml has no surface 'C' with boundaries (found: A, B)" "$scarp" simplify survey.xml x.obj -e 0.1 --boundary sites.xml:C
refuses 2 "survey.xml: LandXML without boundaries" "$scarp" simplify survey.xml x.obj -e 0.1 --boundary survey.xml
refuses 2 "hollow.xml: the surface A has no outer boundary, only voids" "$scarp" simplify survey.xml x.obj -e 0.1 --boundary hollow.xml
refuses 2 "strange.xml: line 3: a boundary of the surface A is of the kind 'moat', which is not outer, void or island" \
  "$scarp" simplify survey.xml x.obj -e 0.1 --boundary strange.xml
refuses 2 "empty.xml: line 3: a boundary of the surface A has no list of points" "$scarp" simplify survey.xml x.obj -e 0.1 --boundary empty.xml
refuses 2 "refers to the point '5', which has no place" "$scarp" simplify survey.xml x.obj -e 0.1 --boundary lost.xml
refuses 2 "yards.xml: names no CRS, its unit is US survey foot, and that of the input is 1 m" "$scarp" simplify survey.xml x.obj -e 0.1 --boundary yards.xml
succeeds "$scarp" simplify feet.xml yards.obj -e 0.1 --boundary yards.xml -q
refuses 2 "no point lies within --boundary zone.xml" "$scarp" simplify survey.xml x.obj -e 0.1 --boundary zone.xml
succeeds "$scarp" simplify site.dxf lines.obj -e 0.1 --layer SURVEY --breaklines both.xml
grep -q 'both.xml: of its surfaces only the boundaries are read as lines, not the breaklines' "$logs/err" || fail "breaklines of LandXML"
echo "drawings, LandXML and several layers give their points and lines"
