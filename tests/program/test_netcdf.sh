#!/usr/bin/env bash
# Coordinates of netCDF files: in degrees without a grid mapping, even, uneven, and even in Mercator.
source "$(dirname "$0")/lib.sh"
need gdal_translate gdalinfo python3
[[ $(gdalinfo --formats) = *netCDF* ]] || skip "needs GDAL with netCDF"

cat > netcdf.py <<'PY'
import math, struct
def write(path, y, x, degrees=True, float_axes=False, **of_z):
    """A file of netCDF's classic format with z(y, x)."""
    def padded(b): return b + b"\0" * (-len(b) % 4)
    def word(s): return struct.pack(">i", len(s)) + padded(s.encode())
    def attributes(a):
        return struct.pack(">ii", 12, len(a)) + b"".join(word(k) + struct.pack(">ii", 2, len(v)) + padded(v.encode()) for k, v in a.items())
    y_unit, x_unit = ("degrees_north", "degrees_east") if degrees else ("m", "m")
    names = ("latitude", "longitude") if degrees else ("projection_y_coordinate", "projection_x_coordinate")
    axis = "f" if float_axes else "d"
    z = [100 + 50 * math.sin(i / 3) + 30 * math.cos(j / 2) for i in range(len(y)) for j in range(len(x))]
    variables = [("lat", [0], {"units": y_unit, "standard_name": names[0]}, axis, y),
                 ("lon", [1], {"units": x_unit, "standard_name": names[1]}, axis, x), ("z", [0, 1], {"units": "m", **of_z}, "f", z)]
    def header(begins):
        h = b"CDF\x01\0\0\0\0" + struct.pack(">ii", 10, 2) + word("lat") + struct.pack(">i", len(y)) + word("lon") + struct.pack(">i", len(x))
        h += attributes({"Conventions": "CF-1.6"}) + struct.pack(">ii", 11, 3)
        for (name, on, about, kind, data), begin in zip(variables, begins):
            h += word(name) + struct.pack(f">{len(on) + 1}i", len(on), *on) + attributes(about)
            h += struct.pack(">iii", {"f": 5, "d": 6}[kind], len(data) * {"f": 4, "d": 8}[kind], begin)
        return h
    begins, body, size = [], b"", len(header([0, 0, 0]))
    for *_, kind, data in variables:
        begins.append(size + len(body))
        body += struct.pack(f">{len(data)}{kind}", *data)
    open(path, "wb").write(header(begins) + body)
def mercator(step): return [math.degrees(math.atan(math.sinh(math.radians(40 + step * i)))) for i in range(30)]
even = [5 + 0.1 * i for i in range(40)]
write("up.nc", [40 + 0.1 * i for i in range(30)], even)
write("down.nc", [43 - 0.1 * i for i in range(30)], even, float_axes=True)
write("metres.nc", [4e6 + 100 * i for i in range(30)], [5e5 + 100 * i for i in range(40)], degrees=False)
write("mercator.nc", mercator(1), [5 + i for i in range(40)])
write("down_mercator.nc", mercator(1)[::-1], [5 + i for i in range(40)])
write("fine_mercator.nc", mercator(0.05), even)  # GDAL assumes even rows
write("uneven.nc", [70 - 2 * i - 0.02 * i * i for i in range(30)], [5 + 2 * i for i in range(40)])
write("middle.nc", [40 + 0.1 * i + (0.02 * math.sin(i * math.pi / 7) if 1 < i < 13 or 16 < i < 28 else 0) for i in range(30)], even)
write("down_z.nc", [40 + 0.1 * i for i in range(30)], even, positive="down")
write("sea_floor.nc", [40 + 0.1 * i for i in range(30)], even, standard_name="sea_floor_depth_below_geoid")
write("up_z.nc", [40 + 0.1 * i for i in range(30)], even, standard_name="height_above_geoid", positive="up")
write("uneven_columns.nc", [40 + 0.1 * i for i in range(30)], [5 + 0.1 * i * i for i in range(40)])
PY
python3 netcdf.py

for file in up down; do
  succeeds "$scarp" info $file.nc --no-suggest --json
  cp "$logs/out" r.json
  [ "$(json r.json input crs)" = '"EPSG:4326"' ] || fail "$file.nc is in $(json r.json input crs)"
  [ "$(json r.json input geographic)" = true ] || fail "$file.nc is not in degrees"
done
succeeds "$scarp" info up.nc --no-suggest --te 6 41 7 42 --json
cp "$logs/out" r.json
[ "$(json r.json input crs)" = '"EPSG:4326"' ] || fail "a part of up.nc is in $(json r.json input crs)"
succeeds "$scarp" info metres.nc --no-suggest --json
cp "$logs/out" r.json
[ "$(json r.json input crs)" = '""' ] || fail "metres are degrees"

refuses 2 "uneven.nc: its latitudes are uneven, up to" "$scarp" simplify uneven.nc o.glb -e 5
refuses 2 "middle.nc: its latitudes are uneven, up to 0.195 cells" "$scarp" simplify middle.nc o.glb -e 5
refuses 2 "uneven_columns.nc: its longitudes are uneven" "$scarp" simplify uneven_columns.nc o.glb -e 5
for file in mercator down_mercator fine_mercator; do
  refuses 2 "$file.nc: its rows are even in Mercator, not in latitude" "$scarp" simplify $file.nc o.glb -e 5
  eval "$(sed -n 's/.*(\(gdal_translate .*\)).*/\1/p' "$logs/err") -q" && mv NEW.tif new.tif
  succeeds "$scarp" simplify new.tif o.tif -e 0.001 --overwrite
  python3 - "$file" <<'PY' || fail "$file.nc lies elsewhere after the way out"
import math, subprocess, sys, netcdf
step = 0.05 if sys.argv[1] == "fine_mercator" else 1
rows = netcdf.mercator(step)
lons = netcdf.even if step == 0.05 else [5 + i for i in range(40)]
for i, j in [(0, 0), (7, 3), (29, 39)]:  # row i of the file, which begins in the south unless reversed
    value = subprocess.run(["gdallocationinfo", "-valonly", "-wgs84", "new.tif", str(lons[j]), str(rows[i])],
                           capture_output=True, text=True, check=True).stdout
    k = 29 - i if sys.argv[1] == "down_mercator" else i
    assert abs(float(value) - (100 + 50 * math.sin(k / 3) + 30 * math.cos(j / 2))) < 1e-4, (i, j, value)
PY
done
# Depths of a whole file and of a part.
for file in down_z sea_floor; do
  for part in "" "--te 6 41 7 42"; do
    succeeds "$scarp" simplify $file.nc o.tif -e 5 --overwrite $part
    grep -q "$file.nc: .*: depths are taken for heights" "$logs/err" || fail "depths of $file.nc are heights in silence"
    succeeds "$scarp" simplify $file.nc o.tif -e 5 --overwrite --z-scale -1 $part
    ! grep -q "depths" "$logs/err" || fail "depths of $file.nc that are turned are warned of"
  done
done
succeeds "$scarp" info up_z.nc --no-suggest
! grep -q "depths" "$logs/err" || fail "heights are depths"
echo "coordinates of netCDF files are even or refused"
