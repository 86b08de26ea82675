# libcage: `make demo` and `make test` do everything; `make help` lists the rest.

# make presets CC; say CC=clang (or CFLAGS=...) on the command line to choose another.
CFLAGS  = -O3 -g
WARN    = -Wall -Wextra -Wconversion -Wshadow -pedantic -Werror
PREFIX  = /usr/local
DESTDIR =
VERSION = $(shell sed -n 's/^\#define CAGE_VERSION "\(.*\)"/\1/p' include/cage.h)
ABI     = $(shell sed -n 's/^\#define CAGE_ABI \([0-9]*\).*/\1/p' include/cage.h)

# Libraries that the command uses where they are installed: a program is compiled and linked with them to find out. Without them
# it says what is missing; `make CHOLMOD=no CCD=no` goes without.
SPARSE_I = -I/usr/include/suitesparse
CHOLMOD_L = -lcholmod -lsuitesparseconfig
HASH := \#
CHOLMOD := $(shell printf '$(HASH)include <cholmod.h>\nint main(void) { cholmod_common c; return !cholmod_start(&c); }\n' | \
  $(CC) $(SPARSE_I) -x c - $(CHOLMOD_L) -o /dev/null 2> /dev/null && echo yes || echo no)
CCD := $(shell printf '$(HASH)include <ccd/ccd.h>\nint main(void) { ccd_t c; return ccdMPRIntersect(&c, &c, &c); }\n' | \
  $(CC) -x c - -lccd -lm -o /dev/null 2> /dev/null && echo yes || echo no)
EXTRAS = CHOLMOD=$(CHOLMOD) CCD=$(CCD)
LEFT_OUT = $(if $(filter yes,$(CHOLMOD)),src/host/metric_none.c,src/host/metric.c) \
  $(if $(filter yes,$(CCD)),src/host/parts_none.c,src/host/parts.c src/host/parts_balls.c)
EXTRA_L = $(if $(filter yes,$(CHOLMOD)),$(CHOLMOD_L)) $(if $(filter yes,$(CCD)),-lccd)

