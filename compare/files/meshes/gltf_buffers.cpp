#include "compare/files/meshes/gltf_buffers.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

#include "compare/files/base64.hpp"
#include "compare/files/byte_cursor.hpp"
#include "compare/files/bytes.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

/// One of glTF's types of components.
struct Component {
  std::size_t number;
  ScalarType type;
  double largest;  ///< divisor of a normalised integer; 0: not an integer
};
constexpr std::array<Component, 6> components{{{5120, ScalarType::int8, 127},
                                               {5121, ScalarType::uint8, 255},
                                               {5122, ScalarType::int16, 32767},
                                               {5123, ScalarType::uint16, 65535},
                                               {5125, ScalarType::uint32, 0},
                                               {5126, ScalarType::float32, 0}}};

/// Returns a text from a URI with its escapes, such as %20, replaced by characters.
std::string decoded(std::string_view uri) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const auto digit = [&](std::size_t at) {
      const char c = at < uri.size() ? uri[at] : '?';
      return digits.find(c >= 'A' && c <= 'F' ? static_cast<char>(c + ('a' - 'A')) : c);
    };
    const std::size_t high = digit(i + 1), low = digit(i + 2);
    const bool is_escape = uri[i] == '%' && high != std::string_view::npos && low != std::string_view::npos;
    text += is_escape ? static_cast<char>(16 * high + low) : uri[i];
    if (is_escape) i += 2;
  }
  return text;
}

}  // namespace

GltfBuffers::GltfBuffers(std::string_view bytes, const std::string& name) : name_(name) {
  if (bytes.starts_with("glTF")) {
    open_container(bytes);
  } else {
    json_ = parse_json(bytes, name);
  }
  if (!json_.is_object() || !json_.contains("asset") || !json_["asset"].is_object())
    fail("has no 'asset'; it is no glTF file");
  const Json& asset = json_["asset"];
  const bool is_second = asset.contains("version") && asset["version"].is_string() &&
                         asset["version"].get<std::string>().starts_with("2.");
  if (!is_second) fail("is of another version than 2 of glTF; write it as glTF 2");
}

void GltfBuffers::open_container(std::string_view bytes) {
  ByteCursor cursor(bytes, name_, std::endian::little, 4);
  if (const auto version = cursor.number<std::uint32_t>("the version"); version != 2)
    fail("is a container of version " + std::to_string(version) + "; only glTF 2 is read");
  if (const auto size = cursor.number<std::uint32_t>("the length"); size > bytes.size())
    fail("has " + std::to_string(bytes.size()) + " of the " + std::to_string(size) +
         " bytes that its header announces: the file is truncated; write it again");
  for (bool is_first = true; cursor.left() >= 8; is_first = false) {
    const auto size = cursor.number<std::uint32_t>("a chunk's length");
    const std::string_view kind = cursor.take(4, "a chunk's kind");
    const std::string_view chunk = cursor.take(size, "a chunk of " + std::to_string(size) + " bytes");
    if (is_first && kind != "JSON") fail("does not begin with a chunk of JSON; the file is damaged");
    if (is_first) json_ = parse_json(chunk, name_);
    if (kind != std::string_view("BIN\0", 4) || has_binary_) continue;
    binary_ = chunk;
    has_binary_ = true;
  }
  if (json_.is_null()) fail("holds no chunk of JSON: the file is truncated; write it again");
}

void GltfBuffers::fail(const std::string& what) const { throw InputError(name_ + ": " + what); }

const Json& GltfBuffers::entry(const std::string& list, std::size_t i, const std::string& user) const {
  const auto found = json_.find(list);
  const std::size_t count = found != json_.end() && found->is_array() ? found->size() : 0;
  if (i >= count)
    fail(user + " names entry " + std::to_string(i) + " of '" + list + "', which has " + std::to_string(count) +
         ", numbered from 0");
  const Json& value = (*found)[i];
  if (!value.is_object()) fail("entry " + std::to_string(i) + " of '" + list + "' is no object");
  return value;
}

std::size_t GltfBuffers::whole(const Json& object, const char* key, const std::string& owner,
                               std::size_t otherwise) const {
  return object.contains(key) ? whole(object, key, owner) : otherwise;
}

std::size_t GltfBuffers::whole(const Json& object, const char* key, const std::string& owner) const {
  const auto found = object.find(key);
  if (found == object.end()) fail(owner + " has no '" + key + "'");
  if (!found->is_number_unsigned()) fail(owner + ": '" + key + "' is no whole number from 0 on");
  return found->get<std::size_t>();
}

