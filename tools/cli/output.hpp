#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "planner/base/result.hpp"
#include "tools/cli/common.hpp"

namespace swallowtail::cli {

/// An answer in every form it has. `json` is the document of --json and of files *.json; `table` is for
/// people; `files` maps other extensions (".csv") to what writes their text.
struct Answer {
  nlohmann::ordered_json json;
  std::string table;
  std::map<std::string, std::function<std::string()>> files;
  /// Extensions of which there are several files: name-1.ext, name-2.ext, …
  std::map<std::string, std::vector<std::function<std::string()>>> series{};
  /// Extensions of files that are not text: what writes the one at a path.
  std::map<std::string, std::function<Status(const std::string&)>> writers{};
};

/// Prints and writes the answer as the options ask, and returns `exit`, or kUsage when the output file has an
/// unknown extension or cannot be written.
Exit deliver(const Common& common, const Answer& answer, Exit exit);

/// Refuses an output file whose extension is none of `extensions`, before any work is done.
Status check_output(const Common& common, const std::vector<std::string>& extensions);

Status write_text(const std::string& path, const std::string& text);
/// The file's text. Errors: no such file, larger than `max_bytes`, unreadable.
Result<std::string> read_text(const std::string& path, std::uintmax_t max_bytes);

}  // namespace swallowtail::cli
