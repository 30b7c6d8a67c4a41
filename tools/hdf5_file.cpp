#include "tools/hdf5_file.hpp"

#include <algorithm>

#include <hdf5.h>

#include "core/error.hpp"
#include "experiment/text_file.hpp"

namespace ballbot {
namespace {

[[noreturn]] void failed(const std::string& what) {
  throw OutputError(what + ": HDF5 could not make it. Is there enough memory?");
}

constexpr std::size_t kGrowth_bytes = std::size_t{1} << 20;

/// A file that lives in memory only.
hid_t createFile(const std::string& path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors are said once, by us
  const hid_t in_memory = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_fapl_core(in_memory, kGrowth_bytes, false);
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, in_memory);
  H5Pclose(in_memory);
  return file;
}

}  // namespace

struct Hdf5File::Impl {
  /// An HDF5 handle that closes itself; a negative one is the library's way to say it failed.
  class Handle {
   public:
    using Close = herr_t (*)(hid_t);
    Handle(hid_t id, Close close, const std::string& path) : id_(id), close_(close) {
      if (id < 0) failed(path);
    }
    ~Handle() { close_(id_); }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    operator hid_t() const { return id_; }

   private:
    hid_t id_;
    Close close_;
  };

  explicit Impl(const std::string& where)
      : path(where),
        file(createFile(where), H5Fclose, where),
        untimed(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, where) {
    H5Pset_obj_track_times(untimed, false);
  }
  hid_t place() const { return group ? static_cast<hid_t>(*group) : static_cast<hid_t>(file); }

  void write(const std::string& name, hid_t stored, hid_t given, hsize_t size, const void* data,
             const std::string& unit) {
    const std::string where = path + ", '" + name + "'";
    if (H5Lexists(place(), name.c_str(), H5P_DEFAULT) > 0)
      throw OutputError(where + ": is there already");
    const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, where);
    const Handle dataset(
        H5Dcreate2(place(), name.c_str(), stored, space, H5P_DEFAULT, untimed, H5P_DEFAULT),
        H5Dclose, where);
    if (H5Dwrite(dataset, given, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) failed(where);
    if (unit.empty()) return;
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, where);
    H5Tset_size(type, unit.size());
    const Handle scalar(H5Screate(H5S_SCALAR), H5Sclose, where);
    const Handle attribute(H5Acreate2(dataset, "unit", type, scalar, H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose, where);
    if (H5Awrite(attribute, type, unit.data()) < 0) failed(where);
  }

  std::string path;
  Handle file, untimed;
  std::unique_ptr<Handle> group;
};

Hdf5File::Hdf5File(const std::string& path) : impl_(std::make_unique<Impl>(path)) {}
Hdf5File::~Hdf5File() = default;

void Hdf5File::finish() {
  impl_->group.reset();
  if (H5Fflush(impl_->file, H5F_SCOPE_GLOBAL) < 0) failed(impl_->path);
  const ssize_t size = H5Fget_file_image(impl_->file, nullptr, 0);
  if (size <= 0) failed(impl_->path);
  std::string image(static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(impl_->file, image.data(), image.size()) != size) failed(impl_->path);
  writeTextFile(impl_->path, image);
}

void Hdf5File::beginGroup(const std::string& name) {
  impl_->group = std::make_unique<Impl::Handle>(
      H5Gcreate2(impl_->file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
      impl_->path);
}

void Hdf5File::addNumbers(const std::string& name, const std::vector<double>& values,
                          const std::string& unit) {
  impl_->write(name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.size(), values.data(),
               unit.empty() ? "1" : unit);
}

void Hdf5File::addTexts(const std::string& name, const std::vector<std::string>& texts) {
  std::size_t width = 1;
  for (const std::string& text : texts) width = std::max(width, text.size());
  std::string bytes(width * texts.size(), '\0');
  for (std::size_t i = 0; i < texts.size(); ++i) texts[i].copy(&bytes[i * width], width);
  const Impl::Handle type(H5Tcopy(H5T_C_S1), H5Tclose, impl_->path);
  H5Tset_size(type, width);
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  H5Tset_cset(type, H5T_CSET_UTF8);
  impl_->write(name, type, type, texts.size(), bytes.data(), "");
}

}  // namespace ballbot
