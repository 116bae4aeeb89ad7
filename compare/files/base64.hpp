// Decodes base64, which writes three bytes as four characters of text.
#pragma once

#include <string>
#include <string_view>

namespace ogc::compare {

/// Takes one group of four characters off `text`, with the blanks before it, and appends its bytes. More groups may
/// follow a group with padding. Returns false if there is no whole group. For any other character throws InputError
/// whose message begins with `where`.
bool decode_base64_group(std::string_view& text, std::string& bytes, const std::string& where);

/// Returns the bytes of the whole text; throws as decode_base64_group does.
std::string decode_base64(std::string_view text, const std::string& where);

}  // namespace ogc::compare
