"""An array in the memory of a CUDA device, by the driver alone: tests need neither torch nor CuPy."""

import ctypes

import numpy as np

KEPT_ALIVE = {}  # the memory behind capsules, by address of their tensors


class Tensor(ctypes.Structure):
    """DLTensor of dlpack.h."""

    _fields_ = [("data", ctypes.c_void_p), ("device_type", ctypes.c_int32), ("device_id", ctypes.c_int32),
                ("ndim", ctypes.c_int32), ("code", ctypes.c_uint8), ("bits", ctypes.c_uint8),
                ("lanes", ctypes.c_uint16), ("shape", ctypes.POINTER(ctypes.c_int64)),
                ("strides", ctypes.POINTER(ctypes.c_int64)), ("byte_offset", ctypes.c_uint64)]


class ManagedTensor(ctypes.Structure):
    """DLManagedTensor of dlpack.h."""


DELETER = ctypes.CFUNCTYPE(None, ctypes.POINTER(ManagedTensor))
ManagedTensor._fields_ = [("tensor", Tensor), ("context", ctypes.c_void_p), ("deleter", DELETER)]
CUDA, FLOAT = 2, 2


class VersionedTensor(ctypes.Structure):
    """DLManagedTensorVersioned of dlpack.h."""

    DELETER = ctypes.CFUNCTYPE(None, ctypes.c_void_p)
    _fields_ = [("major", ctypes.c_uint32), ("minor", ctypes.c_uint32), ("context", ctypes.c_void_p),
                ("deleter", DELETER), ("flags", ctypes.c_uint64), ("tensor", Tensor)]


class ExchangeApi(ctypes.Structure):
    """DLPackExchangeAPI of dlpack.h. Its functions hold the interpreter's lock."""

    GIVE = ctypes.PYFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.POINTER(ctypes.POINTER(VersionedTensor)))
    STREAM = ctypes.PYFUNCTYPE(ctypes.c_int, ctypes.c_int32, ctypes.c_int32, ctypes.POINTER(ctypes.c_void_p))
    _fields_ = [("major", ctypes.c_uint32), ("minor", ctypes.c_uint32), ("older", ctypes.c_void_p),
                ("allocate", ctypes.c_void_p), ("give", GIVE), ("take", ctypes.c_void_p), ("show", ctypes.c_void_p),
                ("current_stream", STREAM)]


def capsule_of(address, name):
    """Returns a capsule of an address; the name must live as long as the capsule."""
    new = ctypes.pythonapi.PyCapsule_New
    new.restype, new.argtypes = ctypes.py_object, [ctypes.c_void_p, ctypes.c_char_p, ctypes.c_void_p]
    return new(address, name, None)


@DELETER
def let_go(tensor):
    KEPT_ALIVE.pop(ctypes.addressof(tensor.contents))


def driver():
    """Returns CUDA's driver with the context that its runtime uses."""
    cuda = ctypes.CDLL("libcuda.so.1")
    context = ctypes.c_void_p()
    for name, arguments in (("cuInit", (0,)), ("cuDevicePrimaryCtxRetain", (ctypes.byref(context), 0)),
                            ("cuCtxSetCurrent", (context,))):
        status = getattr(cuda, name)(*arguments)
        assert status == 0, (name, status)
    return cuda


class DeviceArray:
    """float32 rows on the device; it counts how often it is asked for."""

    cuda = None

    def __init__(self, values):
        DeviceArray.cuda = DeviceArray.cuda or driver()
        values = np.ascontiguousarray(values, dtype=np.float32)
        self.shape, self.bytes, self.asked = values.shape, values.nbytes, 0
        memory = ctypes.c_uint64()
        assert self.cuda.cuMemAlloc_v2(ctypes.byref(memory), ctypes.c_size_t(self.bytes)) == 0
        self.address = memory.value
        assert self.cuda.cuMemcpyHtoD_v2(memory, ctypes.c_void_p(values.ctypes.data), ctypes.c_size_t(self.bytes)) == 0

    def __del__(self):
        self.cuda.cuMemFree_v2(ctypes.c_uint64(self.address))

    def copy(self):
        return DeviceArray(self.numpy())

    def numpy(self):
        values = np.empty(self.shape, dtype=np.float32)
        status = self.cuda.cuMemcpyDtoH_v2(ctypes.c_void_p(values.ctypes.data), ctypes.c_uint64(self.address),
                                           ctypes.c_size_t(self.bytes))
        assert status == 0, status
        return values

    def __dlpack_device__(self):
        return CUDA, 0

    def __dlpack__(self, **_):
        self.asked += 1
        shape = (ctypes.c_int64 * len(self.shape))(*self.shape)
        managed = ManagedTensor(Tensor(self.address, CUDA, 0, len(self.shape), FLOAT, 32, 1, shape, None, 0), None,
                                let_go)
        KEPT_ALIVE[ctypes.addressof(managed)] = managed, shape, self
        return capsule_of(ctypes.addressof(managed), b"dltensor")


class Exported:
    """What an object on the device exports by DLPack: address, device, shape, and a copy of its numbers."""

    TYPES = {(0, 32): np.int32, (1, 8): np.uint8, (2, 32): np.float32}  # by code and bits of dlpack.h

    def __init__(self, exporting):
        DeviceArray.cuda = DeviceArray.cuda or driver()
        get = ctypes.pythonapi.PyCapsule_GetPointer
        get.restype, get.argtypes = ctypes.c_void_p, [ctypes.py_object, ctypes.c_char_p]
        capsule = exporting.__dlpack__()  # whose end lets the tensor go
        tensor = ManagedTensor.from_address(get(capsule, b"dltensor")).tensor
        self.address, self.device = tensor.data, (tensor.device_type, tensor.device_id)
        self.shape = tuple(tensor.shape[i] for i in range(tensor.ndim))
        self.numbers = np.empty(self.shape, self.TYPES[tensor.code, tensor.bits])
        if self.numbers.size:
            status = DeviceArray.cuda.cuMemcpyDtoH_v2(ctypes.c_void_p(self.numbers.ctypes.data),
                                                      ctypes.c_uint64(tensor.data),
                                                      ctypes.c_size_t(self.numbers.nbytes))
            assert status == 0, status


def free_memory():
    """Returns the device's free memory [bytes]."""
    DeviceArray.cuda = DeviceArray.cuda or driver()
    free, total = ctypes.c_size_t(), ctypes.c_size_t()
    assert DeviceArray.cuda.cuMemGetInfo_v2(ctypes.byref(free), ctypes.byref(total)) == 0
    return free.value
