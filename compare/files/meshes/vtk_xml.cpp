// Uses expat event by event, because raw appended data are no XML and the parser must stop before them.
#include "compare/files/meshes/vtk_xml.hpp"

#include <limits>

#include "compare/problem/error.hpp"

#ifdef OGC_HAS_EXPAT
#include <expat.h>

#include <memory>
#endif

namespace ogc::compare {

#ifdef OGC_HAS_EXPAT
namespace {

std::string attribute_in(const XmlAttributes& attributes, const char* key) {
  const auto found = attributes.find(key);
  return found == attributes.end() ? "" : found->second;
}

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& name)
      : bytes_(bytes), name_(name), parser_(XML_ParserCreate(nullptr)) {
    if (!parser_) throw ResourceError(name + ": no memory for its XML");
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(parser_.get(), &Reader::on_start, &Reader::on_end);
    XML_SetCharacterDataHandler(parser_.get(), &Reader::on_text);
  }

  VtkDocument parse() {
    constexpr std::size_t most = 1 << 30;  // expat counts in int
    for (std::size_t begin = 0; begin < bytes_.size() && !stopped_; begin += most) {
      const std::string_view part = bytes_.substr(begin, most);
      const bool last = begin + part.size() == bytes_.size();
      if (XML_Parse(parser_.get(), part.data(), static_cast<int>(part.size()), last) == XML_STATUS_ERROR && !stopped_)
        fail(XML_ErrorString(XML_GetErrorCode(parser_.get())));
    }
    if (!seen_root_) fail("holds no VTK file");
    if (stopped_) find_appended();
    return std::move(document_);
  }

 private:
  struct Free {
    void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
  };

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(name_ + ": line " + std::to_string(XML_GetCurrentLineNumber(parser_.get())) + ": " + what +
                     "; it is no VTK XML file, or it is damaged");
  }

  static void on_start(void* self, const char* tag, const char** attributes) {
    static_cast<Reader*>(self)->start(tag, attributes);
  }
  static void on_end(void* self, const char*) { static_cast<Reader*>(self)->end(); }
  static void on_text(void* self, const char* text, int length) {
    Reader& reader = *static_cast<Reader*>(self);
    // Skips the text of elements inside an array, such as VTK's <InformationKey>.
    if (reader.array_ != nullptr && reader.open_.back() == "DataArray")
      reader.array_->text.append(text, static_cast<std::size_t>(length));
  }

  void start(const std::string& tag, const char** raw) {
    XmlAttributes attributes;
    for (; *raw != nullptr; raw += 2) attributes[raw[0]] = raw[1];
    if (tag == "VTKFile") {
      document_.file = std::move(attributes);
      seen_root_ = true;
    } else if (tag == "Piece") {
      document_.pieces.push_back({std::move(attributes), {}});
    } else if (tag == "DataArray" && !document_.pieces.empty() && !open_.empty()) {
      const auto line = static_cast<std::size_t>(XML_GetCurrentLineNumber(parser_.get()));
      document_.pieces.back().arrays.push_back({open_.back(), std::move(attributes), "", line});
      array_ = &document_.pieces.back().arrays.back();
    } else if (tag == "AppendedData") {
      document_.encoding = attribute_in(attributes, "encoding");
      stopped_ = true;
      appended_at_ = static_cast<std::size_t>(XML_GetCurrentByteIndex(parser_.get()));
      XML_StopParser(parser_.get(), XML_FALSE);
    }
    open_.push_back(tag);
  }

  void end() {
    if (open_.back() == "DataArray") array_ = nullptr;
    open_.pop_back();
  }

  /// Finds the appended data, which begin after the first underscore behind the tag.
  void find_appended() {
    const std::size_t close = bytes_.find('>', appended_at_), underscore = bytes_.find('_', close);
    if (close == std::string_view::npos || underscore == std::string_view::npos)
      fail("<AppendedData> holds no underscore before its data");
    document_.appended = bytes_.substr(underscore + 1);
  }

  std::string_view bytes_;
  const std::string& name_;
  std::unique_ptr<std::remove_pointer_t<XML_Parser>, Free> parser_;
  VtkDocument document_;
  VtkArray* array_ = nullptr;  ///< array whose text is being read
  std::vector<std::string> open_;
  bool seen_root_ = false, stopped_ = false;
  std::size_t appended_at_ = 0;  ///< byte of the tag
};

}  // namespace

VtkDocument parse_vtk_xml(std::string_view bytes, const std::string& name) { return Reader(bytes, name).parse(); }

#else

VtkDocument parse_vtk_xml(std::string_view, const std::string& name) {
  throw ResourceError(name +
                      ": this program was built without expat, which reads VTK's files; install libexpat1-dev and "
                      "build again, or write OBJ or PLY");
}

#endif

}  // namespace ogc::compare
