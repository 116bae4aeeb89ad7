// Writes and reads packed chunks as they are, without HDF5's own filters.
#include <hdf5.h>

#include <array>

#include "compare/files/durable_file.hpp"
#include "compare/files/hdf5.hpp"

namespace ogc::compare {
namespace {

using Lock = std::lock_guard<std::recursive_mutex>;
using Extents = std::array<hsize_t, 2>;  // rows, columns; a one-dimensional dataset uses only the first

/// Masks of the filters (bits: shuffle, deflate) that were not applied to a chunk.
constexpr std::uint32_t no_filter = 0, every_filter = 3;

int rank_of(const PackedArray& array) { return array.columns > 0 ? 2 : 1; }

/// Returns HDF5's creation list for a dataset whose chunks are shuffled and deflated as `pack` does.
Hdf5Handle packed_list(std::size_t columns, std::size_t chunk_rows) {
  Hdf5Handle list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(list.id(), false);
  const Extents chunk{chunk_rows, columns};
  H5Pset_chunk(list.id(), columns > 0 ? 2 : 1, chunk.data());
  H5Pset_shuffle(list.id());
  H5Pset_deflate(list.id(), 1);
  return list;
}

/// Returns whether a dataset with this creation list stores its chunks as `pack` produces them.
bool is_packed_so(hid_t list, int rank, std::size_t columns, std::size_t chunk_rows) {
  Extents chunk{};
  if (H5Pget_layout(list) != H5D_CHUNKED || H5Pget_chunk(list, 2, chunk.data()) != rank) return false;
  if (chunk[0] != chunk_rows || (rank == 2 && chunk[1] != columns) || H5Pget_nfilters(list) != 2) return false;
  const auto filter = [&](unsigned i) {
    unsigned flags = 0;
    std::size_t count = 0;
    return H5Pget_filter2(list, i, &flags, &count, nullptr, 0, nullptr, nullptr);
  };
  return filter(0) == H5Z_FILTER_SHUFFLE && filter(1) == H5Z_FILTER_DEFLATE;
}

/// Writes the chunks from row `first_row` on; returns false if HDF5 reports an error.
bool write_chunks(hid_t dataset, std::size_t first_row, const PackedArray& array) {
  for (std::size_t i = 0; i < array.chunks.size(); ++i) {
    const PackedChunk& chunk = array.chunks[i];
    const Extents offset{first_row + i * array.chunk_rows, 0};
    const std::uint32_t left_out = chunk.packed ? no_filter : every_filter;
    if (H5Dwrite_chunk(dataset, H5P_DEFAULT, left_out, offset.data(), chunk.bytes.size(), chunk.bytes.data()) < 0)
      return false;
  }
  return true;
}

/// Reads all chunks. Returns false if a chunk is missing, or if only one of the two filters was applied to it.
bool read_chunks(hid_t dataset, PackedArray& array) {
  for (std::size_t row = 0; row < array.rows; row += array.chunk_rows) {
    const Extents offset{row, 0};
    hsize_t size = 0;
    std::uint32_t left_out = 0;
    if (H5Dget_chunk_storage_size(dataset, offset.data(), &size) < 0 || size == 0) return false;
    std::string bytes(size, '\0');
    if (H5Dread_chunk(dataset, H5P_DEFAULT, offset.data(), &left_out, bytes.data()) < 0) return false;
    if (left_out != no_filter && left_out != every_filter) return false;
    array.chunks.push_back({left_out == no_filter, std::move(bytes)});
  }
  return true;
}

}  // namespace

void Hdf5File::write_packed(const std::string& name, const PackedArray& array) {
  const Lock lock(hdf5_library());
  const Extents extents{array.rows, array.columns};
  const Hdf5Handle space(H5Screate_simple(rank_of(array), extents.data(), nullptr), H5Sclose);
  const bool plain = array.chunks.size() == 1 && !array.chunks[0].packed;  // contiguous, without an index
  Hdf5Handle list = packed_list(array.columns, array.chunk_rows);
  if (plain) list = Hdf5Handle(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(list.id(), false);
  Hdf5Handle dataset(
      H5Dcreate2(file_.id(), name.c_str(), H5T_NATIVE_FLOAT, space.id(), H5P_DEFAULT, list.id(), H5P_DEFAULT),
      H5Dclose);
  const bool written = dataset.valid() && (plain ? H5Dwrite(dataset.id(), H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL,
                                                            H5P_DEFAULT, array.chunks[0].bytes.data()) >= 0
                                                 : write_chunks(dataset.id(), 0, array));
  if (!dataset.release() || !written) refuse_write(name);
}

PackedArray Hdf5File::read_packed(const std::string& name) const {
  const Lock lock(hdf5_library());
  const std::vector<std::size_t> extents = shape(name);
  const std::size_t columns = extents.size() > 1 ? extents[1] : 0;
  if (extents.empty() || extents[0] == 0) refuse_read("dataset '" + name + "' has no rows");
  PackedArray array{extents[0], columns, even_chunk_rows(extents[0]), {}};
  const Hdf5Handle dataset(H5Dopen2(file_.id(), name.c_str(), H5P_DEFAULT), H5Dclose);
  const Hdf5Handle list(dataset.valid() ? H5Dget_create_plist(dataset.id()) : -1, H5Pclose);
  if (list.valid() && is_packed_so(list.id(), rank_of(array), columns, array.chunk_rows) &&
      read_chunks(dataset.id(), array))
    return array;
  return pack(read<float>(name), columns);
}

void Hdf5File::create_growing(const std::string& name, std::size_t columns, std::size_t chunk_rows) {
  const Lock lock(hdf5_library());
  const Extents none{0, columns}, most{H5S_UNLIMITED, columns};
  const Hdf5Handle space(H5Screate_simple(columns > 0 ? 2 : 1, none.data(), most.data()), H5Sclose);
  const Hdf5Handle list = packed_list(columns, chunk_rows);
  const Hdf5Handle dataset(
      H5Dcreate2(file_.id(), name.c_str(), H5T_NATIVE_FLOAT, space.id(), H5P_DEFAULT, list.id(), H5P_DEFAULT),
      H5Dclose);
  if (!dataset.valid()) refuse_write(name);
}

void Hdf5File::append_packed(const std::string& name, const PackedArray& array) {
  const Lock lock(hdf5_library());
  const std::size_t first_row = shape(name)[0];
  const Extents extents{first_row + array.chunks.size() * array.chunk_rows, array.columns};
  Hdf5Handle dataset(H5Dopen2(file_.id(), name.c_str(), H5P_DEFAULT), H5Dclose);
  const bool written = dataset.valid() && H5Dset_extent(dataset.id(), extents.data()) >= 0 &&
                       write_chunks(dataset.id(), first_row, array);
  if (!dataset.release() || !written) refuse_write(name);
}

// Counts 256 B for each chunk's entry in the index, as largest_size does.
std::size_t Hdf5File::growth(const PackedArray& array) { return array.byte_count() + 256 * array.chunks.size(); }

void Hdf5File::reserve(std::size_t from, std::size_t to) const { compare::reserve(path_, from, to); }

}  // namespace ogc::compare
