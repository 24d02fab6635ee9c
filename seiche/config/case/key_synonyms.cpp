#include <seiche/config/case/key_synonyms.hpp>

#include <algorithm>
#include <cctype>
#include <vector>

namespace seiche {
namespace {

struct Synonyms {
  const char* section;
  const char* key;
  std::vector<std::string> words;  // lower case, without "_"
};

const std::vector<Synonyms>& synonyms() {
  static const std::vector<Synonyms> all = {
      {"method", "name", {"method", "solver", "integrator", "scheme"}},
      {"method", "h", {"dt", "h0", "dt0", "deltat", "step", "stepsize", "timestep", "timestepsize", "firststep"}},
      {"method",
       "tolerance",
       {"tol", "rtol", "atol", "reltol", "abstol", "relativetolerance", "absolutetolerance", "accuracy", "precision"}},
      {"method", "h_max", {"hmax", "maxh", "dtmax", "maxdt", "maxstep", "maxstepsize", "maximumstep"}},
      {"time", "end", {"t", "tend", "tmax", "tfinal", "finaltime", "endtime", "tstop", "duration"}},
      {"output", "directory", {"dir", "folder", "out", "outdir"}},
      {"output", "snapshot_interval", {"saveat", "dtout", "dtsave", "saveinterval"}},
      {"output", "snapshot_every", {"saveevery", "nsave", "nout"}},
      {"problem", "initial", {"z0", "y0", "u0", "ic", "initialcondition", "initialconditions", "initialstate"}},
      {"problem", "boundary", {"bc", "bcs", "boundaryconditions", "boundarycondition"}},
      {"problem", "points", {"n", "nx", "gridpoints", "resolution"}},
      {"problem", "length", {"l", "lx", "domain"}},
  };
  return all;
}

}  // namespace

MeantKey meant_key(std::string_view word) {
  std::string plain;
  for (const char c : word)
    if (c != '_' && c != '-') plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const Synonyms& key : synonyms())
    if (std::find(key.words.begin(), key.words.end(), plain) != key.words.end()) return {key.section, key.key};
  return {};
}

}  // namespace seiche
