#include "tools/cli/output.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include <fmt/core.h>

namespace swallowtail::cli {
namespace {

std::string extension_of(const std::string& path) { return std::filesystem::path(path).extension().string(); }

std::string dump(const nlohmann::ordered_json& json) {
  return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

Status write_files(const std::string& path, const Answer& answer) {
  const std::string extension = extension_of(path);
  if (const auto series = answer.series.find(extension); series != answer.series.end()) {
    const std::string stem = path.substr(0, path.size() - extension.size());
    for (std::size_t i = 0; i < series->second.size(); ++i) {
      const Status status = write_text(fmt::format("{}-{}{}", stem, i + 1, extension), series->second[i]());
      if (!status.ok()) return status;
    }
    return {};
  }
  if (const auto writer = answer.writers.find(extension); writer != answer.writers.end())
    return writer->second(path);
  const auto file = answer.files.find(extension);
  return write_text(path, file != answer.files.end() ? file->second() : dump(answer.json));
}

}  // namespace

Status write_text(const std::string& path, const std::string& text) {
  std::ofstream stream(path, std::ios::binary);
  stream << text;
  stream.flush();
  if (!stream) return bad_input(path + ": cannot be written.");
  return {};
}

Result<std::string> read_text(const std::string& path, std::uintmax_t max_bytes) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return not_found(path + ": no such file.");
  if (std::filesystem::file_size(path, error) > max_bytes || error) {
    return bad_input(fmt::format("{}: must be at most {} bytes.", path, max_bytes));
  }
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) return bad_input(path + ": cannot be read.");
  return text.str();
}

Status check_output(const Common& common, const std::vector<std::string>& extensions) {
  if (common.output.empty()) return {};
  if (std::ranges::find(extensions, extension_of(common.output)) != extensions.end()) return {};
  std::string names;
  for (const std::string& name : extensions) names += (names.empty() ? "" : ", ") + name;
  return bad_input(fmt::format("-o {}: the extension must be one of {}.", common.output, names));
}

Exit deliver(const Common& common, const Answer& answer, Exit exit) {
  if (!common.output.empty()) {
    if (const Status status = write_files(common.output, answer); !status.ok()) return fail(status.error());
  }
  if (common.json) {
    fmt::print("{}", dump(answer.json));
  } else if (!common.quiet) {
    fmt::print("{}", answer.table);
  }
  return exit;
}

}  // namespace swallowtail::cli
