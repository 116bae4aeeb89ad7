"""Answers the questions of `ogc compare --plugin FILE.py` with the kernels of that file.

`ogc` starts this program with Python's option -c and talks to it through a socket, as to its worker for shared
libraries (experiments/plugins/worker.hpp). The first block describes the stages, the structures of compare/plugin.h and
the layout of messages, so that no stage is named here. A message is a series of blocks; each begins with a mark and its
length. Kernels get views of the received bytes, and what they return is sent from where it lies.
"""

import fcntl
import importlib.util
import inspect
import json
import os
import resource
import signal
import struct
import sys
import threading
import time
import traceback
import types

SOCKET = 3  # worker_descriptor
MARK = 0x6B636F6C622D6367  # BlockHead::right_mark
LOADED, REFUSED = 0, 1  # LoadStatus
ANSWERED, FAILED = 0, 1  # CallResult::Status
LOST_SOCKET = 70  # worker_lost_socket
LONGEST_TEXT = 2000  # characters of a message about an error

WORKER = os.getpid()


class Refusal(Exception):
    """The file is no plug-in; the text says why."""


class Wrong(Exception):
    """A kernel returned what is no answer; the text says what it returned."""


def end_if_copy():
    """Ends this process if a kernel has forked it: the answer is the parent's."""
    if os.getpid() != WORKER:
        os._exit(0)


def end_with_parent():
    """Makes this process, and all that kernels have started, end soon after `ogc` was killed. The end of the socket
    would tell, but only between two questions; this also ends a kernel that never returns."""
    parent = os.getppid()

    def look():
        while os.getppid() == parent:
            time.sleep(0.2)
        if os.getpgrp() == os.getpid():
            os.killpg(0, signal.SIGKILL)
        os._exit(1)

    threading.Thread(target=look, daemon=True).start()


# ---- the socket


def fill(view):
    """Reads as many bytes as the view has; ends the process if `ogc` has closed the socket."""
    while len(view) > 0:
        got = os.readv(SOCKET, [view])
        if got == 0:
            finish()
        view = view[got:]


def receive(make=bytearray):
    """Returns the next block, in memory that `make` provides for a number of bytes."""
    head = bytearray(16)
    fill(memoryview(head))
    mark, length = struct.unpack("=QQ", head)
    if mark != MARK:  # a kernel has read from the socket
        os._exit(LOST_SOCKET)
    block = make(length)
    fill(memoryview(block).cast("B") if length > 0 else memoryview(b""))
    return block


def send(*blocks):
    for block in blocks:
        view = memoryview(block).cast("B") if memoryview(block).nbytes > 0 else memoryview(b"")
        for part in (memoryview(struct.pack("=QQ", MARK, len(view))), view):
            while len(part) > 0:
                try:
                    part = part[os.write(SOCKET, part) :]
                except OSError:
                    os._exit(LOST_SOCKET)


def text(words):
    return words[:LONGEST_TEXT].encode(errors="replace")


def finish():
    """Ends this process and those that kernels have started."""
    for stream in (sys.stdout, sys.stderr):
        stream.flush()
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    if os.getpgrp() == os.getpid():
        os.killpg(0, signal.SIGTERM)
    os._exit(0)


# ---- the structures of compare/plugin.h


class Table:
    """The structures and stages that `ogc` describes, as NumPy's types."""

    def __init__(self, described):
        self.structures = {structure["name"]: structure for structure in described["structures"]}
        self.stages = described["stages"]
        self.dtypes = {}
        for structure in described["structures"]:  # each follows those that it contains
            self.dtypes[structure["name"]] = self.structured(structure)

    def structured(self, structure):
        members = [member for member in structure["members"] if member["role"] == "field"]
        return numpy.dtype(
            {
                "names": [member["name"] for member in members],
                "formats": [(self.dtype(member["type"]), tuple(member["shape"])) for member in members],
                "offsets": [member["offset"] for member in members],
                "itemsize": structure["bytes"],
            }
        )

    def members(self, structure):
        return [member for member in self.structures[structure]["members"] if member["role"] != "reserved"]

    def dtype(self, name):
        return self.dtypes.get(name) or numpy.dtype(name)

    def arguments(self, structure):
        """Returns the names that parameters of a kernel may have."""
        names = []
        for member in self.members(structure):
            names.append(member["name"])
            if member["name"] == "cases":
                names += self.dtype(member["type"]).names
        return names

    def outputs(self, structure):
        """Returns the output arrays in their order, with those of nested structures. An array of a list names the count
        that the kernel determines."""
        found = []
        for member in self.members(structure):
            if member["role"] == "nested":
                found += self.outputs(member["type"])
            elif member["role"] == "output":
                found.append({**member, "dtype": self.dtype(member["type"])})
        return found


