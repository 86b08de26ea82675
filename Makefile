# libcage: `make demo` and `make test` do everything; `make help` lists the rest.

# make presets CC; say CC=clang (or CFLAGS=...) on the command line to choose another.
CFLAGS  = -O2 -g
WARN    = -Wall -Wextra -Wconversion -Wshadow -pedantic -Werror
PREFIX  = /usr/local
DESTDIR =
VERSION = $(shell sed -n 's/^\#define CAGE_VERSION "\(.*\)"/\1/p' include/cage.h)
ABI     = $(shell sed -n 's/^\#define CAGE_ABI \([0-9]*\).*/\1/p' include/cage.h)

CORE    = $(sort $(wildcard src/*.c))
HOST    = $(sort $(wildcard src/host/*.c))
HEADERS = $(wildcard include/*.h src/*.h src/host/*.h)
CORE_O  = $(CORE:src/%.c=build/core/%.o)
PIC_O   = $(CORE:src/%.c=build/pic/%.o)
HOST_O  = $(HOST:src/host/%.c=build/host/%.o)

.DEFAULT_GOAL = all
.PHONY: all lib shared demo test bench bench-peers install uninstall clean help

all: build/cage ## the command build/cage and the static library
lib: build/libcage.a ## the static library, from freestanding C99
shared: build/libcage.so.$(ABI) ## the shared library

build/core/%.o: src/%.c $(HEADERS) Makefile
	@mkdir -p $(@D)
	$(CC) -std=c99 -ffreestanding $(CFLAGS) $(WARN) -Iinclude -c $< -o $@

build/pic/%.o: src/%.c $(HEADERS) Makefile
	@mkdir -p $(@D)
	$(CC) -std=c99 -ffreestanding -fPIC $(CFLAGS) $(WARN) -Iinclude -c $< -o $@

build/host/%.o: src/host/%.c $(HEADERS) Makefile
	@mkdir -p $(@D)
	$(CC) -std=c99 -D_POSIX_C_SOURCE=200809L $(CFLAGS) $(WARN) -Iinclude -c $< -o $@

build/libcage.a: $(CORE_O)
	rm -f $@
	$(AR) rcs $@ $(CORE_O)

build/libcage.so.$(ABI): $(PIC_O)
	$(CC) -shared -Wl,-soname,libcage.so.$(ABI) $(CFLAGS) $(PIC_O) -o $@
	ln -sf libcage.so.$(ABI) build/libcage.so

build/cage: $(HOST_O) build/libcage.a
	$(CC) $(CFLAGS) $(HOST_O) build/libcage.a -lm -o $@

demo: build/cage ## prove the example scenes: verdicts as a table, pictures in build/demo
	sh examples/demo.sh build/cage build/demo