CORE    = $(sort $(wildcard src/*.c))
HOST    = $(filter-out $(LEFT_OUT),$(sort $(wildcard src/host/*.c)))
HEADERS = $(wildcard include/*.h src/*.h src/host/*.h)
CORE_O  = $(CORE:src/%.c=build/core/%.o)
PIC_O   = $(CORE:src/%.c=build/pic/%.o)
HOST_O  = $(HOST:src/host/%.c=build/host/%.o)

.DEFAULT_GOAL = all
.PHONY: FORCE all lib shared demo test check-paths check-firmware check-python soak amalgamation packages bench bench-peers \
  install uninstall clean help

all: build/cage ## the command build/cage and the static library
lib: build/libcage.a ## the static library, from freestanding C99
shared: build/libcage.so.$(ABI) ## the shared library

build/core/%.o: src/%.c $(HEADERS) Makefile
	@mkdir -p $(@D)
	$(CC) -std=c99 -ffreestanding $(CFLAGS) $(WARN) -Iinclude -c $< -o $@

build/pic/%.o: src/%.c $(HEADERS) Makefile
	@mkdir -p $(@D)
	$(CC) -std=c99 -ffreestanding -fPIC -fvisibility=hidden $(CFLAGS) $(WARN) -Iinclude -c $< -o $@

build/host/%.o: src/host/%.c $(HEADERS) Makefile
	@mkdir -p $(@D)
	$(CC) -std=c99 -D_XOPEN_SOURCE=700 $(CFLAGS) $(WARN) -Iinclude $(SPARSE_I) -c $< -o $@

build/libcage.a: $(CORE_O)
	rm -f $@
	$(AR) rcs $@ $(CORE_O)

build/libcage.so.$(ABI): $(PIC_O)
	$(CC) -shared -Wl,-soname,libcage.so.$(ABI) $(CFLAGS) $(PIC_O) -o $@
	ln -sf libcage.so.$(ABI) build/libcage.so

# Changes when they do: then the command is linked again.
build/extras: FORCE
	@mkdir -p $(@D)
	@echo '$(EXTRAS)' | cmp -s - $@ || echo '$(EXTRAS)' > $@
FORCE:

build/cage: $(HOST_O) build/libcage.a build/extras
	$(CC) $(CFLAGS) $(HOST_O) build/libcage.a $(EXTRA_L) -lm -pthread -o $@

demo: build/cage ## prove the example scenes: verdicts as a table, pictures in build/demo
	sh examples/demo.sh build/cage build/demo

# ---- tests: each tests/test_*.c is a program of its own, with the helpers beside it ----------------

TESTS   = $(sort $(wildcard tests/test_*.c))
HELPERS = $(filter-out $(wildcard tests/soak*.c) $(TESTS),$(sort $(wildcard tests/*.c)))
TEST_I  = -iquote src -iquote tests -Iinclude
SANITIZE = -O1 -fsanitize=address,undefined -fno-sanitize-recover=all

# $(1): directory of objects, $(2): more flags
define test_build
$(1)/core/%.o: src/%.c $$(HEADERS) Makefile
	@mkdir -p $$(@D)
	$$(CC) -std=c99 $$(CFLAGS) $(2) $$(WARN) -Iinclude -c $$< -o $$@
$(1)/%.o: tests/%.c $$(HEADERS) $$(wildcard tests/*.h) $$(CORE) Makefile
	@mkdir -p $$(@D)
	$$(CC) -std=c99 -D_POSIX_C_SOURCE=200809L $$(CFLAGS) $(2) -Wall -Wextra -Wconversion -Wshadow $$(TEST_I) -c $$< -o $$@
$(1)/libhelpers.a: $$(HELPERS:tests/%.c=$(1)/%.o) $$(CORE:src/%.c=$(1)/core/%.o)
	rm -f $$@
	$$(AR) rcs $$@ $$^
$(1)/test_%: $(1)/test_%.o $(1)/libhelpers.a
	$$(CC) $$(CFLAGS) $(2) $$< $(1)/libhelpers.a $$$$(pkg-config --libs check) -lgmp -lm -o $$@
endef
$(eval $(call test_build,build/test,))
$(eval $(call test_build,build/sanitized,$(SANITIZE)))
.SECONDARY:

TEST_BIN = $(TESTS:tests/%.c=build/test/%)
SANI_BIN = $(TESTS:tests/%.c=build/sanitized/%)

test: ## install what the tests need (when it may), build and run everything
	sh tests/deps.sh
	$(MAKE) --no-print-directory -j2 -s build/cage lib shared $(TEST_BIN) $(SANI_BIN) build/prove_in_c
	sh tests/run.sh

check-python: ## build the Python package, and test it in an environment of its own with what PyPI has
	sh bindings/python/check.sh

build/prove_in_c: examples/prove_in_c.c build/libcage.a
	$(CC) -std=c99 $(CFLAGS) $(WARN) -Iinclude $< build/libcage.a -o $@

build/soak build/soak_space: build/%: tests/%.c $(HELPERS) $(HEADERS) build/test/libhelpers.a
	$(CC) -std=c99 -D_POSIX_C_SOURCE=200809L $(CFLAGS) $(TEST_I) $< build/test/libhelpers.a -lm -o $@

build/soak_atlas: tests/soak_atlas.c $(HELPERS) $(HEADERS) build/sanitized/libhelpers.a
	$(CC) -std=c99 -D_POSIX_C_SOURCE=200809L $(CFLAGS) $(SANITIZE) $(TEST_I) $< build/sanitized/libhelpers.a -lgmp -lm -o $@

# Programs with the command's own files beside its main: paths made smooth, true shapes; and an atlas beside SuiteSparse's BTF.
PATHS_O = $(filter-out build/host/main.o,$(HOST_O))
PATHS_I = -iquote src/host -iquote src -iquote tests -Iinclude $(SPARSE_I)
build/check_%: tests/paths/%.c tests/random.c $(PATHS_O) build/libcage.a build/extras
	$(CC) -std=c99 -D_XOPEN_SOURCE=700 $(CFLAGS) -Wall -Wextra -Wshadow $(PATHS_I) $< tests/random.c $(PATHS_O) build/libcage.a \
	  $(EXTRA_L) $(MORE_L) -lm -pthread -o $@
build/check_classes: MORE_L = -lbtf

CHECKS = build/check_paths build/check_parts build/check_classes
check-paths: ## smooth paths, candidates, true shapes: install what they need (when it may), build and judge them
	sh tests/paths/deps.sh
	$(MAKE) --no-print-directory -s build/cage $(CHECKS)
	sh tests/paths/run.sh build/cage

soak: build/soak build/soak_space build/soak_atlas ## hunt for contradictions and crashes: build/soak FROM TO, likewise _space, _atlas
	build/soak 1 2000
	build/soak_space 1 300
	build/soak_atlas 1 500

check-firmware: build/cage ## firmware builds: install toolchains (when it may), build, run in emulators, compare, measure
	sh tests/firmware/deps.sh
	sh tests/firmware/check.sh

# ---- benchmarks ------------------------------------------------------------------------------------

BENCH = $(wildcard tests/bench/*.c)
build/bench/unpruned: PRUNE = tests/bench/unpruned/prune.c
build/bench/bench build/bench/unpruned: $(BENCH) $(wildcard tests/bench/*.h tests/bench/unpruned/*.c) build/libcage.a
	@mkdir -p $(@D)
	$(CC) -std=c99 -D_POSIX_C_SOURCE=200809L $(CFLAGS) -iquote src -Iinclude $(BENCH) $(PRUNE) build/libcage.a -lm -o $@

build/bench/peer: tests/bench/peer_cgal.cpp tests/bench/sets.h
	@mkdir -p $(@D)
	$(CXX) -std=c++17 -O3 -march=x86-64-v3 -Iinclude $< -lgmp -lmpfr -o $@

bench: build/bench/bench build/bench/unpruned ## time triangulations, slices and proofs; the last of these without skipping balls
	build/bench/bench
	build/bench/unpruned fence

bench-peers: build/bench/bench build/bench/peer ## the same beside CGAL, pair by pair (needs libcgal-dev)
	sh tests/bench/compare.sh build/bench/bench build/bench/peer

# ---- the library as two files, and packages of it ---------------------------------------------------

amalgamation: ## the library as two files, build/dist/cage.c and cage.h
	sh tests/amalgamate.sh build/dist

packages: amalgamation ## for Zephyr, ESP-IDF, PlatformIO and Arduino, CMSIS-Pack: archives in build/packages
	sh bindings/pack.sh build/dist build/packages

# ---- installation ----------------------------------------------------------------------------------

build/libcage.pc: Makefile include/cage.h
	@mkdir -p $(@D)
	printf '%s\n' 'prefix=$(PREFIX)' 'libdir=$${prefix}/lib' 'includedir=$${prefix}/include' '' 'Name: libcage' \
	  'Description: Prove that a rigid object is caged, or find its way out' 'Version: $(VERSION)' \
	  'Libs: -L$${libdir} -lcage' 'Cflags: -I$${includedir}' > $@

install: build/cage lib shared build/libcage.pc ## library, header, pkg-config and CMake files, and the command as cage-prove
	mkdir -p $(DESTDIR)$(PREFIX)/bin $(DESTDIR)$(PREFIX)/include $(DESTDIR)$(PREFIX)/lib/pkgconfig
	cp build/cage $(DESTDIR)$(PREFIX)/bin/cage-prove
	cp include/cage.h $(DESTDIR)$(PREFIX)/include/
	cp build/libcage.a build/libcage.so.$(ABI) $(DESTDIR)$(PREFIX)/lib/
	ln -sf libcage.so.$(ABI) $(DESTDIR)$(PREFIX)/lib/libcage.so
	cp build/libcage.pc $(DESTDIR)$(PREFIX)/lib/pkgconfig/
	mkdir -p $(DESTDIR)$(PREFIX)/lib/cmake/libcage
	cp bindings/cmake/libcageConfig.cmake $(DESTDIR)$(PREFIX)/lib/cmake/libcage/
	sed 's/@VERSION@/$(VERSION)/' bindings/cmake/libcageConfigVersion.cmake \
	  > $(DESTDIR)$(PREFIX)/lib/cmake/libcage/libcageConfigVersion.cmake

uninstall: ## remove what install has put there
	rm -f $(DESTDIR)$(PREFIX)/bin/cage-prove $(DESTDIR)$(PREFIX)/include/cage.h $(DESTDIR)$(PREFIX)/lib/libcage.a \
	  $(DESTDIR)$(PREFIX)/lib/libcage.so $(DESTDIR)$(PREFIX)/lib/libcage.so.$(ABI) $(DESTDIR)$(PREFIX)/lib/pkgconfig/libcage.pc
	rm -rf $(DESTDIR)$(PREFIX)/lib/cmake/libcage

clean: ## remove build
	rm -rf build

help: ## this list
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/  make \1|\2/p' Makefile | awk -F'|' '{printf "%-20s %s\n", $$1, $$2}'
