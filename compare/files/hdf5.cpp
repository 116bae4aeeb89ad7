#include "compare/files/hdf5.hpp"

#include <hdf5.h>

#include <algorithm>
#include <type_traits>
#include <utility>

#include "compare/files/bytes.hpp"
#include "compare/files/durable_file.hpp"
#include "compare/files/packing.hpp"
#include "compare/problem/error.hpp"

namespace ogc::compare {
namespace {

static_assert(std::is_same_v<hid_t, std::int64_t> && std::is_same_v<herr_t, int>,
              "the header names HDF5's types by what they are");

template <class T>
hid_t native_type() {
  if constexpr (std::is_same_v<T, float>) return H5T_NATIVE_FLOAT;
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
  if constexpr (std::is_same_v<T, std::int64_t>) return H5T_NATIVE_INT64;
}

void silence() {
  static const bool silent = H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr) >= 0;
  static_cast<void>(silent);
}

using Lock = std::lock_guard<std::recursive_mutex>;

/// Deflate compresses at most 1,032 bytes into one byte. The shuffle filter keeps the size.
constexpr std::size_t most_unpacked = 1032;

std::vector<hsize_t> shape_of(hid_t dataset) {
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  const int rank = space.valid() ? H5Sget_simple_extent_ndims(space.id()) : -1;
  std::vector<hsize_t> shape(static_cast<std::size_t>(std::max(rank, 0)));
  if (rank > 0) H5Sget_simple_extent_dims(space.id(), shape.data(), nullptr);
  return shape;
}

/// Returns the number of rows in a chunk of a dataset that is written `part` rows at a time. If parts are small, a
/// chunk holds several whole parts. Otherwise each part is cut into chunks of nearly equal size.
std::size_t rows_in_chunk(std::size_t part) {
  return part < smallest_chunk_rows ? part * divide_up(smallest_chunk_rows, part) : even_chunk_rows(part);
}

/// Returns HDF5's creation list for a dataset, chunked and compressed if that saves space.
Hdf5Handle creation_list(const std::vector<hsize_t>& shape, std::size_t part) {
  Hdf5Handle list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  // Without stored times, equal contents give equal files.
  H5Pset_obj_track_times(list.id(), false);
  std::vector<hsize_t> chunk = shape;
  chunk[0] = rows_in_chunk(part);
  if (chunk[0] <= shape[0]) {
    H5Pset_chunk(list.id(), static_cast<int>(chunk.size()), chunk.data());
    H5Pset_shuffle(list.id());
    if (H5Zfilter_avail(H5Z_FILTER_DEFLATE) > 0) H5Pset_deflate(list.id(), 1);
  }
  return list;
}

Hdf5Handle scalar_or_row(std::size_t count) {
  const hsize_t length = count;
  return {count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &length, nullptr), H5Sclose};
}

Hdf5Handle text_type(std::size_t size) {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  if (H5Tset_size(type.id(), size) < 0 || H5Tset_strpad(type.id(), H5T_STR_NULLPAD) < 0) type.release();
  return type;
}

bool write_attribute(hid_t file, const std::string& object, const std::string& name, hid_t type,
                     const Hdf5Handle& space, const void* values) {
  const Hdf5Handle attribute(
      H5Acreate_by_name(file, object.c_str(), name.c_str(), type, space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  return attribute.valid() && H5Awrite(attribute.id(), type, values) >= 0;
}

}  // namespace

std::recursive_mutex& hdf5_library() {
  static std::recursive_mutex mutex;
  return mutex;
}

Hdf5Handle& Hdf5Handle::operator=(Hdf5Handle&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(close_, other.close_);
  return *this;
}

bool Hdf5Handle::release() {
  if (id_ < 0) return true;
  const Lock lock(hdf5_library());
  return close_(std::exchange(id_, -1)) >= 0;
}

void Hdf5File::refuse_read(const std::string& what) const {
  throw InputError(path_.string() + ": " + what + ": not an HDF5 file as a run writes it, or damaged; use another one");
}

void Hdf5File::refuse_write(const std::string& what) const {
  throw ResourceError(path_.string() + ": can't write " + what +
                      ": free space there, or choose a folder on another disk");
}

Hdf5File Hdf5File::create(const std::filesystem::path& path, std::size_t size) {
  const Lock lock(hdf5_library());
  write_and_reserve(path, create_in_memory(path).image(), size);
  Hdf5File file(path, {H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose});
  if (!file.file_.valid()) file.refuse_write("the file");
  return file;
}

Hdf5File Hdf5File::create_in_memory(const std::filesystem::path& name) {
  const Lock lock(hdf5_library());
  silence();
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  const bool set = H5Pset_fapl_core(access.id(), 1 << 20, false) >= 0;
  Hdf5File file(name, {set ? H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()) : -1, H5Fclose});
  if (!file.file_.valid()) throw ResourceError(name.string() + ": not enough memory to prepare the file; free some");
  return file;
}

