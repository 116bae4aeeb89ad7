// Base64 writes three bytes as four characters of text; this decodes it.
#pragma once

#include <string>
#include <string_view>

namespace ogc::compare {

/// Takes one group of four characters off `text`, with the blanks before it, and appends its bytes; padding ends a
/// part, and decoding goes on behind it. False where there is no whole group. Throws InputError that begins with
/// `where` for another character.
bool decode_base64_group(std::string_view& text, std::string& bytes, const std::string& where);

/// The bytes of the whole text.
std::string decode_base64(std::string_view text, const std::string& where);

}  // namespace ogc::compare
