// seiche recover: what a run that was killed has left, as files that can be read.
#include "command_line.hpp"

#include <fmt/format.h>
#include <seiche/core/error.hpp>
#include <seiche/driver/saved_run.hpp>
#include <seiche/output/file/folder_lock.hpp>
#include <seiche/output/hdf5/hdf5.hpp>
#include <seiche/output/run_folder.hpp>
#include <seiche/study/recovery.hpp>

#include <memory>

namespace seiche::cli {
namespace {

ExitCode recover_run(const std::string& directory) {
  hdf5_without_cleanup_at_exit();
  const Folder folder(directory);
  const FolderLock lock(folder);
  try {
    const Recovery found = recover(folder, case_of_checkpoint(directory));
    for (const std::string& file : found.saved) print_lines(fmt::format("{:<10} {}\n", "saved", file));
    for (const std::string& what : found.lost) print_lines(fmt::format("{:<10} {}\n", "lost", what));
    if (found.saved.empty() && found.lost.empty())
      print_note(fmt::format("{} holds no unfinished files: there is nothing to recover", directory));
  } catch (const std::exception& error) {
    print_failure(error.what());
    return unfinished_files(directory).empty() ? wrong_usage : computation_failed;
  }
  return unfinished_files(directory).empty() ? success : computation_failed;
}

}  // namespace

void add_recover(CLI::App& app, Action& action) {
  auto directory = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("recover", "Make readable what a run that was killed has left, and say what is lost");
  command->add_option("DIR", *directory, "The directory that the run left")->required()->type_name("");
  command->callback([directory, &action] { action = [directory] { return recover_run(*directory); }; });
}

}  // namespace seiche::cli
