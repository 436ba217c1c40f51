"""Builds the wheel and the sdist of Scarp for Python: PEP 517 and 660, without dependencies and without a network.

CMake compiles the library from the checkout (or the sdist) of this file, without GDAL, unless SCARP_C_LIBRARY, or
`--config-settings library=FILE`, names an existing one. `--config-settings gdal=on` compiles it with GDAL. The package
also contains libraries that many machines lack, and the page of Mesh.view(), if SCARP_VIEWER_PAGE names it.
"""
import base64
import csv
import gzip
import hashlib
import io
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import zipfile

HERE = os.path.dirname(os.path.abspath(__file__))
# Libraries linked by Scarp that few machines have. All others belong to the system.
BUNDLED = ("libfmt", "libhwy", "libmeshoptimizer", "libsqlite3")
SOURCES = ("CMakeLists.txt", "LICENSE", "cmake", "src", "include", "bindings/c", "data/egm96.bin")
LIBRARY = {"win32": "scarp_c.dll", "darwin": "libscarp_c.dylib"}.get(sys.platform, "libscarp_c.so")
OLDEST_TIME = (1980, 1, 1, 0, 0, 0)


def _root():
    """The folder of Scarp's sources, in the checkout or in an sdist."""
    for folder in (os.path.join(HERE, "source"), os.path.join(HERE, "..", "..")):
        if os.path.exists(os.path.join(folder, "include", "scarp", "version.h")):
            return os.path.abspath(folder)
    raise SystemExit("Scarp's sources are neither in %s/source nor two folders above" % HERE)


def _version():
    with open(os.path.join(_root(), "CMakeLists.txt")) as file:
        return re.search(r"project\(scarp VERSION ([0-9.]+)", file.read()).group(1)


def _package_files():
    """Paths in the package and in the checkout."""
    files = []
    for folder, _, names in os.walk(os.path.join(HERE, "src")):
        for name in names:
            if name.endswith((".py", ".typed")):
                path = os.path.join(folder, name)
                files.append((os.path.relpath(path, os.path.join(HERE, "src")).replace(os.sep, "/"), path))
    return sorted(files)


def _compile(settings):
    """The library's path, and the folder to remove afterwards."""
    given = settings.get("library") or os.environ.get("SCARP_C_LIBRARY")
    if given:
        return given, None
    build = tempfile.mkdtemp(prefix="scarp-build-")
    with_gdal = "ON" if str(settings.get("gdal", "off")).lower() in ("on", "1", "true", "yes") else "OFF"
    command = ["cmake", "-S", _root(), "-B", build, "-DCMAKE_BUILD_TYPE=Release", "-DSCARP_WITH_GDAL=" + with_gdal,
               "-DSCARP_BUILD_APPS=OFF", "-DSCARP_BUILD_C=ON", "-DSCARP_INSTALL=OFF"]
    if shutil.which("ninja"):
        command += ["-G", "Ninja"]
    target = "scarp_c" if with_gdal == "ON" else "scarp_c_alone"
    subprocess.run(command, check=True)
    subprocess.run(["cmake", "--build", build, "--target", target, "-j", str(os.cpu_count() or 2)], check=True)
    folder = os.path.join(build, "bindings", "c" if with_gdal == "ON" else "python")
    return os.path.join(folder, LIBRARY), build


def _companions(library):
    """The libraries to place next to it, by the names that it needs."""
    if not sys.platform.startswith("linux"):
        return []
    found = []
    for line in subprocess.run(["ldd", library], check=True, capture_output=True, text=True).stdout.splitlines():
        match = re.match(r"\s*(\S+) => (/\S+)", line)
        if match and match.group(1).startswith(BUNDLED):
            found.append((match.group(1), match.group(2)))
    return sorted(found)


def _metadata():
    with open(os.path.join(HERE, "README.md")) as file:
        text = file.read()
    return ("Metadata-Version: 2.1\nName: scarp\nVersion: %s\nSummary: Height fields to triangle meshes with a proven "
            "error bound\nLicense: MIT\nRequires-Python: >=3.8\nRequires-Dist: numpy>=1.21\n"
            "Provides-Extra: geo\nRequires-Dist: rasterio; extra == 'geo'\nRequires-Dist: rioxarray; extra == 'geo'\n"
            "Provides-Extra: view\nRequires-Dist: matplotlib; extra == 'view'\nRequires-Dist: pyvista; extra == 'view'\n"
            "Provides-Extra: progress\nRequires-Dist: tqdm; extra == 'progress'\n"
            "Description-Content-Type: text/markdown\n\n%s" % (_version(), text))


def _tag():
    return "py3-none-" + re.sub(r"[-.]", "_", sysconfig.get_platform())


