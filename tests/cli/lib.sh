# What the tests of the command share: a folder of their own, small meshes, and one way to run and compare.
# Sourced by tests/cli/test_*.sh, which run in the project's root with MESHTOOL naming the command.
set -u
: "${MESHTOOL:?names the command to test}"
meshtool=$(realpath "$MESHTOOL")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
passed=0
failed=0

fail() {
  failed=$((failed + 1))
  printf 'FAILED: %s\n' "$*"
  [ ! -s "$folder/.err" ] || sed 's/^/  stderr: /' "$folder/.err" | head -5
}
pass() { passed=$((passed + 1)); }

# run CODE ARGUMENTS...: runs meshtool; its exit code must be CODE. Leaves $out and $err.
run() {
  local expected=$1 code
  shift
  "$meshtool" "$@" >"$folder/.out" 2>"$folder/.err" </dev/null
  code=$?
  { out=$(<"$folder/.out"); } 2>/dev/null # which says that zero bytes were left out
  err=$(<"$folder/.err")
  if [ "$code" = "$expected" ]; then pass; else fail "exit $code, expected $expected: meshtool $*"; fi
}

# says TEXT: the last run's standard error has the text; prints TEXT: its standard output has.
says() { case $err in *"$1"*) pass ;; *) fail "stderr lacks: $1" ;; esac; }
prints() { case $out in *"$1"*) pass ;; *) fail "stdout lacks: $1" ;; esac; }
silent() { if [ -z "$out" ]; then pass; else fail "stdout should be empty, has: $out"; fi; }
# holds WHAT COMMAND...: the command succeeds.
holds() {
  local what=$1
  shift
  if "$@" >"$folder/.holds" 2>&1; then pass; else fail "$what"; fi
}

finish() {
  printf '%d passed, %d failed\n' "$passed" "$failed"
  [ "$failed" = 0 ]
  exit
}

# A unit cube of quads, closed; the same without its last face; two tetrahedra that share one vertex.
cat >"$folder/cube.off" <<'END'
OFF
8 6 12
0 0 0
1 0 0
1 1 0
0 1 0
0 0 1
1 0 1
1 1 1
0 1 1
4 0 3 2 1
4 4 5 6 7
4 0 1 5 4
4 1 2 6 5
4 2 3 7 6
4 3 0 4 7
END
sed -e 's/^8 6 12$/8 5 12/' -e '$d' "$folder/cube.off" >"$folder/open.off"
cat >"$folder/bowtie.off" <<'END'
OFF
7 8 0
0 0 0
1 0 0
0 1 0
0 0 1
-1 0 0
0 -1 0
0 0 -1
3 0 2 1
3 0 1 3
3 0 3 2
3 1 2 3
3 0 4 5
3 0 6 4
3 0 5 6
3 4 6 5
END
# Three triangles on one edge.
cat >"$folder/book.off" <<'END'
OFF
5 3 0
0 0 0
0 0 1
1 0 0
0 1 0
-1 -1 0
3 0 1 2
3 0 1 3
3 0 1 4
END
# Two triangles turned opposite ways.
cat >"$folder/flipped.off" <<'END'
OFF
4 2 0
0 0 0
1 0 0
1 1 0
0 1 0
3 0 1 2
3 0 3 2
END
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 x 0\n3 0 1 2\n' >"$folder/bad.off"