std::string GltfBuffers::read_beside(const std::string& uri, const std::string& owner) {
  try {
    std::string bytes = read_bytes(std::filesystem::path(name_).parent_path() / decoded(uri));
    bytes_beside_ += bytes.size();
    return bytes;
  } catch (const InputError& error) {
    fail(owner + " can't be read: " + error.what());
  }
}

std::string_view GltfBuffers::buffer(std::size_t i, const std::string& user) {
  const Json& object = entry("buffers", i, user);
  const std::string owner = "buffer " + std::to_string(i);
  const std::size_t size = whole(object, "byteLength", owner);
  std::string_view bytes = binary_;
  if (object.contains("uri")) {
    auto found = buffers_.find(i);
    if (found == buffers_.end()) {
      if (!object["uri"].is_string()) fail(owner + ": 'uri' is no text");
      const std::string uri = object["uri"];
      const std::size_t comma = uri.find(',');
      if (uri.starts_with("data:") && (comma == std::string::npos || !uri.substr(0, comma).ends_with(";base64")))
        fail(owner + " holds data that are not in base64");
      std::string read = uri.starts_with("data:")
                             ? decode_base64(std::string_view(uri).substr(comma + 1), name_ + ": " + owner)
                             : read_beside(uri, owner);
      found = buffers_.emplace(i, std::move(read)).first;
    }
    bytes = found->second;
  } else if (i != 0 || !has_binary_) {
    fail(owner + " has no 'uri', and the file holds no data of its own for it");
  }
  if (size > bytes.size())
    fail(owner + " has " + std::to_string(bytes.size()) + " of the " + std::to_string(size) +
         " bytes that are announced: the file is truncated");
  return bytes.substr(0, size);
}

std::string_view GltfBuffers::view_of(const Json& accessor, std::size_t& stride, const std::string& user) {
  if (accessor.contains("sparse")) fail(user + " is sparse, which is not read; write it whole");
  if (!accessor.contains("bufferView"))
    fail(user + " has no data; where a primitive is compressed (Draco), write it without compression");
  const std::size_t number = whole(accessor, "bufferView", user);
  const Json& view = entry("bufferViews", number, user);
  const std::string owner = "buffer view " + std::to_string(number);
  if (view.contains("extensions") && view["extensions"].is_object() &&
      view["extensions"].contains("EXT_meshopt_compression"))
    fail(owner + " is compressed (EXT_meshopt_compression), which is not read; write it without compression");
  const std::string_view bytes = buffer(whole(view, "buffer", owner), owner);
  const std::size_t offset = whole(view, "byteOffset", owner, 0), size = whole(view, "byteLength", owner);
  if (offset > bytes.size() || size > bytes.size() - offset)
    fail(owner + " lies beyond its buffer of " + std::to_string(bytes.size()) + " bytes: the file is damaged");
  stride = whole(view, "byteStride", owner, stride);
  return bytes.substr(offset, size);
}

std::vector<double> GltfBuffers::read(std::size_t i, const std::string& type, const std::string& user) {
  const Json& accessor = entry("accessors", i, user);
  const std::string owner = "accessor " + std::to_string(i);
  if (!accessor.contains("type") || accessor["type"] != type) fail(owner + " of " + user + " is not of type " + type);
  const auto component = std::ranges::find(components, whole(accessor, "componentType", owner), &Component::number);
  if (component == components.end()) fail(owner + " has an unknown 'componentType'");
  const std::size_t width = type == "VEC3" ? 3 : 1, size = width * size_of(component->type);
  std::size_t stride = size;
  const std::string_view view = view_of(accessor, stride, owner);
  const std::size_t count = whole(accessor, "count", owner), offset = whole(accessor, "byteOffset", owner, 0);
  if (stride < size) fail(owner + ": its view has a stride of " + std::to_string(stride) + " bytes, below an entry's");
  const bool fits = offset <= view.size() && (count == 0 || (size <= view.size() - offset &&
                                                             count - 1 <= (view.size() - offset - size) / stride));
  if (!fits)
    fail(owner + " has " + std::to_string(count) + " entries, which its view of " + std::to_string(view.size()) +
         " bytes can't hold: the file is truncated or damaged");
  const bool is_normalised = accessor.contains("normalized") && accessor["normalized"] == true;
  const double unit = is_normalised && component->largest > 0 ? component->largest : 1;
  std::vector<double> values;
  values.reserve(count * width);
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t c = 0; c < width; ++c) {
      const char* at = view.data() + offset + k * stride + c * size_of(component->type);
      const double value = scalar_at(at, component->type, std::endian::little) / unit;
      values.push_back(is_normalised ? std::max(value, -1.0) : value);
    }
  }
  return values;
}

}  // namespace ogc::compare
