# The front door of Seiche. Each target installs what it needs (Debian, Ubuntu) and builds what it runs.
PREFIX ?= /usr/local
ARGS ?=
OUT ?= $(if $(filter --quick,$(ARGS)),out/paper-quick,out/paper)
WP_ARGS ?=
VERIFY ?=
JOBS ?= $(shell nproc)

.DEFAULT_GOAL := help
.PHONY: help deps configure build paper docs test verify python bench install package wheel format tidy asan tsan valgrind instructions soak fuzz clean

help:  ## this list
	@echo "Seiche: energy-stable integrators for damped Hamiltonian systems"
	@sed -n -E 's/^([a-z]+):.*  ## (.*)/  make \1\t\2/p' $(firstword $(MAKEFILE_LIST)) | expand -t 20

deps:
	@bash scripts/install-deps

configure: deps
	@cmake --preset release >/dev/null

build: configure  ## build/release/seiche, the program
	@cmake --build --preset release --parallel $(JOBS) --target seiche_cli

paper: build  ## the paper's examples, figures and claims: out/paper/report.html (ARGS=--quick: out/paper-quick; OUT=folder)
	@build/release/seiche paper --out "$(OUT)" $(ARGS)
	@echo "The report is $(OUT)/report.html"

docs: build python  ## this project's pages, their gallery drawn anew: build/docs/index.html
	@bash scripts/install-deps --docs
	@/usr/bin/python3 docs/site/build.py build/release/seiche
	@echo "Open build/docs/index.html"

test:  ## build and run all tests
	@bash scripts/install-deps --python
	@cmake --preset release >/dev/null
	@cmake --build --preset release --parallel $(JOBS)
	@ctest --preset release --parallel $(JOBS)

verify: build  ## wrong numbers looked for on systems of its own: build/verification_rows.md (VERIFY="--only morse", --help)
	@bash scripts/install-deps --python
	@/usr/bin/python3 -m verification --program build/release/seiche $(VERIFY)

python:  ## the Python package: build/python, to be imported from there (pip install . installs it)
	@bash scripts/install-deps --python
	@cmake --preset release >/dev/null
	@cmake --build --preset release --parallel $(JOBS) --target seiche_python
	@ln -sfn release/python build/python
	@echo "Now: PYTHONPATH=$(CURDIR)/build/python /usr/bin/python3 -c 'import seiche; print(seiche.__version__)'"

bench:  ## build and run the benchmarks: step cost (ARGS), then work and precision (WP_ARGS=--quick, --help)
	@bash scripts/install-deps --bench
	@cmake --preset bench >/dev/null
	@cmake --build --preset bench --parallel $(JOBS)
	@build/bench/bench/seiche_bench $(ARGS)
	@build/bench/bench/seiche_work_precision $(WP_ARGS)

install: build  ## library, headers and program into PREFIX (default /usr/local)
	@cmake --install build/release --prefix "$(PREFIX)"

package:  ## Debian packages: build/dist/*.deb, tried out in a clean root
	@bash scripts/install-deps --python --package
	@cmake --preset release >/dev/null
	@cmake --build --preset release --parallel $(JOBS) --target packaged
	@rm -f build/dist/*.deb && cpack --config build/release/CPackConfig.cmake
	@bash scripts/check-deb

wheel:  ## a Python wheel with its libraries inside: build/dist/*.whl, tried out in a clean root
	@bash scripts/install-deps --python --package
	@cmake --preset release >/dev/null
	@rm -f build/dist/*.whl
	@SEICHE_BUILD_DIR=$(CURDIR)/build/release /usr/bin/python3 -m pip wheel . --no-deps --no-build-isolation \
	  --config-settings bundle=yes --wheel-dir build/dist
	@bash scripts/check-wheel

format:  ## lay out every C++ file with clang-format
	@bash scripts/install-deps --ci
	@bash scripts/ci-format --fix

tidy:  ## read every C++ file with clang-tidy
	@bash scripts/install-deps --ci
	@bash scripts/ci-tidy --all

asan:  ## build and run the tests under sanitizers
	@bash scripts/install-deps --ci
	@bash scripts/ci-asan

tsan: deps  ## build and run what starts threads under the thread sanitizer
	@bash scripts/install-deps --soak
	@bash scripts/ci-tsan

valgrind: build  ## run the program under valgrind
	@bash scripts/install-deps --soak
	@bash scripts/valgrind

instructions: build  ## count the instructions of a step and compare them (ARGS=--renew)
	@bash scripts/install-deps --soak
	@/usr/bin/python3 scripts/ci-instructions $(ARGS)

soak: configure  ## ten million steps, ten thousand random systems (STEPS, SYSTEMS, FIRST)
	@cmake --build --preset release --parallel $(JOBS) --target seiche_tests
	@bash scripts/soak $(or $(STEPS),10000000) $(or $(SYSTEMS),10000) $(or $(FIRST),1)

fuzz:  ## feed what users write and what lies on disks to fuzzers (SECONDS=900)
	@bash scripts/install-deps --fuzz
	@bash scripts/fuzz $(or $(SECONDS),900)

clean:  ## remove everything that was built
	@rm -rf build
