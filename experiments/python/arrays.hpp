// Reads arrays of NumPy, torch, CuPy, JAX and Warp where they lie, by DLPack or the buffer protocol, and lends our own
// arrays to NumPy. nanobind says of a wrong array only "Invoked with types: ndarray", so arguments come as objects and
// are checked here: a message names the argument, what came, and the call that converts it. Nothing is cast or copied.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include "compare/problem/vector.hpp"

// How stubs write arrays; nb::sig takes literals, which only a macro can join.
#define OGC_GIVEN(dtype, shape) "typing.Annotated[numpy.typing.ArrayLike, dict(dtype='" dtype "', shape=" shape ")]"
#define OGC_LENT(dtype, shape) "typing.Annotated[numpy.typing.NDArray[numpy." dtype "], dict(shape=" shape ")]"

namespace ogc::python {

namespace nb = nanobind;

/// An array of any dtype and shape that is read where it lies.
using Array = nb::ndarray<nb::ro>;
/// An array that is written where it lies.
using Output = nb::ndarray<>;

/// Where an array must lie: in the memory of the host, of a CUDA device, or of either.
enum class Place { host, device, either };

/// What an array must be. Lengths: `columns` numbers in the last dimension, `dimensions` dimensions.
struct Wanted {
  const char* name;                   ///< the argument's name
  const char* dtype;                  ///< "float32", "float64" or "int32"
  const char* shape;                  ///< for messages: "(V, 3)"
  std::size_t dimensions;             ///< number of dimensions
  std::size_t columns = 0;            ///< length of the last dimension; 0: any
  Place place = Place::host;          ///< where it must lie
  const char* other_dtype = nullptr;  ///< another dtype that it may have
};

/// Returns the array that `value` offers. Throws TypeError if it is no array, or if its dtype, shape, order or device
/// is not the wanted one; the message names the argument, what came, and the call that converts it.
Array checked(nb::handle value, const Wanted& wanted);

/// Returns the array that `value` offers for writing. Throws TypeError as `checked` does, and if it is read-only.
Output checked_output(nb::handle value, const Wanted& wanted);

/// Returns whether an array lies in the memory of a CUDA device.
bool is_on_device(const Array& array);

/// Returns whether the items of an array are float64.
bool is_double(const Array& array);

/// An array that is read where it lies; the object that owns it stays alive as long as this.
template <class Item>
struct Given {
  Array array;                  ///< holds the owner
  std::span<const Item> items;  ///< one for each row
};

/// Returns the rows of an array. `Item` has the size of a row.
template <class Item>
Given<Item> given(nb::handle value, const Wanted& wanted) {
  Array array = checked(value, wanted);
  const std::size_t rows = array.nbytes() / sizeof(Item);
  const auto* items = static_cast<const Item*>(static_cast<const void*>(array.data()));
  return {std::move(array), {items, rows}};
}

/// Returns positions: float32 (V, 3), in C order.
inline Given<compare::Vec3f> given_positions(nb::handle value, const char* name, Place place = Place::host) {
  return given<compare::Vec3f>(value, {name, "float32", "(V, 3)", 2, 3, place});
}
/// Returns triangles: int32 (T, 3), in C order, on the host.
inline Given<compare::Triangle> given_triangles(nb::handle value, const char* name) {
  return given<compare::Triangle>(value, {name, "int32", "(T, 3)", 2, 3});
}

/// Returns a read-only NumPy array of `count` rows that lie in `owner`, which the array keeps alive.
template <class Number, std::size_t Columns>
nb::object lent(const void* rows, std::size_t count, nb::handle owner) {
  if constexpr (Columns == 1) {
    return nb::cast(nb::ndarray<nb::numpy, const Number, nb::ndim<1>>(static_cast<const Number*>(rows), {count}, owner),
                    nb::rv_policy::reference);
  } else {
    return nb::cast(
        nb::ndarray<nb::numpy, const Number, nb::ndim<2>>(static_cast<const Number*>(rows), {count, Columns}, owner),
        nb::rv_policy::reference);
  }
}

/// Returns an array with DLPack of `count` rows that lie in `owner` on a CUDA device. The array keeps `owner` alive.
/// DLPack's flag for read-only memory is not set, since not all libraries accept it.
template <class Number, std::size_t Columns>
nb::object lent_on_device(const void* rows, std::size_t count, nb::handle owner, int device) {
  auto* numbers = static_cast<Number*>(const_cast<void*>(rows));
  using Lent = nb::ndarray<nb::array_api, Number, nb::device::cuda>;
  constexpr nb::dlpack::dtype dtype = nb::dtype<Number>();
  const Lent lent = Columns == 1 ? Lent(numbers, {count}, owner, {}, dtype, nb::device::cuda::value, device)
                                 : Lent(numbers, {count, Columns}, owner, {}, dtype, nb::device::cuda::value, device);
  return nb::cast(lent, nb::rv_policy::reference);
}

/// The same for rows on the host, whose array says by DLPack that it is read-only.
template <class Number, std::size_t Columns>
nb::object lent_on_host(const void* rows, std::size_t count, nb::handle owner) {
  using Lent = nb::ndarray<nb::array_api, const Number, nb::ndim<2>, nb::device::cpu>;
  return nb::cast(Lent(static_cast<const Number*>(rows), {count, Columns}, owner), nb::rv_policy::reference);
}

/// Return a NumPy array that owns these rows.
nb::object owned(std::vector<compare::Vec3f>&& rows);
nb::object owned(std::vector<std::array<float, 6>>&& rows);

/// Returns an array like x to write to: NumPy's on the host, else one of x's library.
nb::object output_like(nb::handle x, bool is_there, std::size_t count);

/// Makes InputError a ValueError and ResourceError a RuntimeError.
void translate_errors();

}  // namespace ogc::python
