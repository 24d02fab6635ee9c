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
      const std::string text = example_case(*problem);  // first, since it refuses unknown names
      print_data(
          "#:schema seiche.schema.json\n# With what `seiche schema > seiche.schema.json` writes beside it, editors "
          "that know TOML check and complete this file.\n\n" +
          text);
      return success;
    };
  });
}

}  // namespace seiche::cli
