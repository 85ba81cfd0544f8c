#!/usr/bin/env bash
# Runs every fuzz target: run.sh BUILD [SECONDS [TARGET...]]. Corpora grow in BUILD/corpus; seeds are written there
# anew, and the files under meshes/ are read as seeds too. Fails when a target finds something, which is then kept in
# BUILD/findings.
set -euo pipefail

build=$1
seconds=${2:-60}
shift $(($# < 2 ? $# : 2))
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
mkdir -p "$build/corpus" "$build/findings"
"$build/fuzz_seeds" "$build/corpus"

targets=("$@")
if [[ ${#targets[@]} -eq 0 ]]; then
  for target in "$build"/fuzz_*; do
    name=$(basename "$target")
    [[ -x $target && ! -d $target && $name != fuzz_seeds ]] && targets+=("${name#fuzz_}")
  done
fi

failed=0
for format in "${targets[@]}"; do
  corpus=$build/corpus/$format
  mkdir -p "$corpus"
  while IFS= read -r file; do
    cp -n "$file" "$corpus/seed-$(basename "$file")"
  done < <(find "$root/meshes" -name "*.$format" -size -64k 2>/dev/null)
  [[ $format == scene ]] && cp -n "$root"/meshes/scenes/*.json "$corpus"/
  dictionary=()
  [[ -f $root/tests/fuzz/$format.dict ]] && dictionary=("-dict=$root/tests/fuzz/$format.dict")
  echo "== $format, $seconds s"
  if ! "$build/fuzz_$format" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=2048 -max_len=65536 -print_final_stats=1 \
    -verbosity=0 -artifact_prefix="$build/findings/$format-" ${dictionary[@]+"${dictionary[@]}"} "$corpus" >"$build/findings/$format.log" 2>&1; then
    failed=1
    tail -n 40 "$build/findings/$format.log"
  else
    grep -E "stat::number_of_executed_units" "$build/findings/$format.log" || true
  fi
done
exit $failed