Hdf5File Hdf5File::open(const std::filesystem::path& path) {
  const Lock lock(hdf5_library());
  silence();
  if (std::filesystem::exists(path)) expect_regular_file(path);
  Hdf5File file(path, {H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose});
  if (!file.file_.valid()) file.refuse_read(std::filesystem::exists(path) ? "can't be opened" : "is missing");
  return file;
}

void Hdf5File::create_group(const std::string& name) {
  const Lock lock(hdf5_library());
  const Hdf5Handle group(H5Gcreate2(file_.id(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  if (!group.valid()) refuse_write("group " + name);
}

template <class T>
void Hdf5File::create_dataset(const std::string& name, std::size_t rows, std::size_t columns, std::size_t part) {
  const Lock lock(hdf5_library());
  std::vector<hsize_t> shape{rows};
  if (columns > 0) shape.push_back(columns);
  const Hdf5Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose);
  const Hdf5Handle list = creation_list(shape, part);
  const Hdf5Handle dataset(
      H5Dcreate2(file_.id(), name.c_str(), native_type<T>(), space.id(), H5P_DEFAULT, list.id(), H5P_DEFAULT),
      H5Dclose);
  if (!dataset.valid()) refuse_write(name);
}

// Adds these upper limits:
// - each chunk: its rows, uncompressed; the last chunk is stored whole
// - each chunk: 128 B in a leaf of the index (a leaf has 32 to 64 chunks and at most 4 KiB, with keys of 3 extents)
// - each chunk: 128 B for the upper levels of the index
// - 4 KiB for object header, group entry and attributes, and 4 KiB for the root of the index, nearly empty or not
std::size_t Hdf5File::largest_size(std::size_t rows, std::size_t row_bytes, std::size_t part) {
  const std::size_t in_chunk = rows_in_chunk(part), chunks = divide_up(rows, in_chunk);
  return chunks * (in_chunk * row_bytes + 256) + 8192;
}

template <class T>
void Hdf5File::write_rows(const std::string& name, std::size_t first_row, std::span<const T> values) {
  const Lock lock(hdf5_library());
  if (values.empty()) return;
  Hdf5Handle dataset(H5Dopen2(file_.id(), name.c_str(), H5P_DEFAULT), H5Dclose);
  std::vector<hsize_t> start = dataset.valid() ? shape_of(dataset.id()) : std::vector<hsize_t>{};
  if (start.empty()) refuse_write(name);
  std::vector<hsize_t> count = start;
  count[0] = values.size() / (start.size() > 1 ? start[1] : 1);
  std::fill(start.begin(), start.end(), 0);
  start[0] = first_row;
  const Hdf5Handle part(H5Dget_space(dataset.id()), H5Sclose);
  const Hdf5Handle memory(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), H5Sclose);
  const bool written = H5Sselect_hyperslab(part.id(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) >=
                           0 &&
                       H5Dwrite(dataset.id(), native_type<T>(), memory.id(), part.id(), H5P_DEFAULT, values.data()) >=
                           0;
  if (!dataset.release() || !written) refuse_write(name);
}

template <class T>
void Hdf5File::write(const std::string& name, std::span<const T> values, std::size_t columns) {
  const std::size_t rows = values.size() / std::max<std::size_t>(columns, 1);
  create_dataset<T>(name, rows, columns, std::max<std::size_t>(rows, 1));
  write_rows<T>(name, 0, values);
}

void Hdf5File::write_text(const std::string& name, std::string_view text) {
  const Lock lock(hdf5_library());
  const Hdf5Handle type = text_type(text.size());
  const Hdf5Handle space = scalar_or_row(1);
  const Hdf5Handle dataset(
      H5Dcreate2(file_.id(), name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
  if (!dataset.valid() || H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) < 0)
    refuse_write(name);
}

std::string Hdf5File::read_text(const std::string& name) const {
  const Lock lock(hdf5_library());
  const Hdf5Handle dataset(H5Dopen2(file_.id(), name.c_str(), H5P_DEFAULT), H5Dclose);
  const Hdf5Handle stored(dataset.valid() ? H5Dget_type(dataset.id()) : -1, H5Tclose);
  if (!stored.valid() || H5Tget_class(stored.id()) != H5T_STRING || H5Tis_variable_str(stored.id()) > 0)
    refuse_read("text '" + name + "' is missing");
  std::string text(H5Tget_size(stored.id()), '\0');
  if (H5Dread(dataset.id(), text_type(text.size()).id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) < 0)
    refuse_read("text '" + name + "' can't be read");
  return text;
}

bool Hdf5File::has(const std::string& name) const {
  const Lock lock(hdf5_library());
  return H5Lexists(file_.id(), name.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::size_t> Hdf5File::shape(const std::string& name) const {
  const Lock lock(hdf5_library());
  const Hdf5Handle dataset(H5Dopen2(file_.id(), name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!dataset.valid()) refuse_read("dataset '" + name + "' is missing");
  const std::vector<hsize_t> shape = shape_of(dataset.id());
  return {shape.begin(), shape.end()};
}

template <class T>
std::vector<T> Hdf5File::read(const std::string& name) const {
  const Lock lock(hdf5_library());
  const std::vector<std::size_t> extents = shape(name);
  // Checks sizes before memory is allocated: no file unpacks to more than most_unpacked times its size.
  hsize_t size = 0;
  H5Fget_filesize(file_.id(), &size);
  std::size_t count = std::ranges::count(extents, 0u) > 0 ? 0 : 1, most = most_unpacked * size / sizeof(T);
  for (std::size_t k = 0; k < extents.size() && count > 0; most /= extents[k], count *= extents[k], ++k)
    if (extents[k] > most) refuse_read("dataset '" + name + "' announces more values than the file can hold");
  std::vector<T> values(count);
  const Hdf5Handle dataset(H5Dopen2(file_.id(), name.c_str(), H5P_DEFAULT), H5Dclose);
  if (count > 0 && H5Dread(dataset.id(), native_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    refuse_read("dataset '" + name + "' can't be read");
  return values;
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name, std::span<const std::int64_t> values) {
  const Lock lock(hdf5_library());
  if (!write_attribute(file_.id(), object, name, H5T_NATIVE_INT64, scalar_or_row(values.size()), values.data()))
    refuse_write("attribute " + name);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name, double value) {
  const Lock lock(hdf5_library());
  if (!write_attribute(file_.id(), object, name, H5T_NATIVE_DOUBLE, scalar_or_row(1), &value))
    refuse_write("attribute " + name);
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name, std::string_view text) {
  const Lock lock(hdf5_library());
  const Hdf5Handle type = text_type(text.size());
  if (!type.valid() || !write_attribute(file_.id(), object, name, type.id(), scalar_or_row(1), text.data()))
    refuse_write("attribute " + name);
}

bool Hdf5File::has_attribute(const std::string& name) const {
  const Lock lock(hdf5_library());
  return H5Aexists(file_.id(), name.c_str()) > 0;
}

template <class T>
T Hdf5File::attribute(const std::string& name) const {
  const Lock lock(hdf5_library());
  const Hdf5Handle attribute(H5Aopen(file_.id(), name.c_str(), H5P_DEFAULT), H5Aclose);
  const Hdf5Handle space(attribute.valid() ? H5Aget_space(attribute.id()) : -1, H5Sclose);
  T value{};
  if (!space.valid() || H5Sget_simple_extent_npoints(space.id()) != 1 ||
      H5Aread(attribute.id(), native_type<T>(), &value) < 0)
    refuse_read("attribute '" + name + "' is missing");
  return value;
}

std::string Hdf5File::image() {
  const Lock lock(hdf5_library());
  const bool flushed = H5Fflush(file_.id(), H5F_SCOPE_LOCAL) >= 0;
  const ssize_t size = flushed ? H5Fget_file_image(file_.id(), nullptr, 0) : -1;
  if (size < 0) refuse_write("the file");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(file_.id(), bytes.data(), bytes.size()) != size) refuse_write("the file");
  return bytes;
}

void Hdf5File::close() {
  const Lock lock(hdf5_library());
  const bool flushed = H5Fflush(file_.id(), H5F_SCOPE_LOCAL) >= 0;
  if (!file_.release() || !flushed) refuse_write("the file");
}

#define OGC_HDF5_VALUE(T)                                                                               \
  template void Hdf5File::create_dataset<T>(const std::string&, std::size_t, std::size_t, std::size_t); \
  template void Hdf5File::write_rows<T>(const std::string&, std::size_t, std::span<const T>);           \
  template void Hdf5File::write<T>(const std::string&, std::span<const T>, std::size_t);                \
  template std::vector<T> Hdf5File::read<T>(const std::string&) const;                                  \
  template T Hdf5File::attribute<T>(const std::string&) const;
OGC_HDF5_VALUE(float)
OGC_HDF5_VALUE(double)
OGC_HDF5_VALUE(std::int32_t)
OGC_HDF5_VALUE(std::int64_t)
#undef OGC_HDF5_VALUE

}  // namespace ogc::compare
