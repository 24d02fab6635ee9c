// Linked into the programs of a sanitizer build: CLN, under GiNaC, allocates its flags at start and never frees them.
extern "C" const char* __lsan_default_suppressions() { return "leak:libcln\n"; }
extern "C" const char* __lsan_default_options() { return "print_suppressions=0"; }
