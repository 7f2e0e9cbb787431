#pragma once

#include <iosfwd>
#include <optional>
#include <string>

#include "planner/base/result.hpp"

namespace swallowtail::gtsp::detail {

/// Reads a TSPLIB file as lines `KEY : value` and as tokens between white space, counting lines. Tokens and
/// lines are cut off at a bound, so that no input takes more memory.
class TokenReader {
 public:
  TokenReader(std::istream& in, std::string name) : in_(in), name_(std::move(name)) {}

  struct Line {
    std::string key;    ///< upper case, without the colon
    std::string value;  ///< trimmed
  };
  /// The next line that is not blank; none at the end of the file.
  std::optional<Line> next_line();
  /// The next token, on this line or a later one; none at the end of the file.
  std::optional<std::string> next_token();

  /// The next token as a number; `key` names the place for the error.
  Result<int> next_int(const std::string& key);
  Result<double> next_double(const std::string& key);

  /// `name:line: key: value: rule`, for the line of what was read last.
  Error error(const std::string& key, const std::string& value, const std::string& rule) const;

 private:
  int get();

  std::istream& in_;
  std::string name_;
  int line_ = 1;       ///< of the next character
  int read_line_ = 1;  ///< of what was read last
};

std::optional<int> parsed_int(const std::string& text);
std::optional<double> parsed_double(const std::string& text);
std::string upper_case(std::string text);

}  // namespace swallowtail::gtsp::detail
