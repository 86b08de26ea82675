#!/bin/sh
# What the firmware tests need: installed when that is allowed.
. tests/missing.sh
need gcc gcc
need clang clang
need arm-none-eabi-gcc 'gcc-arm-none-eabi picolibc-arm-none-eabi'
need riscv64-unknown-elf-gcc 'gcc-riscv64-unknown-elf picolibc-riscv64-unknown-elf'
need s390x-linux-gnu-gcc 'gcc-s390x-linux-gnu libc6-dev-s390x-cross'
need powerpc-linux-gnu-gcc 'gcc-powerpc-linux-gnu libc6-dev-powerpc-cross'
need arm-linux-gnueabihf-gcc 'gcc-arm-linux-gnueabihf libc6-dev-armhf-cross'
need qemu-system-arm qemu-system-arm
need qemu-system-riscv32 qemu-system-misc
need qemu-s390x qemu-user
need cppcheck cppcheck
need clang-tidy clang-tidy
need cmake cmake
need pkg-config pkg-config
need python3 python3
python3 -c 'import yaml' 2>/dev/null || missing="$missing python3-yaml"
for specs in arm-none-eabi riscv64-unknown-elf; do
    case $missing in *picolibc-$specs*) continue ;; esac
    $specs-gcc --specs=picolibc.specs -E -x c /dev/null >/dev/null 2>&1 || missing="$missing picolibc-$specs"
done
install_missing "The firmware tests need" --no-install-recommends
