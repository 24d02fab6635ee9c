// Pictures are drawn by Matplotlib: a request in JSON goes to the programs of python/seiche/drawing, run by Python.
#pragma once

#include <seiche/core/base/error.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace seiche {

// What a user asked for does not exist.
struct BadDrawingRequest : Error {
  using Error::Error;
};

// Draws into `into`, which exists. Request and answer, which says what was drawn, are in JSON; what they hold is said
// in python/seiche/drawing/__main__.py. Throws Error where Python or a package that it needs is missing, saying which,
// or where drawing fails, and BadDrawingRequest.
std::string draw(const std::string& request, const std::filesystem::path& into);

// The interpreter that SEICHE_PYTHON or `draw_with` names; else those to try in turn: where python3 belongs to an
// environment of its own, /usr/bin/python3 may have the packages.
std::vector<std::string> python_interpreters();

// The folder of these programs, and the interpreter that runs them, where the caller knows better than `draw`.
void draw_with(const std::filesystem::path& programs, const std::string& interpreter);

}  // namespace seiche
