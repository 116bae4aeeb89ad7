// Reads arrays by DLPack's C interface (DLPackExchangeAPI of dlpack.h): the type of an array offers functions, so that
// no code of Python runs. torch's __dlpack__ runs so much of it that a guard's step would take twice as long.
#pragma once

#include <nanobind/nanobind.h>

namespace ogc::python {

/// Returns a capsule of DLPack of an array that offers the C interface; none if it does not, if it refuses, or if its
/// library has given work to another stream than CUDA's legacy default stream, which only __dlpack__ waits for.
nanobind::object exchanged(nanobind::handle value);

}  // namespace ogc::python
