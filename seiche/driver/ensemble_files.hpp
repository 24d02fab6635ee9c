// The tables that an ensemble leaves.
#pragma once

#include <seiche/ensemble/ensemble.hpp>
#include <seiche/ensemble/members.hpp>
#include <seiche/output/csv_row.hpp>
#include <seiche/output/file/atomic_file.hpp>

namespace seiche {

// energy.csv, row by row as the run goes on.
class StatisticsFile {
 public:
  StatisticsFile(const Folder& folder, bool has_modified);
  // Goes on behind the mark in the file that an earlier run has left, with what `archive` wrote then.
  StatisticsFile(const Folder& folder, bool has_modified, const FileMark& mark, Archive& archive);
  FileMark mark() { return file_.mark(); }  // with its rows on the disk
  void archive(Archive& a);

  void write(const EnsembleRecord& record);
  void commit() { file_.commit_lines(); }

  // Of members whose energy was a number; without any, statistics of nothing.
  const EnsembleRecord& first() const { return first_; }
  const EnsembleRecord& last() const { return last_; }

 private:
  void add(const Statistics& s);

  AtomicFile file_;
  bool has_modified_;
  CsvRow row_;
  EnsembleRecord first_{.H = statistics({}), .modified = statistics({})};
  EnsembleRecord last_ = first_;
};

// members.csv: one row for each member.
void write_members(const Folder& folder, const Members& members, const EnsembleResult& result, bool has_modified);

// finals.csv: one row for each member that started, its last good state.
void write_finals(const Folder& folder, const Problem& problem, const EnsembleResult& result);

}  // namespace seiche
