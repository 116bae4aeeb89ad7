// Wraps the part of HDF5's C interface that run folders need, with ownership and errors of C++. HDF5's own header stays
// in the .cpp, and its printed error stacks are off. Debian's library is built for one thread: every call into it holds
// one lock, so any thread may use files, but each file only by one thread at a time; slow work, packing, is done
// outside of it (packing.hpp).
#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compare/files/packing.hpp"

namespace ogc::compare {

/// Returns the lock that every call into HDF5 holds.
std::recursive_mutex& hdf5_library();

/// Owns an HDF5 handle and releases it on every way out.
class Hdf5Handle {
 public:
  using Close = int (*)(std::int64_t);
  Hdf5Handle(std::int64_t id, Close close) : id_(id), close_(close) {}
  ~Hdf5Handle() { release(); }
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(other.id_), close_(other.close_) { other.id_ = -1; }
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept;
  std::int64_t id() const { return id_; }  ///< HDF5's own number
  bool valid() const { return id_ >= 0; }  ///< whether it holds a handle
  /// Releases it now; returns false if HDF5 reports an error.
  bool release();

 private:
  std::int64_t id_;
  Close close_;
};

/// One HDF5 file, to write or to read. Objects are named by path from the root ("VTKHDF/Points"). Reading throws
/// InputError, writing ResourceError; both name the file and the object. Values are float, double, std::int32_t or
/// std::int64_t.
class Hdf5File {
 public:
  /// Empties or creates the file and reserves `size` bytes on the disk before HDF5 opens it: HDF5 1.10 crashes if a
  /// write fails while it closes a file. `close` gives unused bytes back.
  static Hdf5File create(const std::filesystem::path& path, std::size_t size);
  /// Creates a file in memory only; messages call it `name`. See `image`.
  static Hdf5File create_in_memory(const std::filesystem::path& name);
  static Hdf5File open(const std::filesystem::path& path);

  void create_group(const std::string& name);  ///< a path of names; the groups above it must exist
  /// Makes a dataset of `rows` rows with `columns` values (0: one-dimensional), to be written `part` ≥ 1 rows at a
  /// time. A long one is shuffled and deflated in chunks that fit the parts, so that no chunk is compressed repeatedly.
  template <class T>
  void create_dataset(const std::string& name, std::size_t rows, std::size_t columns, std::size_t part);
  /// Returns the most disk space that such a dataset takes, with everything that HDF5 stores about it.
  static std::size_t largest_size(std::size_t rows, std::size_t row_bytes, std::size_t part);
  /// Fills rows from `first_row` on.
  template <class T>
  void write_rows(const std::string& name, std::size_t first_row, std::span<const T> values);
  /// Makes the dataset and fills it.
  template <class T>
  void write(const std::string& name, std::span<const T> values, std::size_t columns = 0);

  /// Writes an array that is already packed.
  void write_packed(const std::string& name, const PackedArray& array);
  /// Reads a dataset of floats as it is packed in the file, or packs it if it is stored otherwise.
  PackedArray read_packed(const std::string& name) const;
  /// Makes a dataset without rows, for append_packed.
  void create_growing(const std::string& name, std::size_t columns, std::size_t chunk_rows);
  /// Appends the chunks of an array with these columns and chunk_rows; the zeros that fill up its last chunk count as
  /// rows. Reserve growth() first.
  void append_packed(const std::string& name, const PackedArray& array);
  /// Returns the most bytes by which the file grows for such an array.
  static std::size_t growth(const PackedArray& array);
  /// Reserves disk from byte `from` to byte `to` of the file. Throws ResourceError.
  void reserve(std::size_t from, std::size_t to) const;

  /// Writes a text, not empty, as one string of fixed length.
  void write_text(const std::string& name, std::string_view text);

  /// Returns all values of a dataset, row after row, converted to T.
  template <class T>
  std::vector<T> read(const std::string& name) const;
  std::string read_text(const std::string& name) const;  ///< reads a text of fixed length
  /// Returns whether the root holds an object of this name.
  bool has(const std::string& name) const;
  std::vector<std::size_t> shape(const std::string& name) const;

  /// Writes one value as a scalar, more as a one-dimensional attribute. `object` "/" is the root.
  void set_attribute(const std::string& object, const std::string& name, std::span<const std::int64_t> values);
  void set_attribute(const std::string& object, const std::string& name, double value);
  /// Writes ASCII of fixed length.
  void set_attribute(const std::string& object, const std::string& name, std::string_view text);
  /// Returns whether the root has an attribute of this name.
  bool has_attribute(const std::string& name) const;
  /// Returns a scalar attribute of the root, converted to T.
  template <class T>
  T attribute(const std::string& name) const;

  /// Returns the bytes that the file would have on the disk.
  std::string image();
  /// Flushes and closes; a failure of the disk is thrown here at the latest.
  void close();

 private:
  Hdf5File(std::filesystem::path path, Hdf5Handle file) : path_(std::move(path)), file_(std::move(file)) {}
  [[noreturn]] void refuse_read(const std::string& what) const;
  [[noreturn]] void refuse_write(const std::string& what) const;
  std::filesystem::path path_;
  Hdf5Handle file_;
};

}  // namespace ogc::compare
