#!/bin/sh
# The machines that the tests build for and run on: source this, then `target NAME` sets what each of them needs.
targets='host host-limbs cortex-m3 cortex-m4 cortex-m7 rv32 rv64 s390x powerpc armhf'

# Where flash and RAM are is all that picolibc's own start-up and linker script have to be told.
memory() { # FLASH RAM
    echo "--crt0=semihost --oslib=semihost -Wl,--defsym=__flash=$1 -Wl,--defsym=__flash_size=4M" \
        "-Wl,--defsym=__ram=$2 -Wl,--defsym=__ram_size=16M"
}

# In QEMU an instruction takes 1 ns, and what the image prints goes to standard output.
board() { # EMULATOR MACHINE
    echo "$1 -M $2 -display none -monitor none -serial none -chardev stdio,id=out -icount shift=0" \
        "-semihosting-config enable=on,target=native,chardev=out -kernel"
}

# PREFIX: of the compiler's tools; FLAGS: of all compiling; LINK: of linking; RUN: the command that runs an image.
target() {
    PREFIX= FLAGS= LINK= RUN= cpu=
    case $1 in
    host) ;;
    host-limbs) FLAGS=-DCAGE_LIMBS ;;
    cortex-m3) RUN=$(board qemu-system-arm mps2-an385) LINK=$(memory 0 0x21000000) ;;
    cortex-m4) RUN=$(board qemu-system-arm mps2-an386) LINK=$(memory 0 0x21000000) ;;
    cortex-m7) RUN=$(board qemu-system-arm mps2-an500) LINK=$(memory 0 0x60000000) ;;
    rv32) cpu='-march=rv32imac -mabi=ilp32' RUN=$(board 'qemu-system-riscv32 -bios none' virt) ;;
    rv64) cpu='-march=rv64imac -mabi=lp64' RUN=$(board 'qemu-system-riscv64 -bios none' virt) ;;
    s390x) PREFIX=s390x-linux-gnu- LINK=-static RUN=qemu-s390x ;;
    powerpc) PREFIX=powerpc-linux-gnu- LINK=-static RUN=qemu-ppc ;;
    armhf) PREFIX=arm-linux-gnueabihf- LINK=-static RUN=qemu-arm ;;
    *) return 1 ;;
    esac
    case $1 in
    cortex-*) PREFIX=arm-none-eabi- FLAGS="--specs=picolibc.specs -mcpu=$1 -mthumb" ;;
    rv*)
        PREFIX=riscv64-unknown-elf- FLAGS="--specs=picolibc.specs $cpu -mcmodel=medany"
        LINK=$(memory 0x80000000 0x80400000)
        ;;
    esac
}
