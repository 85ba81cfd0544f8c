#!/usr/bin/env bash
# What the sources of lib, formats and cli must not contain, and why: see the rules below. Comments and strings do not
# count. Run in the project's root; with BUILD naming a build folder, the symbols of its library are checked too.
set -u
support=$PWD/tests/support

transcendental='sin|cos|tan|sincos|asin|acos|atan|atan2|sinh|cosh|tanh|asinh|acosh|atanh|pow|exp|exp2|exp10|expm1'
transcendental+='|log|log2|log10|log1p|cbrt|hypot|fma|erf|erfc|tgamma|lgamma'
printing='printf|vprintf|puts|putchar|putc_unlocked|putchar_unlocked|perror'
ending='exit|_Exit|_exit|quick_exit|abort|terminate'
largest_file=450
largest_function=60

fail_count=0

# search FOLDERS ALLOWED PATTERN REASON: complains about every line of sources under FOLDERS that matches the extended
# regular expression PATTERN, except in the files ALLOWED, an extended regular expression too.
search() {
    local place
    while IFS= read -r place; do
        fail_count=$((fail_count + 1))
        printf '%s\n    %s\n' "$place" "$4"
    done < <(grep -E "^($1)/[^:]*:[0-9]+:(.*[^A-Za-z0-9_])?($3)" "$stripped" | grep -v -E "^($2):")
}

