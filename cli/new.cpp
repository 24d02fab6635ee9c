// seiche new: a case file to start from, every key with its meaning.
#include "command_line.hpp"

#include <seiche/config/case/case_file.hpp>

#include <memory>

namespace seiche::cli {

void add_new(CLI::App& app, Action& action) {
  auto problem = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("new", "Print a commented case file");
  command->add_option("PROBLEM", *problem, "Its name; see seiche list problems")->required();
  command->callback([problem, &action] {
    action = [problem] {
      print_data(example_case(*problem));
      return success;
    };
  });
}

}  // namespace seiche::cli
