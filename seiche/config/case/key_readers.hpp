// How keys of a case file are read: numbers within the bounds of their rows, and keys that hang together with others.
#pragma once

#include <seiche/config/case/key_rows.hpp>

#include <functional>
#include <string>
#include <vector>

namespace seiche {

// Each throws Error with the key, the value and what is allowed.
double read_number_within(const KeyRow& row, const std::string& key, const CaseValue& value);
long read_whole_within(const KeyRow& row, const std::string& key, const CaseValue& value);

// An option of methods is validated alone too, so that a complaint stands at the key that caused it.
void read_option(CaseReading& r, const std::string& key, const CaseValue& value,
                 const std::function<void(MethodOptions&)>& set);

std::vector<std::string> or_auto(std::vector<std::string> names);  // "auto" first

ReadKey read_method;
ReadKey read_step_size;
ReadKey read_tolerance;
ReadKey read_h_max;
ReadKey read_shift;
ReadKey read_start;
ReadKey read_end;
ReadKey read_backend;
ReadKey read_directory;
ReadKey read_snapshot_interval;
ReadKey read_join_below;
ReadKey read_every_seconds;

}  // namespace seiche