check_sizes() {
    local line
    while IFS= read -r line; do
        fail_count=$((fail_count + 1))
        printf '%s\n' "$line"
    done < <(xargs -r awk -v file_limit=$largest_file -v function_limit=$largest_function '
        function finish() {
            if (count > file_limit) {
                print name ": " count " lines, of at most " file_limit "; carve it by nouns"
            }
        }
        FNR == 1 { finish(); name = FILENAME; start = 0 }
        { count = FNR }
        /^\{/ { start = FNR }
        /^\}[ \t]*$/ && start {
            if (FNR - start > function_limit + 1) {
                print FILENAME ":" start ": a function of " FNR - start - 1 " lines, of at most " function_limit
            }
            start = 0
        }
        END { finish() }')
}

# check_tree ROOT: complains about everything banned; sets fail_count and file_count.
check_tree() {
    local here=$PWD files
    cd "$1" || return
    fail_count=0
    stripped=$(mktemp)
    files=$(find lib formats cli -type f \( -name '*.[ch]' -o -name '*.[ch]pp' \) 2>/dev/null | LC_ALL=C sort)
    file_count=$(grep -c . <<<"$files")
    xargs -r awk -f "$support/strip_comments.awk" <<<"$files" >"$stripped"
    search 'lib|formats|cli' none "(${transcendental})[fl]?[ ]*\\(" \
        'libm rounds this differently on different processors; call the mt_ function of meshtool/elementary.h'
    search 'lib|formats|cli' none '(ffp-contract|FP_CONTRACT|fast_math|fast-math)' 'contraction changes results between machines'
    search 'lib|formats' none "(${ending})[ ]*\\(" 'a library does not end the process; return a status'
    search 'lib|formats' none "(${printing})[ ]*\\(" 'a library does not print; use the context, or an output'
    search 'lib|formats' none '(stdout|stderr)($|[^A-Za-z0-9_])' 'a library does not print; use the context, or an output'
    search 'lib|formats|cli' 'lib/base/parallel\.c' '(#[ ]*pragma[ ]+omp|_Pragma[ ]*\(|include[ ]*<omp\.h>|omp_[a-z])' \
        'only lib/base/parallel.c knows OpenMP; call mt_parallel_for'
    search 'lib|formats' 'lib/base/(memory|context)\.c' '(malloc|calloc|realloc|aligned_alloc|alloca|strdup|strndup|asprintf)[ ]*\(' \
        'memory comes from the context: mt_allocate and its kin'
    search 'lib|formats|cli' none '__(DATE|TIME|TIMESTAMP)__' 'the same sources must give the same bytes'
    check_sizes <<<"$files"
    rm -f "$stripped"
    cd "$here" || return
}

# check_symbols LIBRARY: complains about banned functions that the compiled library calls, however they got there.
check_symbols() {
    local symbol
    while IFS= read -r symbol; do
        fail_count=$((fail_count + 1))
        printf '%s calls %s, which is banned (see tests/unit/test_banned.sh)\n' "$1" "$symbol"
    done < <(nm -A -u "$1" 2>/dev/null | grep -v -E ' (_ZSt|__(asan|ubsan|tsan))' |
        grep -E " U (((${transcendental})[fl]?)|${printing}|${ending}|stdout|stderr)(@.*)?$" | sed 's/:[ ]*U /: /')
}

# Plants violations in a temporary tree; each must be found, and nothing else.
self_test() {
    local folder output missed=0 expected count=0
    folder=$(mktemp -d)
    mkdir -p "$folder/lib/base" "$folder/formats/mesh" "$folder/cli"
    plant() {
        printf '%s\n' "$2" >"$folder/$1"
    }
    plant lib/base/good.c '/* sin(x), printf("%d"), abort() and #pragma omp in a
 * comment: exp(x) */
static double mt_sin(double x); // cos(x)
static const char *text = "exit(1) \" log(x)"; static char quote = '"'\"'"'; static double y = mt_sin(2.0);
static double asine(double x); struct log log; int expo(int); double my_pow(double);'
    plant lib/base/parallel.c '#pragma omp parallel for'
    plant lib/base/memory.c 'void *a = malloc(5);'
    plant cli/main.c 'int main(void) { printf("%d", 1); exit(1); }'
    check_tree "$folder" >/dev/null
    if [[ $fail_count != 0 ]]; then
        echo "self-test: a tree without a violation was complained about:"
        check_tree "$folder"
        missed=1
    fi
    violation() {
        count=$((count + 1))
        plant "$1" "$2"
        expected+=("$1:${3-1}")
    }
    expected=()
    violation lib/base/a.c 'double a = sin(x);'
    violation lib/base/b.c 'float b = 2*powf (x, 2);'
    violation formats/mesh/c.cpp 'double c = std::hypot(x, y);'
    violation cli/d.c 'double d = cbrt(x);'
    violation lib/base/e.c '/* reason */ abort();'
    violation formats/mesh/f.c 'exit(2);'
    violation lib/base/g.c 'printf("%s", "x");'
    violation formats/mesh/h.c 'fprintf(stdout, "x");'
    violation formats/mesh/i.c '#pragma omp parallel'
    violation cli/j.c '#include <omp.h>'
    violation cli/k.c 'const char *built = __DATE__;'
    violation lib/base/l.c 'char *t = "a" __TIME__;'
    violation lib/base/m.c 'void *m = malloc(3);'
    violation lib/base/n.c 'double n = "/*" ? exp(1) : 0; /* */'
    violation lib/base/o.c $'/* long\n * comment */\ndouble o = log(3);' 3
    plant lib/base/long.c "$(seq -f 'int line_%g;' 451)"
    plant cli/function.c "$(printf 'int f(void)\n{\n'; seq -f '    g(%g);' 61; printf '}\n')"
    expected+=(lib/base/long.c cli/function.c:2)
    count=$((count + 2))
    output=$(check_tree "$folder")
    for place in "${expected[@]}"; do
        if [[ $'\n'$output != *$'\n'"$place:"* ]]; then
            echo "self-test: the violation planted at $place was not found"
            missed=1
        fi
    done
    check_tree "$folder" >/dev/null
    if [[ $fail_count != "$count" ]]; then
        echo "self-test: $count violations were planted, these $fail_count were found:"
        check_tree "$folder"
        missed=1
    fi
    printf 'double sin(double);\nint puts(const char *);\ndouble f(double x) { puts("x"); return sin(x); }\n' |
        "${CC:-cc}" -O0 -x c -c -o "$folder/banned.o" -
    output=$(check_symbols "$folder/banned.o")
    if [[ $output != *"banned.o: sin, "* || $output != *"banned.o: puts, "* ]]; then
        echo "self-test: banned symbols were not found"
        missed=1
    fi
    rm -rf "$folder"
    return $missed
}

self_test || exit 1
check_tree .
if [[ -n ${BUILD-} && -e $BUILD/libmeshtool.a ]]; then
    check_symbols "$BUILD/libmeshtool.a"
fi
echo "$file_count files, $fail_count violations"
[[ $file_count -gt 0 && $fail_count == 0 ]]
