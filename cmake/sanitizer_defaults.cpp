// Linked into the programs of a sanitizer build. CLN, under GiNaC, allocates its flags at start and never frees them:
// what the constructors of libraries allocate is no leak, and not looked at, since each process would start a
// symbolizer for it. GiNaC 1.8 loses an expression where one of its own derivatives throws, as that of log(0) does;
// HDF5 leaves objects behind where it finds a file damaged.
#include <sanitizer/lsan_interface.h>

extern "C" const char* __lsan_default_suppressions() { return "leak:libcln\nleak:libginac.so\nleak:libhdf5\n"; }
extern "C" const char* __lsan_default_options() { return "print_suppressions=0"; }

namespace {
[[gnu::section(".preinit_array"), gnu::used]] void (*const before_libraries)() = __lsan_disable;
[[gnu::constructor(101)]] void behind_libraries() { __lsan_enable(); }
}  // namespace
