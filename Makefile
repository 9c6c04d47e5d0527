# make            install what is missing, build; the command is then build/gough
# make test       install what is missing, build, run the tests
# make quick      the quick tests only
# make test-more  the tests and the campaigns
# make coverage   the share of branches that the tests take, by parts of the library
# make demo       install what is missing, build, run the paper's whole study into out/
# make install    into PREFIX (default /usr/local), under DESTDIR if given
# make package    a Debian package in build/
# make fuzz       each fuzzing target for FUZZ_SECONDS under sanitizers
# make campaign   STUDIES=1000 random studies, each number printed against an independent computation
# make bench      timings beside those of other programs, one table; BENCH=--json for machines
# make lint       formatting and static analysis
# make docs       API reference in build/docs
# make clean      remove build/ and out/
BUILD        ?= build
PREFIX       ?= /usr/local
FUZZ_SECONDS ?= 60
CMAKE_FLAGS  ?=
BENCH        ?=
STUDIES      ?= 1000

.PHONY: all configure test quick test-more coverage demo install package fuzz campaign bench lint docs clean

all: configure
	@cmake --build "$(BUILD)" --target gough_command gough_archive gough_shared gough_files_shared

configure:
	@scripts/install-packages.sh build
	@cmake -S . -B "$(BUILD)" -G Ninja "-DCMAKE_INSTALL_PREFIX=$(PREFIX)" $(CMAKE_FLAGS) >/dev/null

test:
	@scripts/install-packages.sh build test
	@scripts/test.sh "$(BUILD)" standard

quick:
	@scripts/install-packages.sh build test
	@scripts/test.sh "$(BUILD)" quick

test-more:
	@scripts/install-packages.sh build test
	@scripts/test.sh "$(BUILD)" campaign

coverage:
	@scripts/install-packages.sh build test
	@scripts/coverage.sh "$(BUILD)"

demo: all
	@scripts/install-packages.sh demo
	@scripts/demo.sh

install: all
	cmake --install "$(BUILD)" --prefix "$(PREFIX)"

package:
	@scripts/install-packages.sh build package
	@scripts/package.sh "$(BUILD)"

fuzz:
	@scripts/install-packages.sh build test
	@FUZZ_SECONDS=$(FUZZ_SECONDS) scripts/fuzz.sh

campaign: all
	@scripts/install-packages.sh test
	@tests/independent/campaign/campaign.py --gough "$(BUILD)/gough" --studies $(STUDIES) --jobs "$$(nproc)"

bench: configure
	@scripts/install-packages.sh bench
	@scripts/bench.sh "$(BUILD)" $(BENCH)

lint: all
	@scripts/install-packages.sh lint
	@scripts/lint.sh "$(BUILD)"

docs: configure
	@scripts/install-packages.sh docs
	@scripts/docs.sh "$(BUILD)"

clean:
	rm -rf "$(BUILD)" out
