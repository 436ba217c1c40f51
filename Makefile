# Short names for what one does here; each does what its line in `make help` says and nothing else.
# BUILD: build folder (the other kinds get BUILD-asan, BUILD-tsan, BUILD-fuzz). JOBS: compilers at once.
# DATA: folder with the fields of the 1995 paper, for make paper; make soak tries all of its files.
# CMAKE_FLAGS: more options for configuring, such as -DBUILD_SHARED_LIBS=ON.
BUILD ?= build
PREFIX ?= /usr/local
JOBS ?= $(shell nproc 2>/dev/null || echo 2)
CMAKE_FLAGS ?=
DATA ?= $(or $(SCARP_SHARED),../shared)/data
C_TARGETS = $(if $(filter -DSCARP_BUILD_C=OFF,$(CMAKE_FLAGS)),,scarp_c scarp_c_static)
export BUILD JOBS DATA

.PHONY: build demo viewer site globe qgis python npm dist check test test-full test-rest soak wasm-check bench paper install clean format tidy help

build:
	@tools/install_packages.sh build run
	@tools/configure.sh $(BUILD) $(CMAKE_FLAGS)
	@cmake --build $(BUILD) -j $(JOBS) --target scarp scarp_program $(C_TARGETS)

demo:
	@tools/install_packages.sh build
	@tools/configure.sh $(BUILD) $(CMAKE_FLAGS)
	@cmake --build $(BUILD) -j $(JOBS) --target scarp_program
	@! command -v npm >/dev/null || tools/build_viewer.sh $(BUILD) || echo 'The demonstration goes on without the viewer.'
	@tools/demo.sh $(BUILD)/bin/scarp

viewer:
	@tools/install_packages.sh viewer
	@tools/build_viewer.sh $(BUILD)

site: build
	@tools/install_packages.sh viewer
	@tools/build_site.sh $(BUILD) dist/site

globe:
	@tools/install_packages.sh build run globe
	@$(MAKE) --no-print-directory build
	@tools/globe.sh $(BUILD)/bin/scarp data/jacksboro_fault.tif globe --vertical egm96
	@echo "Open the address below; Ctrl-C ends."
	@python3 tools/globe/serve.py globe

python:
	@tools/install_packages.sh build run
	@tools/configure.sh $(BUILD) $(CMAKE_FLAGS)
	@cmake --build $(BUILD) -j $(JOBS) --target scarp_c_alone
	@tools/build_python.sh $(BUILD) dist

npm:
	@tools/install_packages.sh build wasm
	@JOBS=$(JOBS) tools/build_npm.sh $(BUILD)-wasm dist

dist:
	@tools/install_packages.sh build run viewer wasm dist
	@tools/configure.sh $(BUILD) $(CMAKE_FLAGS)
	@cmake --build $(BUILD) -j $(JOBS) --target scarp_program scarp_c_alone
	@tools/dist.sh $(BUILD) dist

check:
	@tools/install_packages.sh build run test
	@tools/configure.sh $(BUILD) --preset release $(CMAKE_FLAGS)
	@cmake --build $(BUILD) -j $(JOBS)
	@ctest --test-dir $(BUILD) -L fast -j $(JOBS) --output-on-failure --no-tests=error

test:
	@tools/install_packages.sh build run test
	@tools/test.sh test

test-full:
	@tools/install_packages.sh build run test full
	@tools/test.sh full

test-rest:
	@tools/install_packages.sh build run test full
	@tools/test.sh rest

qgis: build
	@tools/install_packages.sh run
	@python3 bindings/qgis/make_plugin.py $(BUILD)/bin/scarp dist/scarp_processing.zip
	@echo "Install it in QGIS: Plugins, Manage and Install Plugins, Install from ZIP."

soak:
	@tools/install_packages.sh build test
	@tools/soak.sh

wasm-check:
	@tools/install_packages.sh build wasm
	@tools/wasm_check.sh

bench:
	@tools/install_packages.sh build bench
	@tools/configure.sh $(BUILD) -DSCARP_BUILD_BENCH=ON $(CMAKE_FLAGS)
	@cmake --build $(BUILD) -j $(JOBS) --target scarp_program
	@for what in reference efforts high_normal edges orders memory peers speed; do cmake --build $(BUILD) -j $(JOBS) --target bench_$$what || exit 1; done

paper:
	@tools/install_packages.sh build paper
	@$(MAKE) --no-print-directory build
	@"$$(command -pv python3 || command -v python3)" bench/paper/run.py $(BUILD)/bin/scarp $(DATA) bench

install: build
	DESTDIR="$(DESTDIR)" cmake --install $(BUILD) --prefix "$(PREFIX)"

clean:
	rm -rf $(BUILD) $(BUILD)-asan $(BUILD)-tsan $(BUILD)-fuzz $(BUILD)-debug $(BUILD)-core $(BUILD)-wasm $(BUILD)-tidy demo globe dist

format:
	@tools/install_packages.sh lint
	git ls-files -co --exclude-standard '*.h' '*.cpp' | xargs clang-format -i
	@if command -v npm >/dev/null; then tools/format_js.sh --write; else echo 'JavaScript stays as it is: prettier needs npm.'; fi

tidy:
	@tools/install_packages.sh build test lint
	@tools/configure.sh $(BUILD)-tidy --preset release -DCMAKE_UNITY_BUILD=OFF
	git ls-files -co --exclude-standard 'src/*.cpp' 'apps/*.cpp' | xargs -P $(JOBS) -n 1 clang-tidy --quiet -p $(BUILD)-tidy

help:
	@echo 'make          build $(BUILD)/bin/scarp (Release), installing missing packages'
	@echo 'make demo     build, simplify a bundled DEM into demo/, check the result, make a page that shows it'
	@echo 'make viewer   the page that scarp view fills in, by npm: $(BUILD)/share/scarp/viewer.html'
	@echo 'make site     the documents, an example, a terrain to dig in, and the viewer to try with a file of your own, into dist/site'
	@echo 'make globe    build, make tiles of a bundled DEM and a page with CesiumJS in globe/, and serve it on this machine'
	@echo 'make qgis     build, pack the plugin for QGIS into dist/'
	@echo 'make python   the wheel and the sdist of Scarp for Python, into dist/'
	@echo 'make npm      the npm package, compiled with Emscripten, into dist/'
	@echo 'make dist     sources, npm package, wheel, sdist, plugin for QGIS and Debian packages, into dist/ with SHA256SUMS'
	@echo 'make check    what to run before every commit: the fast tests'
	@echo 'make test     all tests of what this tree does on this machine'
	@echo 'make test-full  make test, and what it leaves out: packages, installs, sanitizers, a short run of the fuzzers'
	@echo 'make test-rest  what make test-full adds to make test'
	@echo 'make soak     the files in DATA, then laws and fuzzers from fresh random seeds for SOAK_MINUTES (10)'
	@echo 'make wasm-check  the core compiled with Emscripten, its meshes compared with native ones'
	@echo 'make bench    the benchmarks; their tables are under version control'
	@echo 'make paper    the experiments of the 1995 paper on the fields in DATA, written to bench/paper.md'
	@echo 'make install  program, library, headers, man page into PREFIX (now $(PREFIX)); DESTDIR is honoured'
	@echo 'make format   clang-format on all sources in C++, and prettier, by npm, on JavaScript'
	@echo 'make tidy     clang-tidy on src/ and apps/'
	@echo 'make clean    remove the build folders, demo/, globe/ and dist/'
