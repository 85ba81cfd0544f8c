#!/usr/bin/env bash
# Where each operation breaks as meshes grow extreme, beside tests/cli/extremes.txt: that table may only get better.
# `bash tests/cli/test_extremes.sh --update` writes it anew.
. tests/cli/lib.sh
table=tests/cli/extremes.txt

# Without the errors found on the way, which are no promise: extreme, operation, precision, verdict, magnitude, why.
"$meshtool" tradeoff --extremes | sed -E 's/ +[0-9.e+-]+ of [0-9.e+-]+ +/  /' >"$folder/extremes.txt"
if [ "${1-}" = --update ]; then
  cp "$folder/extremes.txt" "$table"
  exit
fi
holds "every sweep was made" test "$(wc -l <"$folder/extremes.txt")" -gt 200
holds "nothing breaks before its input does" test "$(grep -c 'a defect' "$folder/extremes.txt")" = 0
if diff "$table" "$folder/extremes.txt" >"$folder/.err"; then pass; else fail "extremes differ from $table"; fi
finish
