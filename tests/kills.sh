#!/bin/sh
# A hundred kills (or as many as asked for) of every kind of output, at random moments:
#   tests/kills.sh [kills [folder of the build]]
set -eu
cd "$(dirname "$0")/.."
PLEXWAY_KILLS="${1:-100}" "${2:-build}/bin/test_tool" '[kills]'
