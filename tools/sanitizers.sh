# Sourced: how the sanitizers behave in a test run. Leaks in our code fail a test; what tools/lsan.supp names is of
# libraries.
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
mkdir -p "$top/build-asan"
gcc -shared -fPIC -o "$top/build-asan/libkeep_loaded.so" "$top/tools/keep_loaded.c"
# The preloaded library stands before the sanitizer's, which does it no harm.
export ASAN_OPTIONS="detect_leaks=1:strict_string_checks=1:detect_stack_use_after_return=1:allocator_may_return_null=1"
export ASAN_OPTIONS="$ASAN_OPTIONS:verify_asan_link_order=0"
export LSAN_OPTIONS="suppressions=$top/tools/lsan.supp:print_suppressions=0"
export UBSAN_OPTIONS="print_stacktrace=1:halt_on_error=1"
export LD_PRELOAD="$top/build-asan/libkeep_loaded.so"