class Question:
    """The numbers and arrays of one question."""

    def __init__(self, table, stage, sizes, blocks):
        self.table, self.sizes, self.blocks, self.numbers = table, sizes, iter(blocks), {}
        self.note_numbers(stage["in"])
        self.values = self.structure(stage["in"])
        if "cases" in self.values:  # members of the cases are arguments, too
            cases = self.values["cases"]
            self.values.update({name: cases[name] for name in cases.dtype.names})

    def value(self, member):
        dtype = numpy.dtype((self.table.dtype(member["type"]), tuple(member["shape"])))
        value = numpy.frombuffer(self.sizes, dtype, count=1, offset=member["question"])[0]
        if dtype.names:
            return types.SimpleNamespace(**{name: value[name] for name in dtype.names})
        return int(value) if dtype.kind == "i" else value

    def note_numbers(self, structure):
        """Collects what lengths of arrays are named after. The first of a name is that of the mesh."""
        for member in self.table.members(structure):
            if member["role"] == "nested":
                self.note_numbers(member["type"])
            elif member["role"] == "value" and member["type"] in ("int32", "int64"):
                self.numbers.setdefault(member["name"], self.value(member))

    def shape(self, words):
        return [word if isinstance(word, int) else self.numbers[word] for word in words]

    def array(self, member):
        array = next(self.blocks).view(self.table.dtype(member["type"]))
        inner = self.shape(member["shape"][1:])
        return array.reshape([len(array) // max(1, int(numpy.prod(inner))), *inner])

    def structure(self, name):
        values = {}
        for member in self.table.members(name):
            if member["role"] == "value":
                values[member["name"]] = self.value(member)
            elif member["role"] == "nested":
                values[member["name"]] = types.SimpleNamespace(**self.structure(member["type"]))
            else:
                values[member["name"]] = self.array(member)
        return values


# ---- what a kernel returns


def converted(array, dtype, name):
    """Returns the array in this type if that changes no value."""
    if array.dtype == dtype:
        return array
    if array.dtype.names or dtype.names:
        raise Wrong(f"{name} as {array.dtype} instead of {dtype}")
    if numpy.can_cast(array.dtype, dtype, "safe"):
        return array.astype(dtype)
    if array.dtype.kind in "iu" and dtype.kind in "iu":
        limits = numpy.iinfo(dtype)
        outside = array[(array < limits.min) | (array > limits.max)]
        if outside.size > 0:
            raise Wrong(f"{name} with the element {outside.flat[0]}; {dtype} has {limits.min} to {limits.max}")
        return array.astype(dtype)
    raise Wrong(f"{name} as {array.dtype} instead of {dtype}; .astype(numpy.{dtype}) converts it, by rounding")


def host_array(value, name):
    """Returns an array of NumPy, PyTorch or Warp on the host as one of NumPy."""
    try:
        return numpy.asarray(value if isinstance(value, numpy.ndarray) else getattr(value, "numpy", lambda: value)())
    except (TypeError, ValueError, RuntimeError) as error:
        raise Wrong(f"{name} as {type(value).__name__}, which is no array on the host: {error}") from None


def structured(value, dtype, name):
    """Returns an array of structures from a dictionary of its members, or from rows if all members have one type."""
    if isinstance(value, dict):
        if set(value) != set(dtype.names):
            given = ", ".join(map(str, value)) or "none"
            raise Wrong(f"{name} with the members {given}; it has {', '.join(dtype.names)}")
        parts = {part: host_array(value[part], f"{name}[{part}]") for part in dtype.names}
        lengths = {part: array.shape[:1] for part, array in parts.items()}
        if len(set(lengths.values())) > 1:
            raise Wrong(f"{name} with members of different lengths: {lengths}")
        whole = numpy.zeros(next(iter(lengths.values())) or (1,), dtype)
        for part, array in parts.items():
            right = array.shape[:1] + dtype[part].shape
            if array.shape != right:
                raise Wrong(f"{name}[{part}] with shape {array.shape} instead of {right}")
            whole[part] = converted(array, dtype[part].base, f"{name}[{part}]")
        return whole
    array = host_array(value, name)
    types_of_members = {dtype[part] for part in dtype.names}
    if array.dtype.names or len(types_of_members) > 1 or any(kind.shape for kind in types_of_members):
        return converted(array, dtype, name)
    if array.ndim != 2 or array.shape[1] != len(dtype.names):
        raise Wrong(f"{name} with shape {array.shape} instead of (any, {len(dtype.names)})")
    return numpy.ascontiguousarray(converted(array, types_of_members.pop(), name)).view(dtype)[:, 0]


def by_name(returned, outputs):
    """Returns what a kernel returned as a dictionary of outputs."""
    names = [output["name"] for output in outputs]
    due = f"the stage has {', '.join(names)}"
    if isinstance(returned, dict):
        missing, unknown = [n for n in names if n not in returned], [str(n) for n in returned if n not in names]
        if missing or unknown:
            problem = f"no {', '.join(missing)}" if missing else f"{', '.join(unknown)}, which the stage does not have"
            raise Wrong(f"{problem}; {due}")
        return returned
    if returned is None:
        raise Wrong(f"None; {due}")
    if len(names) == 1 and not isinstance(returned, tuple):
        return {names[0]: returned}
    if not isinstance(returned, (tuple, list)):
        raise Wrong(f"one {type(returned).__name__}; {due}")
    if len(returned) != len(names):
        raise Wrong(f"{len(returned)} array{'s' * (len(returned) != 1)}; {due}")
    return dict(zip(names, returned))


def answer_of(returned, outputs, question):
    """Returns the arrays to send, and the lengths of lists by number."""
    returned, arrays, counts, first_of = by_name(returned, outputs), [], {}, {}
    for output in outputs:
        dtype, name = output["dtype"], f"`{output['name']}`"
        value = returned[output["name"]]
        array = structured(value, dtype, name) if dtype.names else converted(host_array(value, name), dtype, name)
        words, due = output["shape"], ""
        if "list" in output:
            length = counts.setdefault(output["list"], array.shape[0] if array.ndim > 0 else "any")
            first = first_of.setdefault(output["list"], name)
            due = f" (as many as {first})" if first != name else ""
            right = [length, *question.shape(words[1:])]
        else:
            right = question.shape(words)
        if right == [1] and array.shape == ():
            array = array.reshape(1)
        if list(array.shape) != right:
            raise Wrong(f"{name} with shape {array.shape} instead of ({', '.join(map(str, right))}){due}")
        arrays.append(numpy.ascontiguousarray(array))
    return arrays, counts


# ---- the file with kernels


def place_of(error, file):
    """Returns the line of the file that an error comes from, as the end of a sentence."""
    lines = [frame.lineno for frame in traceback.extract_tb(error.__traceback__) if frame.filename == file]
    if isinstance(error, SyntaxError) and error.filename == file:
        lines.append(error.lineno)
    return f", line {lines[-1]} of {os.path.basename(file)}" if lines else ""


def words_of(error, file):
    said = str(error.msg if isinstance(error, SyntaxError) else error)
    return f"{type(error).__name__}{': ' if said else ''}{said[:LONGEST_TEXT // 2]}{place_of(error, file)}"


class EndOfKernels(BaseException):
    """Raised where a file calls judge: its kernels stand above."""


def end_of_kernels(*_, **__):
    raise EndOfKernels


def provide_package(source):
    """Gives `ogc_testbed` this program's own mark of kernels and a judge that ends the file. Where the package is not
    installed, it consists of these two."""
    kernels, judging = types.ModuleType("ogc_testbed.kernels"), types.ModuleType("ogc_testbed.judging")
    exec(source, kernels.__dict__)
    judging.judge = end_of_kernels
    if importlib.util.find_spec("ogc_testbed") is None:
        package = types.ModuleType("ogc_testbed")
        package.__path__ = []
        package.kernel, package.judge = kernels.kernel, end_of_kernels
        sys.modules[package.__name__] = package
    sys.modules.update({module.__name__: module for module in (kernels, judging)})


class Kernel:
    """A kernel and the arguments that it wants."""

    def __init__(self, function, names):
        self.function, self.keywords, self.positions = function, [], []
        self.name = f"`{getattr(function, '__name__', type(function).__name__)}`"
        code = getattr(inspect.unwrap(function), "__code__", None)
        if code:
            self.name += f" (line {code.co_firstlineno} of {os.path.basename(code.co_filename)})"
        try:
            parameters = inspect.signature(function).parameters.values()
        except (TypeError, ValueError) as error:
            raise Refusal(f"its kernel {self.name}: {error}; call it in a function by def, and mark this") from None
        for parameter in parameters:
            if parameter.kind is parameter.VAR_KEYWORD:
                self.keywords = [name for name in names if name not in self.positions]
            elif parameter.kind is parameter.VAR_POSITIONAL:
                continue
            elif parameter.name in names:
                wanted = self.positions if parameter.kind is parameter.POSITIONAL_ONLY else self.keywords
                wanted.append(parameter.name)
            elif parameter.default is parameter.empty:
                raise Refusal(f"its kernel {self.name} takes `{parameter.name}`; the stage has {', '.join(names)}")

    def __call__(self, values):
        return self.function(*(values[n] for n in self.positions), **{n: values[n] for n in self.keywords})


def load(file, table):
    """Returns the kernels of the file by the number of their stage."""
    module = types.ModuleType("ogc_plugin_file")
    module.__file__ = file
    sys.modules[module.__name__] = module
    sys.path[0] = os.path.dirname(file)
    sys.argv = [file]
    try:
        with open(file, "rb") as source:
            exec(compile(source.read(), file, "exec"), module.__dict__)
    except EndOfKernels:
        pass
    except BaseException as error:
        end_if_copy()
        raise Refusal(f"it can't be loaded: {words_of(error, file)}") from None
    end_if_copy()
    names, found = [stage["name"] for stage in table.stages], {}
    marked = {id(v): v for v in vars(module).values() if isinstance(getattr(v, "ogc_stages", None), tuple)}
    for function in marked.values():
        for stage in function.ogc_stages:
            if stage not in names:
                raise Refusal(f"it has a kernel of the stage `{stage}`; known: {', '.join(names)}")
            number = names.index(stage)
            made = Kernel(function, table.arguments(table.stages[number]["in"]))
            if number in found:
                raise Refusal(
                    f"it has two kernels of the stage {stage}: {found[number].name} and {made.name}; take the mark "
                    "off one of them"
                )
            found[number] = made
    if not found:
        raise Refusal('it has no kernel; write @ogc_testbed.kernel("truncate") above a function')
    return found


# ---- questions and answers


def serve(layout, table, kernels, file):
    """Answers questions until `ogc` closes the socket."""
    request_of, result_of = layout["request"], layout["result"]
    outputs, told = [table.outputs(stage["out"]) for stage in table.stages], set()
    while True:
        request = receive()
        (number,) = struct.unpack_from("=Q", request, request_of["stage"])
        (limit,) = struct.unpack_from("=I", request, request_of["limit_seconds"])
        stage = table.stages[number]
        blocks = [receive(lambda length: numpy.empty(length, numpy.uint8)) for _ in range(stage["inputs"])]
        for block in blocks:
            block.flags.writeable = False
        question = Question(table, stage, memoryview(request)[request_of["sizes"] :], blocks)
        status, why, arrays, counts, seconds = ANSWERED, "", [], {}, 0.0
        signal.alarm(limit + 2)
        try:
            start = time.perf_counter()
            returned = kernels[number](question.values)
            seconds = time.perf_counter() - start
            end_if_copy()
            arrays, counts = answer_of(returned, outputs[number], question)
        except Wrong as wrong:
            status, why = FAILED, f"your kernel returned {wrong}"
        except BaseException as error:
            end_if_copy()
            status, why = FAILED, f"your kernel raised {words_of(error, file)}"
            if number not in told:  # once: the judge repeats the call to find the case
                told.add(number)
                traceback.print_exception(type(error), error, error.__traceback__.tb_next)
        signal.alarm(0)
        result = bytearray(result_of["bytes"])
        struct.pack_into("=B", result, result_of["status"], status)
        struct.pack_into("=d", result, result_of["seconds"], seconds)
        for index, count in {0: 1, **counts}.items():
            struct.pack_into("=q", result, result_of["counts"] + 8 * index, count)
        send(result, text(why), *(arrays if status == ANSWERED else []))


def main():
    file = sys.argv[1]
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    os.dup2(2, 1)  # what kernels print must not appear in a result
    sys.stdout.reconfigure(line_buffering=True)
    fcntl.fcntl(SOCKET, fcntl.F_SETFD, fcntl.FD_CLOEXEC)
    os.register_at_fork(after_in_child=lambda: os.close(SOCKET))
    end_with_parent()
    layout = json.loads(bytes(receive()))
    try:
        try:
            import numpy as imported
        except ImportError as error:
            raise Refusal(
                f"{sys.executable} has no NumPy ({error}); install it there, or name another interpreter by the "
                "environment's OGC_PYTHON"
            ) from None
        global numpy
        numpy = imported
        table = Table(layout["table"])
        provide_package(layout["kernels"])
        kernels = load(file, table)
    except Refusal as refusal:
        send(struct.pack("=B", REFUSED), text(str(refusal)))
        os._exit(2)
    has = bytes(number in kernels for number in range(len(table.stages)))
    send(struct.pack("=B", LOADED), text(os.path.splitext(os.path.basename(file))[0]), has)
    serve(layout, table, kernels, file)


if __name__ == "__main__":
    main()
