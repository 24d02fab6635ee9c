// Attributes, and the three of them by which a data set says what its axes are: CLASS and NAME of a scale,
// DIMENSION_LIST of its users, REFERENCE_LIST back from the scale (HDF5 Dimension Scale Specification). They are
// written as the high-level library of HDF5 does, which would be one more library for them alone.
#include <seiche/output/hdf5/hdf5_attributes.hpp>
#include <seiche/output/hdf5/hdf5_calls.hpp>

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <cstddef>
#include <string>

namespace seiche {
namespace {

Hdf5Handle type_handle(hid_t id) { return hdf5_handle(id, H5Tclose, "no type for an HDF5 attribute"); }

void write(Hdf5Handle::Id object, const std::string& name, hid_t type, const Hdf5Handle& space, const void* value) {
  const std::string what = fmt::format("cannot write the attribute {}", name);
  const Hdf5Handle attribute =
      hdf5_handle(H5Acreate2(object, name.c_str(), type, space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, what);
  hdf5_check(H5Awrite(attribute.id(), type, value), what);
}

Hdf5Handle scalar() { return hdf5_handle(H5Screate(H5S_SCALAR), H5Sclose, "no space for an HDF5 attribute"); }

Hdf5Handle list_of(std::size_t size) {
  const hsize_t length = size;
  return hdf5_handle(H5Screate_simple(1, &length, nullptr), H5Sclose, "no space for an HDF5 attribute");
}

Hdf5Handle text_type() {
  Hdf5Handle type = type_handle(H5Tcopy(H5T_C_S1));
  H5Tset_size(type.id(), H5T_VARIABLE);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  return type;
}

// Readers look for these two with a fixed length.
void set_fixed_text(Hdf5Handle::Id object, const std::string& name, const std::string& text) {
  const Hdf5Handle type = type_handle(H5Tcopy(H5T_C_S1));
  H5Tset_size(type.id(), text.size() + 1);
  write(object, name, type.id(), scalar(), text.c_str());
}

struct Use {
  hobj_ref_t data;
  int axis;
  int filler = 0;  // not left to chance: it goes into the file
};

hobj_ref_t reference_to(const Hdf5File& file, const Hdf5Dataset& data) {
  hobj_ref_t reference = 0;
  hdf5_check(H5Rcreate(&reference, file.id(), data.name().c_str(), H5R_OBJECT, -1), "no reference to " + data.name());
  return reference;
}

void set_scales_of(const Hdf5File& file, const Hdf5Axes& axes) {
  const Hdf5Handle type = type_handle(H5Tvlen_create(H5T_STD_REF_OBJ));
  std::vector<hobj_ref_t> references;
  for (const Hdf5Dataset* scale : axes.scales) references.push_back(reference_to(file, *scale));
  std::vector<hvl_t> lists;
  for (hobj_ref_t& reference : references) lists.push_back({1, &reference});
  write(axes.data->id(), "DIMENSION_LIST", type.id(), list_of(lists.size()), lists.data());
}

void set_users_of(const Hdf5Dataset& scale, const std::vector<Use>& uses) {
  const Hdf5Handle type = type_handle(H5Tcreate(H5T_COMPOUND, sizeof(Use)));
  H5Tinsert(type.id(), "dataset", offsetof(Use, data), H5T_STD_REF_OBJ);
  H5Tinsert(type.id(), "dimension", offsetof(Use, axis), H5T_NATIVE_INT);
  write(scale.id(), "REFERENCE_LIST", type.id(), list_of(uses.size()), uses.data());
}

}  // namespace

void set_attribute(Hdf5Handle::Id object, const std::string& name, std::string_view text) {
  const Hdf5Quiet quiet;
  const std::string ended(text);
  const char* const value = ended.c_str();
  const Hdf5Handle type = text_type();
  if (H5Aexists(object, name.c_str()) <= 0)
    return write(object, name, type.id(), scalar(), static_cast<const void*>(&value));
  const std::string what = fmt::format("cannot write the attribute {}", name);
  const Hdf5Handle attribute = hdf5_handle(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, what);
  hdf5_check(H5Awrite(attribute.id(), type.id(), static_cast<const void*>(&value)), what);
}

std::string text_attribute(Hdf5Handle::Id object, const std::string& name) {
  const Hdf5Quiet quiet;
  if (H5Aexists(object, name.c_str()) <= 0) return "";
  const std::string what = fmt::format("cannot read the attribute {}", name);
  const Hdf5Handle attribute = hdf5_handle(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, what);
  char* value = nullptr;
  hdf5_check(H5Aread(attribute.id(), text_type().id(), static_cast<void*>(&value)), what);
  const std::string text = value != nullptr ? value : "";
  H5free_memory(value);
  return text;
}

void attach_scales(const Hdf5File& file, const std::vector<Hdf5Axes>& all) {
  const Hdf5Quiet quiet;
  std::vector<const Hdf5Dataset*> scales;
  for (const Hdf5Axes& axes : all)
    for (const Hdf5Dataset* scale : axes.scales)
      if (std::find(scales.begin(), scales.end(), scale) == scales.end()) scales.push_back(scale);
  for (const Hdf5Dataset* scale : scales) {
    set_fixed_text(scale->id(), "CLASS", "DIMENSION_SCALE");
    set_fixed_text(scale->id(), "NAME", scale->name());
    std::vector<Use> uses;
    for (const Hdf5Axes& axes : all)
      for (std::size_t i = 0; i < axes.scales.size(); ++i)
        if (axes.scales[i] == scale) uses.push_back({reference_to(file, *axes.data), static_cast<int>(i)});
    set_users_of(*scale, uses);
  }
  for (const Hdf5Axes& axes : all) set_scales_of(file, axes);
}

}  // namespace seiche
