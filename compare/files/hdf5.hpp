// Wraps the part of HDF5's C interface that run folders need, with ownership and errors of C++. Only .cpp files include
// HDF5's header. HDF5 does not print its own error messages. Debian's library is built for one thread, so every call
// into it holds one lock. Any thread may use files, but only one thread at a time may use one file. Packing, which is
// slow, happens without the lock (packing.hpp).
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

/// Owns an HDF5 handle; the destructor releases it.
class Hdf5Handle {
 public:
  using Close = int (*)(std::int64_t);
  Hdf5Handle(std::int64_t id, Close close) : id_(id), close_(close) {}
  ~Hdf5Handle() { release(); }
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(other.id_), close_(other.close_) { other.id_ = -1; }
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept;
  std::int64_t id() const { return id_; }  ///< HDF5's number of the handle
  bool valid() const { return id_ >= 0; }  ///< whether it holds a handle
  /// Releases the handle now. Returns false if HDF5 reports an error.
  bool release();

 private:
  std::int64_t id_;
  Close close_;
};

/// An HDF5 file to write or to read. Objects are named by their path from the root ("VTKHDF/Points"). Reading throws
/// InputError, writing ResourceError; both name the file and the object. Values are float, double, std::int32_t or
/// std::int64_t.
class Hdf5File {
 public:
  /// Empties or creates the file and reserves `size` bytes on the disk before HDF5 opens it, because HDF5 1.10 crashes
  /// if a write fails while it closes a file. `close` releases unused bytes.
  static Hdf5File create(const std::filesystem::path& path, std::size_t size);
  /// Creates a file in memory only. Messages call the file `name`; `image` returns its bytes.
  static Hdf5File create_in_memory(const std::filesystem::path& name);
  static Hdf5File open(const std::filesystem::path& path);

  void create_group(const std::string& name);  ///< creates a group; the groups above it in its path must exist
  /// Makes a dataset of `rows` rows with `columns` values (0: one-dimensional), to be written `part` ≥ 1 rows at a
  /// time. A long dataset is shuffled and deflated in chunks that match the parts, so that no chunk is compressed
  /// repeatedly.
  template <class T>
  void create_dataset(const std::string& name, std::size_t rows, std::size_t columns, std::size_t part);
  /// Returns the largest disk space of a dataset with these arguments, including HDF5's data about it.
  static std::size_t largest_size(std::size_t rows, std::size_t row_bytes, std::size_t part);
  /// Writes rows from `first_row` on.
  template <class T>
  void write_rows(const std::string& name, std::size_t first_row, std::span<const T> values);
  /// Makes a dataset and writes all of its rows.
  template <class T>
  void write(const std::string& name, std::span<const T> values, std::size_t columns = 0);

  /// Writes an array that is already packed.
  void write_packed(const std::string& name, const PackedArray& array);
  /// Reads a dataset of floats as a packed array. Packs it after reading if the file stores it in another way.
  PackedArray read_packed(const std::string& name) const;
  /// Makes a dataset without rows, for append_packed.
  void create_growing(const std::string& name, std::size_t columns, std::size_t chunk_rows);
  /// Appends the chunks of an array that has the dataset's columns and chunk_rows. The zeros that fill the array's last
  /// chunk become rows. The caller must reserve growth() bytes first.
  void append_packed(const std::string& name, const PackedArray& array);
  /// Returns the largest number of bytes by which append_packed makes the file longer.
  static std::size_t growth(const PackedArray& array);
  /// Reserves disk space from byte `from` to byte `to` of the file. Throws ResourceError.
  void reserve(std::size_t from, std::size_t to) const;

  /// Writes a text as one string of fixed length; it must not be empty.
  void write_text(const std::string& name, std::string_view text);

  /// Returns all values of a dataset, row after row, converted to T.
  template <class T>
  std::vector<T> read(const std::string& name) const;
  std::string read_text(const std::string& name) const;  ///< reads a text of fixed length
  /// Returns whether the root has an object of this name.
  bool has(const std::string& name) const;
  std::vector<std::size_t> shape(const std::string& name) const;

  /// Writes one value as a scalar attribute, several as a one-dimensional one. The root is `object` "/".
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
  /// Flushes and closes the file. Throws ResourceError if the disk failed, also if that happened before this call.
  void close();

 private:
  Hdf5File(std::filesystem::path path, Hdf5Handle file) : path_(std::move(path)), file_(std::move(file)) {}
  [[noreturn]] void refuse_read(const std::string& what) const;
  [[noreturn]] void refuse_write(const std::string& what) const;
  std::filesystem::path path_;
  Hdf5Handle file_;
};

}  // namespace ogc::compare
