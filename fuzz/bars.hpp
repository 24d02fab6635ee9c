// What every execution of a fuzzer keeps to, beside having no crash and no leak: it takes no more than ten seconds of a
// processor and half a gigabyte, and what it refuses, it refuses by an exception that the program turns into one line.
#pragma once

#include <functional>
#include <string_view>

namespace seiche::fuzz {

// Ends the process with abort, saying which bar was missed, so that the input is kept. A refusal may quote `input`, and
// so hold words that are otherwise those of a library.
void within_bars(const std::function<void()>& execution, std::string_view input = {});

}  // namespace seiche::fuzz
