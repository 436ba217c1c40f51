#!/usr/bin/env bash
# Formats for maps, hydraulics and civil engineering: those of the table whose coordinates are not local by default.
# Each file is judged, and foreign programs find exactly the triangles of our OBJ.
source "$(dirname "$0")/lib.sh"
need python3 gdalwarp ogrinfo
"$scarp" help --json > table.json
# formats_that CONDITION: the usual endings of the formats f that satisfy it
formats_that() {
  python3 -c "import json
print(*(f['endings'][0][1:] for f in json.load(open('table.json'))['formats'] if f['frame'] != 'local' and ($1)))"
}
formats=$(formats_that True)
read_formats=$(formats_that "f['read']")
degree_formats=$(formats_that "f['degrees']")
[ "$(wc -w <<< "$formats")" -ge 7 ] || fail "the table of formats is short: $formats"
# among WORD LIST
among() { [[ " $2 " = *" $1 "* ]]; }

# python_with MODULE: an interpreter with that module: the system's or a version manager's.
python_with() {
  local python
  for python in "$python_program" "$(type -P python3)"; do
    if "$python" -c "import $1" 2> "$logs/python"; then echo "$python" && return; fi
  done
  return 1
}

gdalwarp -q -t_srs EPSG:32616 -r bilinear -dstnodata -9999 -ot Float32 "$dem" utm.tif
succeeds "$scarp" simplify utm.tif utm.obj -e 20 --crs source --up z --report utm.json
succeeds "$scarp" simplify "$dem" deg.obj -e 20 --crs source --up z --report deg.json
for raster in utm deg; do
  input=$raster.tif
  [ $raster = utm ] || input=$dem
  for format in $formats; do
    options=
    if [ $raster = deg ]; then
      among $format "$degree_formats" || continue
      options="--crs source"
    fi
    succeeds "$scarp" simplify "$input" "$raster.$format" -e 20 --report r.json --overwrite $options
    [ "$(json r.json triangles)" = "$(json $raster.json triangles)" ] || fail "$raster.$format has other triangles than OBJ"
    among $format "$read_formats" || continue
    "$scarp" measure "$input" "$raster.$format" --fail-above 20 --json > judged.json 2> "$logs/err" || fail "$raster.$format breaks the promise"
    for key in triangles vertices max_error; do
      [ "$(json judged.json $key)" = "$(json $raster.json $key)" ] || fail "$raster.$format is read with another $key"
    done
  done
