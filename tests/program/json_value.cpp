// json_value FILE KEY...: the value in a JSON file, with blanks after commas and colons ("5.0", "\"x\"", "[1, 2]").
// Exit code 1 if a key is missing. Scripts read hundreds of values, and an interpreter starts slowly.
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& value) {
  if (!value.is_structured()) return value.dump(-1, ' ', true);
  std::string text;
  for (const auto& [key, part] : value.items()) {
    if (!text.empty()) text += ", ";
    if (value.is_object()) text += Json(key).dump(-1, ' ', true) + ": ";
    text += text_of(part);
  }
  return value.is_object() ? "{" + text + "}" : "[" + text + "]";
}

}  // namespace

int main(int argc, char** argv) {
  try {
    std::ifstream file(argc > 1 ? argv[1] : "");
    const Json document = Json::parse(file);
    const Json* value = &document;
    for (int k = 2; k < argc; ++k)
      value = value->is_array() ? &value->at(static_cast<std::size_t>(std::stoll(argv[k]))) : &value->at(argv[k]);
    std::puts(text_of(*value).c_str());
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "json_value: %s\n", error.what());
    return 1;
  }
}
