#include <seiche/config/case/case_file.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/text/input_file.hpp>
#include <seiche/driver/case_record.hpp>

#include <fmt/format.h>

#include <filesystem>
#include <utility>

namespace seiche {

CaseRecord::CaseRecord(const RunSpec& spec, RunKind kind, const std::string& headline, std::vector<std::string> notes,
                       const RunCaseOptions& options)
    : options_(options),
      kind_(kind),
      versions_(all_versions(options)),
      notes_(std::move(notes)),
      case_text_(write_case(spec)),
      hashes_(hashes_of(spec, case_text_)),
      stop_(begin_run(options)),
      own_folder_(std::in_place, spec.output_directory, kind, spec, options.restart),
      folder_(&*own_folder_) {
  if (options_.introduce) options_.introduce(headline, notes_);
}

CaseRecord::CaseRecord(GoingOn& from, const std::string& headline, const RunCaseOptions& options)
    : options_(options),
      kind_(from.from.run.kind),
      versions_(all_versions(options)),
      notes_(from.from.run.notes),
      case_text_(from.new_end ? write_case(from.spec) : from.from.run.case_text),
      hashes_(from.from.run.hashes),
      from_(&from),
      folder_(from.folder.get()) {
  const SavedRun& saved = from.from.run;
  hashes_["case.toml"] = sha256(case_text_);
  std::vector<std::string> said = {
      fmt::format("going on from {}, t = {:.9g} (step {})", from.from.name, saved.t, saved.steps)};
  for (std::string& note : notes_on_versions(saved, versions_)) said.push_back(std::move(note));
  notes_.insert(notes_.end(), said.begin() + 1, said.end());
  stop_ = begin_run(options);
  if (options_.introduce) options_.introduce(headline, said);
}

void CaseRecord::put_new_end() const {
  if (from_ != nullptr && from_->new_end) write_new_end(folder(), case_text_, *from_->new_end);
}

void CaseRecord::take_over() {
  if (from_ == nullptr) return;
  const std::filesystem::path path = folder().path() / "case.toml";
  const std::string found = text_of_file(path);
  if (found != case_text_ && found != from_->from.run.case_text && !is_of_before_new_end(found)) {
    const bool is_there = look_at(path).kind != InputKind::missing;
    notes_.push_back(is_there ? fmt::format("case.toml was not that of the checkpoint, which counts: it is {} now",
                                            put_aside(folder(), "case.toml", "case_before_resume.toml"))
                              : "case.toml was missing: it is that of the checkpoint again");
    if (options_.warn) options_.warn(notes_.back());
  }
  if (found != case_text_) write_file(folder(), "case.toml", case_text_);
  promote_checkpoint(folder(), from_->from.name);
  remove_what_tells_of_end(folder());
}

bool CaseRecord::is_of_before_new_end(const std::string& case_text) const {
  if (!from_->from.run.new_end) return false;
  try {
    RunSpec spec = parse_case(case_text, "case.toml", {}, folder().path());
    const bool is_settled = write_case(spec) == case_text;
    spec.t_end = from_->spec.t_end;
    spec.output_directory = from_->spec.output_directory;
    return is_settled && write_case(spec) == write_case(from_->spec);
  } catch (const Error&) {  // whatever it is
    return false;
  }
}

SavedRun CaseRecord::now(std::int64_t n, double t) const {
  SavedRun saved{.kind = kind_,
                 .versions = lines_of(versions_),
                 .case_text = case_text_,
                 .hashes = hashes_,
                 .notes = notes_,
                 .resumed_with = resumed_with(),
                 .new_end = {},
                 .t = t,
                 .steps = n,
                 .energies = {},
                 .solution = {}};
  if (from_ != nullptr && !goes_on()) saved.new_end = from_->from.run.new_end;
  return saved;
}

std::vector<ResumedWith> CaseRecord::resumed_with() const {
  if (from_ == nullptr) return {};
  const SavedRun& saved = from_->from.run;
  std::vector<ResumedWith> all = saved.resumed_with;
  if (goes_on())
    all.push_back({.t = saved.t, .versions = versions_, .end = from_->new_end ? from_->new_end : saved.new_end});
  return all;
}

}  // namespace seiche
