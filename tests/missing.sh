#!/bin/sh
# Sourced: what a set of tests needs is installed when that is allowed; else it is said what to install.
missing=
need() { # PROGRAM PACKAGES
    command -v "$1" > /dev/null 2>&1 || missing="$missing $2"
}

# Ends the script: 0 when nothing was missing, or is any more.
install_missing() { # WHAT NEEDS IT, OPTIONS OF apt-get install
    [ -z "$missing" ] && exit 0
    if [ "$(id -u)" = 0 ] && command -v apt-get > /dev/null 2>&1; then
        echo "installing:$missing"
        DEBIAN_FRONTEND=noninteractive
        export DEBIAN_FRONTEND
        apt-get update -qq > /dev/null && apt-get install -y -qq $2 $missing > /dev/null && exit 0
    fi
    echo "$1 these packages: apt-get install$missing" >&2
    exit 1
}
