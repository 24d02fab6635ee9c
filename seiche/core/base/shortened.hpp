// What users wrote, as it stands in a sentence: short and on one line, whatever it holds.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace seiche {

// At most `most` bytes and "…" behind them, cut between characters. New lines and tabs become blanks, and other control
// characters and what is no UTF-8 "?", so that no text moves the cursor of a terminal.
std::string shortened(std::string_view text, std::size_t most = 60);
// The same, but of a path the end is kept, where the file's own name is.
std::string shortened_path(std::string_view path, std::size_t most = 120);
// A whole sentence: lines are joined by blanks, and of a long one the middle is left out. As long as it may be, so that
// with the name of the program before it, its line has at most 400 bytes.
std::string one_line(std::string_view sentence, std::size_t most = 380);

// True if the text is in UTF-8, as what is written to TOML and JSON must be.
bool is_utf8(std::string_view text);

}  // namespace seiche
