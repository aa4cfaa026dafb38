# Thin entry points; each first installs the Debian packages it needs (tools/packages.txt). See docs/building.md.
BUILD ?= build
JOBS ?= $(shell nproc)

.PHONY: build demo test bench fuzz install-packages clean

build: install-packages
	@cmake --preset release -B $(BUILD) > $(BUILD).cmake.log 2>&1 || { cat $(BUILD).cmake.log; exit 1; }; rm -f $(BUILD).cmake.log
	@cmake --build $(BUILD) -j $(JOBS) --target all

demo: install-packages
	@tools/demo.sh $(BUILD) $(JOBS)

test: build
	@tools/test.sh $(BUILD) $(JOBS)

bench: build
	@tools/bench.sh $(BUILD)

fuzz: install-packages
	@tools/fuzz.sh $(BUILD)/fuzz $(JOBS) $(or $(SECONDS),300)

install-packages:
	@tools/install_packages.sh

clean:
	rm -rf $(BUILD)