class _Wheel:
    """A wheel whose bytes depend on its contents only."""

    def __init__(self, folder):
        self.name = "scarp-%s-%s.whl" % (_version(), _tag())
        self.info = "scarp-%s.dist-info/" % _version()
        self.rows = []
        self.zip = zipfile.ZipFile(os.path.join(folder, self.name), "w", zipfile.ZIP_DEFLATED)

    def put(self, path, data):
        data = data.encode() if isinstance(data, str) else data
        entry = zipfile.ZipInfo(path, OLDEST_TIME)
        entry.external_attr = 0o644 << 16
        self.zip.writestr(entry, data, zipfile.ZIP_DEFLATED)
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        self.rows.append((path, "sha256=" + digest, len(data)))

    def put_file(self, path, source):
        with open(source, "rb") as file:
            self.put(path, file.read())

    def finish(self):
        self.put(self.info + "METADATA", _metadata())
        self.put(self.info + "WHEEL", "Wheel-Version: 1.0\nGenerator: scarp\nRoot-Is-Purelib: false\nTag: %s\n" % _tag())
        self.put_file(self.info + "LICENSE", os.path.join(_root(), "LICENSE"))
        out = io.StringIO()
        csv.writer(out, lineterminator="\n").writerows(self.rows + [(self.info + "RECORD", "", "")])
        self.zip.writestr(zipfile.ZipInfo(self.info + "RECORD", OLDEST_TIME), out.getvalue(), zipfile.ZIP_DEFLATED)
        self.zip.close()
        return self.name


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    """Keeps pip from compiling the library twice."""
    info = "scarp-%s.dist-info" % _version()
    os.makedirs(os.path.join(metadata_directory, info), exist_ok=True)
    with open(os.path.join(metadata_directory, info, "METADATA"), "w") as file:
        file.write(_metadata())
    return info


prepare_metadata_for_build_editable = prepare_metadata_for_build_wheel


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    library, build = _compile(config_settings or {})
    try:
        wheel = _Wheel(wheel_directory)
        for path, source in _package_files():
            wheel.put_file(path, source)
        wheel.put_file("scarp/" + LIBRARY, library)
        for name, source in _companions(library):
            wheel.put_file("scarp/" + name, source)
        if os.environ.get("SCARP_VIEWER_PAGE"):
            wheel.put_file("scarp/viewer.html", os.environ["SCARP_VIEWER_PAGE"])
        return wheel.finish()
    finally:
        if build:
            shutil.rmtree(build, ignore_errors=True)


def build_editable(wheel_directory, config_settings=None, metadata_directory=None):
    """The package remains in the checkout, and the library is added to it."""
    library, build = _compile(config_settings or {})
    try:
        package = os.path.join(HERE, "src", "scarp")
        shutil.copy(library, os.path.join(package, LIBRARY))
        for name, source in _companions(library):
            shutil.copy(source, os.path.join(package, name))
        wheel = _Wheel(wheel_directory)
        wheel.put("scarp.pth", os.path.join(HERE, "src") + "\n")
        return wheel.finish()
    finally:
        if build:
            shutil.rmtree(build, ignore_errors=True)


def build_sdist(sdist_directory, config_settings=None):
    top = "scarp-" + _version()
    entries = [("pyproject.toml", None), ("backend.py", None), ("README.md", None)]
    files = [(name, os.path.join(HERE, name)) for name, _ in entries]
    files += [("src/" + path, source) for path, source in _package_files()]
    for source in SOURCES:
        start = os.path.join(_root(), source)
        if os.path.isfile(start):
            files.append(("source/" + source, start))
        for folder, _, names in os.walk(start):
            for name in names:
                path = os.path.join(folder, name)
                files.append(("source/" + os.path.relpath(path, _root()).replace(os.sep, "/"), path))
    name = top + ".tar.gz"
    with open(os.path.join(sdist_directory, name), "wb") as raw, \
            gzip.GzipFile(filename="", fileobj=raw, mode="wb", mtime=0) as packed, \
            tarfile.open(fileobj=packed, mode="w", format=tarfile.PAX_FORMAT) as tar:
        def put(path, data):
            entry = tarfile.TarInfo(top + "/" + path)
            entry.size = len(data)
            entry.mode = 0o644
            tar.addfile(entry, io.BytesIO(data))
        put("PKG-INFO", _metadata().encode())
        for path, source in sorted(files):
            with open(source, "rb") as file:
                put(path, file.read())
    return name


def get_requires_for_build_wheel(config_settings=None):
    return []


get_requires_for_build_editable = get_requires_for_build_sdist = get_requires_for_build_wheel
