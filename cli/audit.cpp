// seiche audit: the energy books of a finished run, recomputed from its files.
#include "command_line.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <seiche/output/hdf5/hdf5.hpp>
#include <seiche/study/audit/audit.hpp>

#include <memory>

namespace seiche::cli {
namespace {

struct AuditArguments {
  std::string directory;
  bool json = false;
};

ExitCode run_audit(const AuditArguments& arguments) {
  hdf5_without_cleanup_at_exit();  // which of a damaged file says that it does not end
  const Audit result = audit(arguments.directory);
  if (arguments.json) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const AuditEntry& entry : result.entries)
      list.push_back({{"claim", entry.claim}, {"verdict", to_string(entry.verdict)}, {"evidence", entry.evidence}});
    print_data(nlohmann::ordered_json{{"confirms", result.confirms()}, {"entries", list}}.dump(2) + "\n");
  } else {
    std::string text;
    for (const AuditEntry& entry : result.entries)
      text += fmt::format("{:<13} {}\n              {}\n", to_string(entry.verdict), entry.claim, entry.evidence);
    print_data(text);
  }
  return result.confirms() ? success : computation_failed;
}

}  // namespace

void add_audit(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<AuditArguments>();
  CLI::App* command =
      app.add_subcommand("audit", "Recompute the energy books of a finished run or ensemble from its files");
  command->add_option("DIR", arguments->directory, "The directory that a run left")->required()->type_name("");
  command->add_flag("--json", arguments->json, "Print one JSON document on stdout");
  command->callback([arguments, &action] { action = [arguments] { return run_audit(*arguments); }; });
}

}  // namespace seiche::cli
