# make            install what is missing, build; the command is then build/gough
# make test       install what is missing, build, run the tests
# make quick      the quick tests only
# make test-thorough  with the page in a browser, the slow tests and most programs once more under sanitizers, as CI runs them
# make test-more  all of these and the campaigns
# make coverage   the share of branches that the tests take, by parts of the library
# make demo       install what is missing, build, run the paper's whole study into out/
# make install    into PREFIX (default /usr/local), under DESTDIR if given
# make python     a wheel of the package for Python in build/; plain make leaves the package itself in build/python
# make mpi        install an MPI and build build/gough-mpi, which runs sweeps on many machines; plain make builds it where an MPI is there
# make package    Debian packages in build/
# make dist       a tarball of the sources in build/, with the page bundled: it builds without npm and without a network
# make fuzz       each fuzzing target for FUZZ_SECONDS under sanitizers
# make campaign   STUDIES=1000 random studies, each number printed against an independent computation
# make bench      timings beside those of other programs, one table; BENCH=--json for machines
# make lint       formatting and static analysis
# make docs       API reference in build/docs
# make clean      remove build/ and out/
# PAGE=OFF leaves out the page of `gough report`, its tests, and the packages that only it needs; PYTHON=OFF likewise the package for
# Python.
BUILD        ?= build
PREFIX       ?= /usr/local
FUZZ_SECONDS ?= 60
CMAKE_FLAGS  ?=
BENCH        ?=
STUDIES      ?= 1000
PAGE         ?= ON
PYTHON       ?= ON
ifeq ($(filter ON OFF,$(PAGE)),)
$(error PAGE must be ON or OFF, not '$(PAGE)')
endif
ifeq ($(filter ON OFF,$(PYTHON)),)
$(error PYTHON must be ON or OFF, not '$(PYTHON)')
endif

# groups of packages, of scripts/install-packages.sh; without the page its tools are not needed, nor with the page that a source
# tarball brings bundled; without LLVM, which they bring, the tests of formatting and reference are skipped
bundles      = $(if $(wildcard web/report.html),,$(filter ON,$(PAGE)))
build_groups = compiler tools libraries figures $(if $(bundles),bundler webassembly) $(if $(filter ON,$(PYTHON)),python)
test_groups  = $(build_groups) test $(if $(filter ON,$(PYTHON)),pytest) $(if $(bundles),format docs browser)

.PHONY: all configure test quick test-thorough test-more coverage demo install python mpi package dist fuzz campaign bench lint docs clean

all: configure
	@cmake --build "$(BUILD)" --target gough_command gough_archive gough_shared gough_files_shared gough_mpi \
        $(if $(filter ON,$(PYTHON)),gough_python)

configure:
	@scripts/install-packages.sh $(build_groups)
	@cmake -S . -B "$(BUILD)" -G Ninja "-DCMAKE_INSTALL_PREFIX=$(PREFIX)" -DGOUGH_PAGE=$(PAGE) \
        -DGOUGH_PYTHON=$(PYTHON) $(CMAKE_FLAGS) >/dev/null

test:
	@scripts/install-packages.sh $(test_groups)
	@PAGE=$(PAGE) PYTHON=$(PYTHON) scripts/test.sh "$(BUILD)" standard

quick:
	@scripts/install-packages.sh $(test_groups)
	@PAGE=$(PAGE) PYTHON=$(PYTHON) scripts/test.sh "$(BUILD)" quick

test-thorough:
	@scripts/install-packages.sh $(test_groups)
	@PAGE=$(PAGE) PYTHON=$(PYTHON) scripts/test.sh "$(BUILD)" thorough

test-more:
	@scripts/install-packages.sh $(test_groups) package mpi engines musl
	@PAGE=$(PAGE) PYTHON=$(PYTHON) scripts/test.sh "$(BUILD)" campaign

coverage:
	@scripts/install-packages.sh $(filter-out browser format docs python pytest,$(test_groups))
	@scripts/coverage.sh "$(BUILD)"

demo: all
	@scripts/demo.sh

install: all
	cmake --install "$(BUILD)" --prefix "$(PREFIX)"

python: configure
	@cmake --build "$(BUILD)" --target gough_wheel

mpi:
	@scripts/install-packages.sh $(build_groups) mpi
	@$(MAKE) --no-print-directory all

package:
	@scripts/install-packages.sh $(build_groups) package lintian
	@PAGE=$(PAGE) PYTHON=$(PYTHON) scripts/package.sh "$(BUILD)"

dist: configure
	@$(if $(bundles),,echo "make dist bundles the page: it needs PAGE=ON and the sources from git, without web/report.html" >&2; exit 1)
	@scripts/install-packages.sh dist
	@scripts/dist.sh "$(BUILD)"

fuzz:
	@scripts/install-packages.sh compiler tools libraries webassembly fuzz
	@FUZZ_SECONDS=$(FUZZ_SECONDS) scripts/fuzz.sh

campaign: all
	@scripts/install-packages.sh test
	@tests/independent/campaign/campaign.py --gough "$(BUILD)/gough" --studies $(STUDIES) --jobs "$$(nproc)"

bench: configure
	@scripts/install-packages.sh counts peers sundials
	@scripts/bench.sh "$(BUILD)" $(BENCH)

lint: all
	@scripts/install-packages.sh format lint
	@scripts/lint.sh "$(BUILD)"

docs: configure
	@scripts/install-packages.sh docs
	@scripts/docs.sh "$(BUILD)"

clean:
	rm -rf "$(BUILD)" out
