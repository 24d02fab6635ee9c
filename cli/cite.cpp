// seiche cite: what to put into the references of a paper.
#include "command_line.hpp"

#include <seiche/output/citation.hpp>

namespace seiche::cli {

void add_cite(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("cite", "How to cite Seiche and the paper it implements, in BibTeX");
  command->callback([&action] {
    action = [] {
      print_data(citation());
      return success;
    };
  });
}

}  // namespace seiche::cli