done
refuses 2 "writes and does not read" "$scarp" measure utm.tif utm.gpkg
for format in $formats; do
  name=$(python3 -c "import json
print(next(f['title'] if f['title'] == 'LandXML' else f['name'] for f in json.load(open('table.json'))['formats'] if '.$format' in f['endings']))")
  succeeds "$scarp" simplify utm.tif named.bin -e 20 --of "$name" --overwrite
  cmp named.bin utm.$format || fail "--of $name differs from the extension, or from the run before"
done

# Degrees: maps use them, and measure handles them; all others use local metres.
awk '$1 == "ND" && !($3 > -85 && $3 < -83 && $4 > 36 && $4 < 37) { exit 1 }' deg.2dm || fail "deg.2dm is not in degrees"
for format in $(formats_that "f['frame'] == 'metric'"); do
  succeeds "$scarp" simplify "$dem" local.$format -e 20
  succeeds "$scarp" measure "$dem" local.$format --fail-above 20
done
succeeds "$scarp" simplify "$dem" local.xml -e 20 --overwrite
grep -q 'LandXML has no degrees: the surface is in metres around' "$logs/err" || fail "no word that the surface has no place"
refuses 1 "LandXML has lengths only, and EPSG:4326 has degrees" "$scarp" simplify "$dem" out.xml -e 20 --crs source
succeeds "$scarp" simplify "$dem" there.xml -e 20 --crs EPSG:32616 -q
succeeds "$scarp" measure "$dem" there.xml --fail-above 20
succeeds "$scarp" simplify "$dem" there.gpkg -e 20 --crs EPSG:32616 -q
ogrinfo -so there.gpkg terrain | grep -q 'ID\["EPSG",32616\]' || fail "there.gpkg is not in the CRS asked for"
# Without a place the grid is used, also for maps.
printf 'P2 4 3 99\n1 2 3 4 9 8 7 6 5 5 9 5\n' > flat.pgm
for format in $formats; do succeeds "$scarp" simplify flat.pgm flat.$format -e 1; done
for format in $read_formats; do succeeds "$scarp" measure flat.pgm flat.$format --fail-above 1; done

# The same triangles, in order, at exactly the same places, counter-clockwise: by foreign readers.
cat > judge.py <<'PYTHON'
import sys


def obj(path):
    places, triangles = [], []
    for line in open(path):
        words = line.split()
        if words[:1] == ["v"]:
            places.append(tuple(float(w) for w in words[1:4]))
        elif words[:1] == ["f"]:
            triangles.append([places[int(w.split("/")[0]) - 1] for w in words[1:]])
    return places, triangles


def sms(path):
    nodes, elements = {}, []
    for line in open(path):
        card, *words = line.split()
        if card == "ND":
            nodes[int(words[0])] = tuple(float(w) for w in words[1:4])
        elif card == "E3T":
            assert int(words[0]) == len(elements) + 1 and words[4] == "1"
            elements.append([int(w) for w in words[1:4]])
    assert list(nodes) == list(range(1, len(nodes) + 1))
    return list(nodes.values()), [[nodes[n] for n in element] for element in elements]


def landxml(path):
    from xml.etree import ElementTree
    space = "{http://www.landxml.org/schema/LandXML-1.2}"
    root = ElementTree.parse(path).getroot()
    assert root.tag == space + "LandXML" and root.get("version") == "1.2" and root.get("date") and root.get("time")
    assert [child.tag[len(space):] for child in root] == ["Units", "CoordinateSystem", "Application", "Surfaces"]
    units = root.find(f"{space}Units/{space}Metric")
    for name in "areaUnit linearUnit volumeUnit temperatureUnit pressureUnit".split():
        assert units.get(name), name
    assert units.get("linearUnit") == "meter"
    crs = root.find(space + "CoordinateSystem")
    assert crs.get("epsgCode") == "32616" and crs.get("ogcWktCode").startswith("PROJCS[")
    (surface,) = root.iter(space + "Surface")
    assert [child.tag[len(space):] for child in surface] == ["Definition", "Feature"]
    definition = surface.find(space + "Definition")
    assert definition.get("surfType") == "TIN"
    points = {}
    for p in definition.find(space + "Pnts"):
        north, east, up = map(float, p.text.split())
        points[p.get("id")] = (east, north, up)
    faces = [[points[i] for i in f.text.split()] for f in definition.find(space + "Faces")]
    return list(points.values()), faces


def by_meshio(path):
    import meshio
    mesh = meshio.read(path)
    assert {cells.type for cells in mesh.cells} == {"triangle"} and str(mesh.points.dtype) == "float64"
    places = [tuple(p) for p in mesh.points.tolist()]
    return places, [[places[v] for v in corners] for cells in mesh.cells for corners in cells.data.tolist()]


def by_vtk(path):
    import vtk
    reader = vtk.vtkXMLPolyDataReader() if path.endswith("vtp") else vtk.vtkXMLUnstructuredGridReader()
    complaints = []
    reader.AddObserver("ErrorEvent", lambda *_: complaints.append(1))
    reader.SetFileName(path)
    reader.Update()
    assert not complaints and reader.CanReadFile(path)
    data = reader.GetOutput()
    assert data.GetPoints().GetDataType() == vtk.VTK_DOUBLE
    places = [data.GetPoint(k) for k in range(data.GetNumberOfPoints())]
    ids, triangles = vtk.vtkIdList(), []
    for k in range(data.GetNumberOfCells()):
        assert data.GetCellType(k) == vtk.VTK_TRIANGLE
        data.GetCellPoints(k, ids)
        triangles.append([places[ids.GetId(c)] for c in range(3)])
    return places, triangles


def by_ogr(path):
    from osgeo import gdal, ogr
    ogr.UseExceptions()
    gdal.PushErrorHandler("CPLQuietErrorHandler")  # its DXF driver has a remark on every ring that it makes of a 3DFACE
    source = ogr.Open(path)
    assert source.GetLayerCount() == 1
    layer, triangles = source.GetLayer(0), []
    if path.endswith("gpkg"):
        assert layer.GetGeomType() == ogr.wkbPolygon25D and layer.GetName() == "terrain"
        assert layer.GetSpatialRef().GetAuthorityCode(None) == ("32616" if "utm" in path else "4326")
        assert source.GetMetadataItem("command").startswith("scarp simplify")
    for feature in layer:
        geometry = feature.GetGeometryRef()
        assert geometry.GetGeometryCount() == 1
        ring = [tuple(p) for p in geometry.GetGeometryRef(0).GetPoints()]
        assert ring[0] == ring[-1]
        ring = [p for k, p in enumerate(ring[:-1]) if k == 0 or p != ring[k - 1]]
        assert len(ring) == 3
        triangles.append(ring)
    return None, triangles


def twice_area(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


reader, path, reference = sys.argv[1:]
places, triangles = globals()[reader](path)
wanted_places, wanted = obj(reference)
assert len(triangles) == len(wanted), (len(triangles), len(wanted))
assert places is None or places == wanted_places, "vertices differ"
assert triangles == wanted, "triangles differ"
assert all(twice_area(*t) > 0 for t in triangles), "a triangle is not counter-clockwise"
print(f"  {reader}, {path}: {len(triangles)} triangles, {len(wanted_places)} vertices, all exactly where OBJ has them")
PYTHON
agree() {
  local python=$1
  shift
  "$python" judge.py "$@" || fail "$* disagree"
}
agree python3 sms utm.2dm utm.obj
agree python3 sms deg.2dm deg.obj
agree python3 landxml utm.xml utm.obj
if python=$(python_with meshio); then
  known=$("$python" -c "import meshio; print(*meshio.extension_to_filetypes)")
  for format in $formats; do
    [ $format != xml ] || continue  # meshio treats .xml as DOLFIN
    among .$format "$known" || continue
    for raster in utm deg; do agree "$python" by_meshio $raster.$format $raster.obj; done
  done
else
  echo "left out: meshio (python3-meshio)"
fi
if python=$(python_with vtk); then
  for file in utm.vtu utm.vtp deg.vtp; do agree "$python" by_vtk $file ${file%.*}.obj; done
else
  echo "left out: VTK (python3-vtk9)"
fi
if python=$(python_with osgeo.ogr); then
  for file in utm.dxf deg.dxf utm.gpkg deg.gpkg; do agree "$python" by_ogr $file ${file%.*}.obj; done
else
  echo "left out: GDAL's Python (python3-gdal)"
fi

# Contents of VTK's formats besides positions.
succeeds "$scarp" simplify utm.tif n.vtu -e 20 --normals --uvs
if python=$(python_with meshio); then
  "$python" - <<'PYTHON' || fail "meshio finds other normals or places in the image"
import meshio
mesh = meshio.read("n.vtu")
normals, places = mesh.point_data["Normals"], mesh.point_data["TCoords"]
assert normals.shape == mesh.points.shape and (normals[:, 2] > 0).all()
assert abs((normals ** 2).sum(axis=1) - 1).max() < 1e-5
# East is right and north is up: the image begins at the bottom.
assert places[mesh.points[:, 0].argmax(), 0] > 0.99 and places[mesh.points[:, 1].argmax(), 1] > 0.99
PYTHON
fi
for format in $(formats_that "not f['attributes']"); do
  succeeds "$scarp" simplify utm.tif w.$format -e 100 --normals --overwrite
  grep -q 'has no place for vertex normals' "$logs/err" || fail "no word about lost normals in $format"
done
refuses 1 "GeoPackage has no place for colours" "$scarp" simplify "$dem" out.gpkg -e 20 --image

# Solids.
for format in $read_formats; do
  succeeds "$scarp" simplify utm.tif solid.$format -e 20 --base 100 --report solid.json --overwrite
  "$scarp" measure utm.tif solid.$format --fail-above 20 --json > judged.json 2> "$logs/err" || fail "the solid in $format breaks the promise"
  [ "$(json judged.json triangles)" = "$(json solid.json solid triangles)" ] || fail "the solid in $format has other triangles"
done

# The same bytes later and with other threads, once the clock shows another second than that of utm.gpkg.
until [ "$(date +%s)" -gt "$(stat -c %Y utm.gpkg)" ]; do sleep 0.1; done
for format in $formats; do
  succeeds "$scarp" simplify utm.tif later.$format -e 20 -j 1
  cmp later.$format utm.$format || fail "time or threads change $format"
done

# Damage is detected.
for format in $formats; do
  [ $format != tin ] || continue  # no end mark: a part is a smaller mesh
  for part in 3 2; do
    head -c $(($(wc -c < utm.$format) / part)) utm.$format > half.$format
    refuses 2 "half.$format is not a usable mesh" "$scarp" measure utm.tif half.$format
  done
done

# Scattered points.
printf 'x,y,z\n0,0,1\n10,0,2\n10,10,3\n0,10,4\n5,5,9\n' > survey.csv
for format in $formats; do succeeds "$scarp" simplify survey.csv survey.$format -e 0.5 -q; done
for format in $read_formats; do succeeds "$scarp" measure survey.csv survey.$format --fail-above 0.5 -q; done
echo "all formats agree"
