#!/usr/bin/env bash
# The committed meshes are what their two scripts write, with the meshtool of today. Run in the project's root, with the
# binary in MESHTOOL.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
bash tests/support/make_meshes.sh "$folder"
bash tests/support/make_malformed.sh "$folder/malformed"
if ! diff -r -x manifest.csv -x teapot.png -x tradeoff.png -x scenes meshes "$folder"; then
    echo "meshes/ differs from what tests/support/make_meshes.sh and make_malformed.sh write" >&2
    exit 1
fi
