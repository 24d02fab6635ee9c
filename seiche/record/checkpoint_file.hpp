// A checkpoint as a file: a line that says what it is, the bytes of an archive, and their number and CRC-32.
#pragma once

#include <seiche/core/base/function_ref.hpp>
#include <seiche/core/control/archive.hpp>
#include <seiche/output/file/folder.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace seiche {

// The newest, and the one before it, which serves where the newest is damaged.
inline constexpr const char* checkpoint_name = "checkpoint.seiche";
inline constexpr const char* earlier_checkpoint_name = "checkpoint_prev.seiche";

// What `contents` writes becomes the newest checkpoint of the folder once it is on the disk; with `keeps_earlier` the
// newest so far stays as the earlier one. Throws Error where it cannot be written, when `contents` has come to its end,
// since it may be a work of several processes; the newest so far is there all the same, at the latest as the earlier
// one.
void commit_checkpoint(const Folder& folder, bool keeps_earlier, FunctionRef<void(Archive&)> contents);
// Throws Error where it cannot be read, is damaged, or is of another format. `is_checked`: another process has found
// its checksum right.
Archive read_checkpoint_file(const std::filesystem::path& file, bool is_checked = false);
// The first bytes of the contents of a whole checkpoint, so many, become what `contents` writes; all else stays as it
// is. Throws Error where it cannot be read to its end, or written.
void replace_beginning(const Folder& folder, const std::string& name, std::uint64_t bytes,
                       FunctionRef<void(Archive&)> contents);

// By how it begins: of any version, whole or not.
bool is_checkpoint(const std::filesystem::path& file);
// Their names, the newest first; links that lead nowhere are among them, since a word about these is due.
std::vector<std::string> checkpoints_in(const std::filesystem::path& directory);
// The one of this name becomes the newest, if it is the earlier one, since a run goes on from it: else the next commit
// would put the damaged one in its place. Where that cannot be, both stay.
void promote_checkpoint(const Folder& folder, const std::string& name);
void remove_checkpoints(const Folder& folder);  // does nothing where it holds none

}  // namespace seiche
