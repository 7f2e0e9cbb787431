#include "tools/cli/params_file.hpp"

#include <charconv>
#include <cmath>

#include <nlohmann/json.hpp>

#include "tools/cli/output.hpp"

namespace swallowtail::cli {
namespace {

constexpr std::uintmax_t kMaxBytes = 1u << 20u;

}  // namespace

Result<ChosenParams> read_params(const std::string& path) {
  const Result<std::string> text = read_text(path, kMaxBytes);
  if (!text) return text.error();
  const auto document = nlohmann::json::parse(*text, nullptr, false);
  if (!document.is_object()) return bad_input(path + " is not a JSON object.");
  ChosenParams chosen;
  if (const auto name = document.find("algorithm"); name != document.end()) {
    if (!name->is_string()) return bad_input(path + ": algorithm must be a text.");
    chosen.algorithm = name->get<std::string>();
  }
  if (const auto midpoints = document.find("midpoints"); midpoints != document.end()) {
    if (!midpoints->is_number_integer() || *midpoints < 1 || *midpoints > 64) {
      return bad_input(path + ": midpoints must be a whole number from 1 to 64.");
    }
    chosen.midpoints = midpoints->get<int>();
  }
  const auto parameters = document.find("parameters");
  if (parameters == document.end()) return chosen;
  if (!parameters->is_object()) return bad_input(path + ": parameters must be an object.");
  for (const auto& [name, value] : parameters->items()) {
    if (!value.is_number()) return bad_input(path + ": parameters." + name + " must be a number.");
    chosen.settings.emplace_back(name, value.get<double>());
  }
  return chosen;
}

Result<std::pair<std::string, double>> parse_setting(const std::string& text) {
  const std::size_t equals = text.find('=');
  double value = 0.0;
  const char* const end = text.data() + text.size();
  if (equals != std::string::npos && equals > 0) {
    const auto read = std::from_chars(text.data() + equals + 1, end, value);
    if (read.ec == std::errc{} && read.ptr == end && std::isfinite(value)) {
      return std::pair(text.substr(0, equals), value);
    }
  }
  return bad_input("'" + text + "' is no setting; it must be key=number.");
}

}  // namespace swallowtail::cli
