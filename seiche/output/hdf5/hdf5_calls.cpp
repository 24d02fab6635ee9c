#include <seiche/core/base/error.hpp>
#include <seiche/output/hdf5/hdf5_calls.hpp>

#include <hdf5.h>

namespace seiche {
namespace {

// "No space left on device", where the operating system said so; otherwise what HDF5 calls it.
std::string innermost_reason() {
  std::string reason;
  const auto read = [](unsigned, const H5E_error2_t* error, void* text) -> herr_t {
    if (error->desc != nullptr) *static_cast<std::string*>(text) = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, read, &reason);
  const std::string mark = "error message = '";
  const std::size_t begin = reason.find(mark);
  if (begin == std::string::npos) return reason.empty() ? "no reason was given" : reason;
  const std::size_t from = begin + mark.size();
  return reason.substr(from, reason.find('\'', from) - from);
}

}  // namespace

Hdf5Quiet::Hdf5Quiet() {
  H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Hdf5Quiet::~Hdf5Quiet() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }

void hdf5_check(int status, const std::string& what) {
  if (status < 0) throw Error("{}: {}", what, innermost_reason());
}

Hdf5Handle hdf5_handle(Hdf5Handle::Id id, Hdf5Handle::Close close, const std::string& what) {
  hdf5_check(id < 0 ? -1 : 0, what);
  return {id, close};
}

}  // namespace seiche
