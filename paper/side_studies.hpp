// What the schemes do as the paper prints them, where they are inconsistent or their scalar equation has no root: one
// figure each.
#pragma once

#include <paper/examples.hpp>

namespace seiche {

struct SideStudyOptions {
  bool quick = false;
  ReferenceOptions reference = {};
  int threads = 2;
  const std::atomic<bool>* stop = nullptr;
};

// When stopped, returns what was finished.
std::vector<SideStudy> side_studies(const SideStudyOptions& options);

}  // namespace seiche
